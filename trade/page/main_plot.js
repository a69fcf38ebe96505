"use strict";
// Time against error: one symbol per configuration at equal samples per pixel.
const plotBox = { width: 1160, height: 600, left: 78, right: 24, top: 14, bottom: 56 };

/// The range of a logarithmic axis: all values, and their intervals as far as these are near the values.
function logRange(estimates) {
  const values = estimates.map(e => e.value);
  const low = Math.min(...values), high = Math.max(...values);
  const ends = estimates.flatMap(e => [Math.max(e.low, low / 4), Math.min(e.high, high * 4)]);
  const from = Math.min(low, ...ends), to = Math.max(high, ...ends);
  const room = Math.max(Math.pow(to / from, 0.06) * 1.25, Math.sqrt(4 * from / to)); // a factor of at least 4 in all
  return [from / room, to * room];
}

function drawMainPlot() {
  const points = measured.map(c => ({ c, kind: kindOf(c), x: timeFor(c, samples), y: errorAt(c, samples) }))
    .filter(p => p.x.value > 0 && p.y.value > 0);
  if (points.length === 0) { byId("main-plot").append("No configuration could be measured."); return; }
  const { width, height, left, right, top, bottom } = plotBox;
  const x = d3.scale.log().domain(logRange(points.map(p => p.x))).range([left, width - right]).clamp(true);
  const y = d3.scale.log().domain(logRange(points.map(p => p.y))).range([height - bottom, top]).clamp(true);
  const svg = d3.select("#main-plot").append("svg").attr("viewBox", `0 0 ${width} ${height}`)
    .attr("role", "group").attr("aria-label", "Plot of time against error");
  svg.append("clipPath").attr("id", "inside").append("rect").attr("x", left).attr("y", top)
    .attr("width", width - left - right).attr("height", height - top - bottom);
  drawAxes(svg, x, y);
  const taken = drawEqualLines(svg, x, y);
  taken.push(...drawFront(svg, x, y));
  const symbols = drawSymbols(svg, x, y, points);
  drawLabels(svg, x, y, points, taken);
  addPicking(svg, x, y, points, symbols);
  addLegend(points);
}

function drawAxes(svg, x, y) {
  const { width, height, left, right, top, bottom } = plotBox;
  const axes = svg.append("g").attr("class", "axis");
  const power = t => { const e = Math.floor(Math.log10(t) + 1e-9), m = Number((t / 10 ** e).toPrecision(2)); return (m === 1 ? "" : m + "·") + "10" + raised(e); };
  for (const t of logTicks(x.domain())) {
    axes.append("line").attr("class", "grid").attr("x1", x(t)).attr("x2", x(t)).attr("y1", top).attr("y2", height - bottom);
    axes.append("text").attr("x", x(t)).attr("y", height - bottom + 20).attr("text-anchor", "middle").text(shortSeconds(t));
  }
  for (const t of logTicks(y.domain())) {
    axes.append("line").attr("class", "grid").attr("x1", left).attr("x2", width - right).attr("y1", y(t)).attr("y2", y(t));
    axes.append("text").attr("x", left - 8).attr("y", y(t) + 4).attr("text-anchor", "end").text(power(t));
  }
  axes.append("path").attr("d", `M${left},${top}V${height - bottom}H${width - right}`);
  axes.append("text").attr("class", "title").attr("x", (left + width - right) / 2).attr("y", height - 10).attr("text-anchor", "middle")
    .text(`time for ${samples} sample${samples === 1 ? "" : "s"} per pixel, build included`);
  axes.append("text").attr("class", "title").attr("transform", `translate(18,${(top + height - bottom) / 2}) rotate(-90)`)
    .attr("text-anchor", "middle").text("error (relMSE)");
}

