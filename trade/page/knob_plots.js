"use strict";
// One panel per knob: its configurations beside the reference of the knob, a row each.
const panelBox = { width: 560, row: 26, top: 6, bottom: 44, first: [152, 338], second: [372, 540] };

/// The rows of a knob in the order of its values.
function rowsOf(knob) {
  const rows = [];
  for (const v of Array.isArray(knob.values) ? knob.values : []) {
    const c = configurations.find(c => c.name === v?.configuration);
    if (c) rows.push({ c, label: String(v.value), isReference: c.name === knob.reference, time: estimate(v.time_to_equal_noise) });
  }
  return rows;
}

const ratioOf = row => row.isReference ? { value: 1, low: 1, high: 1 } : row.time;
const errorOf = row => estimate(row.c.bias?.whole);

/// A range about the middle that holds all estimates; the intervals as far as three times the values.
function rangeAbout(estimates, least) {
  const size = e => Math.min(Math.max(Math.abs(e.low), Math.abs(e.high)), 3 * Math.max(Math.abs(e.value), least));
  return 1.08 * Math.max(least, ...estimates.map(size));
}

function drawKnobs() {
  const knobs = (Array.isArray(results.knobs) ? results.knobs : []).filter(k => k && k.name);
  if (knobs.length === 0) return;
  byId("knob-section").hidden = false;
  const all = knobs.map(knob => ({ knob, rows: rowsOf(knob) })).filter(k => k.rows.length > 1 || k.knob.sentence);
  // The axis of time is the same in all panels, symmetrical about 1, and holds all that are not biased: a biased one may
  // be fast because it leaves out almost everything.
  const ratios = all.flatMap(k => k.rows.filter(r => isMeasured(r.c) && kindOf(r.c) !== "biased").map(ratioOf)).filter(e => e && e.value > 0);
  const logs = ratios.map(e => ({ value: Math.log(e.value), low: Math.log(Math.max(e.low, 1e-12)), high: Math.log(Math.max(e.high, 1e-12)) }));
  const reach = Math.exp(rangeAbout(logs, Math.log(2)));
  for (const { knob, rows } of all) {
    const panel = element("div", { class: "knob" }, element("h3", { class: "mono" }, knob.name), element("p", { class: "what" }, knob.what ?? ""),
      element("p", {}, knob.sentence ?? ""),
      element("p", { class: "what" }, knob.reference && knob.reference !== base?.name ? "Compared with " + knob.reference + "." : ""));
    const plot = element("div", { class: "plot" });
    panel.append(plot);
    byId("knobs").append(panel);
    if (rows.length < 2) continue;
    drawPanel(d3.select(plot), rows, reach);
  }
}

function drawPanel(plot, rows, reach) {
  const { width, row, top, bottom, first, second } = panelBox;
  const height = top + rows.length * row + bottom, end = height - bottom;
  const svg = plot.append("svg").attr("viewBox", `0 0 ${width} ${height}`).attr("role", "img")
    .attr("aria-label", rows.map(r => `${r.label}: ${r.c.problem ?? `time ${withRange(ratioOf(r), times)}, error ${withRange(errorOf(r), percent)}`}`).join("; "));
  const ratio = d3.scale.log().domain([1 / reach, reach]).range(first).clamp(true);
  const errorReach = rangeAbout(rows.filter(r => isMeasured(r.c)).map(errorOf).filter(Boolean), 0.002);
  const error = d3.scale.linear().domain([-errorReach, errorReach]).range(second).clamp(true);
  const ratioTicks = reach > 30 ? logTicks([1 / reach, reach]).filter(t => Math.abs(Math.log10(t) % 1) < 1e-9)
    : [1 / 16, 1 / 8, 1 / 4, 1 / 2, 1, 2, 4, 8, 16].filter(t => t > 1 / reach && t < reach && (reach < 10 || Math.log2(t) % 2 === 0));
  const fraction = t => t < 1 ? "1/" + number(1 / t, 1) : number(t, 1);
  drawPanelAxis(svg, ratio, ratioTicks, fraction, 1, end, "time to equal noise");
  drawPanelAxis(svg, error, [-1, 0, 1].map(k => k * niceBelow(errorReach)), t => t === 0 ? "0" : percent(t).replace(/\.?0+%/, "%"), 0, end, "error of the mean");
  rows.forEach((r, i) => {
    const y = top + (i + 0.5) * row;
    const label = svg.append("text").attr("x", first[0] - 14).attr("y", y + 4).attr("text-anchor", "end").text(r.label);
    shorten(label, first[0] - 18);
    if (!isMeasured(r.c)) {
      shorten(svg.append("text").attr("class", "small over").attr("x", first[0] + 4).attr("y", y + 4).text("not measured: " + (r.c.problem ?? "no times")), second[1] - first[0] - 4);
      return;
    }
    drawEstimate(svg, ratio, ratioOf(r), y, r, times);
    drawEstimate(svg, error, errorOf(r), y, r, percent);
  });
}

/// The largest of 1, 2, 4 and 5 times a power of ten that leaves room for its label.
function niceBelow(reach) {
  const power = Math.floor(Math.log10(0.92 * reach)), mantissa = 0.92 * reach / 10 ** power;
  return Number(`${[5, 4, 2, 1].find(m => mantissa >= m) ?? 1}e${power}`);
}

function drawPanelAxis(svg, scale, ticks, say, middle, end, title) {
  const axis = svg.append("g").attr("class", "axis");
  const [from, to] = scale.range();
  for (const t of ticks) {
    axis.append("line").attr("class", t === middle ? "one" : "grid").attr("x1", scale(t)).attr("x2", scale(t)).attr("y1", panelBox.top).attr("y2", end);
    axis.append("text").attr("class", "small").attr("x", scale(t)).attr("y", end + 16).attr("text-anchor", "middle").text(say(t));
  }
  axis.append("line").attr("x1", from).attr("x2", to).attr("y1", end).attr("y2", end);
  axis.append("text").attr("class", "small").attr("x", (from + to) / 2).attr("y", end + 34).attr("text-anchor", "middle").text(title);
}

function drawEstimate(svg, scale, e, y, row, say) {
  if (!e) return;
  const kind = kindOf(row.c), g = svg.append("g").attr("class", kind);
  g.append("title").text(`${row.c.name}: ${withRange(e, say)}`);
  const [low, high] = scale.domain(), [left, right] = scale.range();
  if (e.value < low || e.value > high) { // an arrow and the number, at the edge
    g.append("text").attr("class", "beyond over").attr("x", e.value < low ? left : right).attr("y", y + 4)
      .attr("text-anchor", e.value < low ? "start" : "end").text(e.value < low ? "◂ " + say(e.value) : say(e.value) + " ▸");
    return;
  }
  g.append("path").attr("class", "bar").attr("d", `M${scale(e.low)},${y}H${scale(e.high)}`);
  const place = g.append("g").attr("transform", `translate(${scale(e.value)},${y})`);
  addMark(place, kind, 0.65);
  if (row.isReference) place.append("circle").attr("class", "ring").attr("r", 8.5);
}

/// Cuts the text to `room`, with the whole of it as a tooltip.
function shorten(text, room) {
  const whole = text.text();
  let length = whole.length;
  while (length > 1 && text.node().getComputedTextLength() > room) text.text(whole.slice(0, --length) + "…");
  if (length < whole.length) text.append("title").text(whole);
}

drawKnobs();