/// Lines on which error times time is constant, through the base and at whole factors from it. Returns the boxes of
/// their labels.
function drawEqualLines(svg, x, y) {
  const [x0, x1] = x.domain(), [y0, y1] = y.domain();
  const through = timeFor(base, samples).value * errorAt(base, samples).value;
  if (!(through > 0)) return [];
  const span = Math.log(x1 * y1 / (x0 * y0));
  const step = [2, 10, 100, 1000, 1e6].find(s => span / Math.log(s) <= 8) ?? 1e9;
  const group = svg.append("g"), boxes = [];
  for (let k = -12; k <= 12; ++k) {
    const product = through * step ** k;
    // From the left or upper side of the plot to its lower or right side.
    const a = { t: Math.max(x0, product / y1) }, b = { t: Math.min(x1, product / y0) };
    if (!(b.t > a.t)) continue;
    a.x = x(a.t); a.y = y(product / a.t); b.x = x(b.t); b.y = y(product / b.t);
    group.append("line").attr("class", "equal").attr("x1", a.x).attr("y1", a.y).attr("x2", b.x).attr("y2", b.y);
    const length = Math.hypot(b.x - a.x, b.y - a.y), angle = Math.atan2(b.y - a.y, b.x - a.x);
    if (length < 130) continue;
    const label = k === 0 ? "as efficient as the base" : k < 0 ? `${step ** -k}×` : `1/${step ** k}`;
    const at = 14 / length; // near the upper end
    const place = { x: a.x + (b.x - a.x) * at, y: a.y + (b.y - a.y) * at };
    const text = group.append("text").attr("class", "small").attr("dy", -4).text(label)
      .attr("transform", `translate(${place.x},${place.y}) rotate(${angle * 180 / Math.PI})`);
    const long = text.node().getComputedTextLength();
    for (let s = 4; s < long; s += 8)
      boxes.push(boxAround(place.x + s * Math.cos(angle) + 8 * Math.sin(angle), place.y + s * Math.sin(angle) - 8 * Math.cos(angle), 5, 5));
  }
  return boxes;
}

/// The Pareto front: the configuration with the least error after each time. Returns boxes along it.
function drawFront(svg, x, y) {
  const group = svg.append("g").attr("clip-path", "url(#inside)");
  const [begin, end] = x.domain(), unlimited = y.copy().clamp(false), far = 10 * plotBox.height;
  const line = [];
  for (const part of results.front ?? []) {
    const c = measured.find(m => m.name === part?.configuration);
    if (!c) continue;
    const from = Math.max(begin, finite(part.from) ? part.from : begin), to = Math.min(end, finite(part.to) ? part.to : end);
    for (let i = 0; i <= 80 && from < to; ++i) {
      const t = from * Math.pow(to / from, i / 80), error = errorAfter(c, t);
      if (error > 0) line.push([x(t), Math.max(-far, Math.min(far, unlimited(error)))]);
    }
  }
  if (line.length) group.append("path").attr("class", "front").attr("d", "M" + line.join("L"));
  return line.map(([px, py]) => ({ ...boxAround(px, py, 4, 4), thin: true }));
}

function drawSymbols(svg, x, y, points) {
  const group = svg.append("g");
  // The base and the front last, on top.
  const order = [...points].sort((a, b) => (a.c.base ? 2 : a.c.front ? 1 : 0) - (b.c.base ? 2 : b.c.front ? 1 : 0));
  const symbols = new Map();
  for (const p of order) {
    const g = group.append("g").attr("class", "symbol " + p.kind).attr("tabindex", 0).attr("role", "img")
      .attr("aria-label", `${p.c.name}, ${kinds[p.kind]}: ${withRange(p.x, seconds)}, error ${withRange(p.y, number)}`);
    g.append("path").attr("class", "bar").attr("clip-path", "url(#inside)")
      .attr("d", `M${x(p.x.low)},${y(p.y.value)}H${x(p.x.high)}M${x(p.x.value)},${y(Math.max(p.y.low, y.domain()[0]))}V${y(p.y.high)}`);
    const place = g.append("g").attr("transform", `translate(${x(p.x.value)},${y(p.y.value)})`);
    addMark(place, p.kind);
    if (p.c.base) place.append("circle").attr("class", "ring").attr("r", 10);
    symbols.set(p, g);
  }
  return symbols;
}

// ---- the numbers of one symbol
function addPicking(svg, x, y, points, symbols) {
  const tip = byId("tip"), plot = byId("main-plot");
  const related = (p, q) => p === q || q.c.base || (p.c.knob && p.c.knob === q.c.knob);
  let picked = null;
  function pick(p) {
    if (p === picked) return;
    picked = p;
    tip.hidden = !p;
    svg.classed("picking", Boolean(p));
    for (const [q, g] of symbols) g.classed("picked", q === p).classed("related", Boolean(p) && related(p, q));
    svg.selectAll(".label, .leader").classed("related", function () { const q = d3.select(this).datum(); return Boolean(p) && related(p, q); });
    if (!p) return;
    tip.replaceChildren(...tipContent(p));
    const box = svg.node().getBoundingClientRect(), scale = box.width / plotBox.width;
    const [px, py] = p.at.map(v => v * scale);
    tip.style.left = Math.max(0, px + 18 + tip.offsetWidth < box.width ? px + 18 : px - 18 - tip.offsetWidth) + "px";
    tip.style.top = Math.max(0, Math.min(box.height - tip.offsetHeight, py - tip.offsetHeight / 2)) + "px";
  }
  for (const [p, g] of symbols) g.on("focus", () => pick(p)).on("blur", () => pick(null));
  svg.on("mousemove", () => {
    const [mx, my] = d3.mouse(svg.node());
    const near = points.map(p => ({ p, d: Math.hypot(p.at[0] - mx, p.at[1] - my) })).sort((a, b) => a.d - b.d)[0];
    pick(near.d < 28 ? near.p : null);
  });
  plot.addEventListener("mouseleave", () => pick(null));
  plot.addEventListener("keydown", event => { if (event.key === "Escape") pick(null); });
}

function tipContent({ c, kind, x, y }) {
  const row = (name, text) => element("tr", {}, element("td", {}, name), element("td", {}, text));
  const rows = [row("verdict", kinds[kind]), row("time", withRange(x, seconds)), row("error", withRange(y, number)),
    row("its noise part", withRange(scaled(c.noise, 1 / samples), number)), row("error of the mean", withRange(c.bias?.whole, percent))];
  if (estimate(c.time_to_equal_noise)) rows.push(row("time to equal noise", withRange(c.time_to_equal_noise, times) + " of the base"));
  rows.push(row("efficiency", withRange(c.efficiency, number)));
  if (c.skewed) rows.push(row("caution", "the noise is heavy-tailed: its interval is not reliable"));
  return [element("strong", {}, c.name), element("span", { class: "mono" }, c.command ?? ""), element("table", {}, ...rows)];
}
const scaled = (e, factor) => estimate(e) && { value: e.value * factor, low: e.low * factor, high: e.high * factor };

function addLegend(points) {
  const legend = d3.select("#legend");
  const entry = (text, draw) => {
    const li = legend.append("li");
    draw(li.append("svg").attr("viewBox", "0 0 34 18").attr("aria-hidden", "true").append("g").attr("transform", "translate(17,9)"));
    li.append("span").text(text);
  };
  for (const kind of Object.keys(kinds).filter(k => points.some(p => p.kind === k)))
    entry(kinds[kind], g => { g = g.append("g").attr("class", kind); g.append("path").attr("class", "bar").attr("d", "M-16,0H16"); addMark(g, kind); });
  if (points.some(p => p.c.base)) entry("the base", g => g.append("circle").attr("class", "ring").attr("r", 8));
  if ((results.front ?? []).length) entry("Pareto front: the least error after each time", g => g.append("path").attr("class", "front").attr("d", "M-11,0H11"));
  entry("equal error × time", g => g.append("line").attr("class", "equal").attr("x1", -16).attr("x2", 16));
}

byId("main-note").textContent = base ? `Each symbol is one configuration with ${samples} sample${samples === 1 ? "" : "s"} per pixel, ` +
  `as many as the base renders in a second. Lower and further left is better. relMSE is the mean of (picture − truth)² / truth² over the pixels: ` +
  `noise and bias together. Point at a symbol for its numbers.` +
  (measured.every(c => errorAt(c, samples).value > 0) ? "" : " Configurations without any error are not shown: the axis has no zero.") : "";
drawMainPlot();
