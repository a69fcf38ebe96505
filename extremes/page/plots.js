"use strict";
// One plot per axis: above, the largest error of each method against the parameter; below, a row per method that shows
// where it fails and how.
const frame = { width: 1160, left: 190, right: 24, top: 10, curves: 330, gap: 46, row: 15 };

function scaleX(axis) {
  const values = (axis.values ?? []).filter(finite), range = [frame.left, frame.width - frame.right];
  const [low, high] = [Math.min(...values), Math.max(...values)];
  if (axis.logarithmic) return d3.scale.log().domain([low, high]).range(range);
  return d3.scale.linear().domain([low, high]).range(range);
}
function ticksX(axis, x) {
  if (!axis.logarithmic) return x.ticks(10);
  const [a, b] = x.domain().map(Math.log10), step = [1, 2, 3, 5, 10, 20, 50, 100].find(s => (b - a) / s <= 14) ?? 200;
  return d3.range(Math.ceil(a / step - 1e-9), Math.floor(b / step + 1e-9) + 1).map(k => Number("1e" + k * step));
}
const decades = [-24, 1]; // of errors: smaller ones are drawn at the lower edge
function scaleY(axis) {
  const all = methodsOf(axis).flatMap(m => pointsOf(m).filter(p => p.errors > 0).map(p => p.largest)).filter(e => e > 0);
  const bounds = limitsOf(axis).flatMap(l => (l.bound ?? []).map(b => b[1])).filter(e => e > 0);
  const low = Math.max(decades[0], Math.floor(Math.log10(Math.min(1e-17, ...all, ...bounds))));
  const high = Math.min(8, Math.max(decades[1], Math.ceil(Math.log10(Math.max(1, ...all)))));
  return d3.scale.log().domain([Number("1e" + low), Number("1e" + high)]).range([frame.top + frame.curves, frame.top]).clamp(true);
}

function drawAxis(axis, place) {
  const methods = methodsOf(axis), x = scaleX(axis), y = scaleY(axis);
  const rows = frame.top + frame.curves + frame.gap, height = rows + methods.length * frame.row + 8;
  const svg = d3.select(place).append("svg").attr("viewBox", `0 0 ${frame.width} ${height}`).attr("role", "group")
    .attr("aria-label", "Errors and failures: " + axis.title);
  drawGrid(axis, svg, x, y);
  const methodRows = methods.map((m, i) => drawMethod(axis, svg, m, x, y, rows + i * frame.row));
  drawLimits(axis, svg, x, y);
  methods.forEach((m, i) => {
    const pick = on => svg.classed("picking", on).selectAll("[data-method]").classed("picked", function () { return on && this.getAttribute("data-method") === m.name; });
    methodRows[i].on("mouseenter", () => pick(true)).on("mouseleave", () => pick(false)).on("focus", () => pick(true)).on("blur", () => pick(false));
  });
}

function drawGrid(axis, svg, x, y) {
  const g = svg.append("g").attr("class", "axis"), bottom = frame.top + frame.curves, right = frame.width - frame.right;
  for (const t of ticksX(axis, x)) {
    g.append("line").attr("class", "grid").attr("x1", x(t)).attr("x2", x(t)).attr("y1", frame.top).attr("y2", bottom);
    g.append("text").attr("x", x(t)).attr("y", bottom + 16).attr("text-anchor", "middle").text(axis.logarithmic ? power(t) : number(t));
  }
  const [low, high] = y.domain().map(v => Math.round(Math.log10(v))), step = high - low > 12 ? 4 : 2;
  for (let k = Math.ceil(low / step) * step; k <= high; k += step) {
    const at = y(Number("1e" + k));
    g.append("line").attr("class", "grid").attr("x1", frame.left).attr("x2", right).attr("y1", at).attr("y2", at);
    g.append("text").attr("x", frame.left - 8).attr("y", at + 4).attr("text-anchor", "end").text(k === 0 ? "1" : "10" + raised(k));
  }
  g.append("path").attr("d", `M${frame.left},${frame.top}V${bottom}H${right}`);
  g.append("text").attr("x", (frame.left + right) / 2).attr("y", bottom + 35).attr("text-anchor", "middle").text(axis.parameter ?? "");
  g.append("text").attr("transform", `translate(100,${frame.top + frame.curves / 2}) rotate(-90)`).attr("text-anchor", "middle").text("largest error");
}

/// The points at which a method has errors, as one line; interrupted where it has none.
function curve(method, x, y) {
  let path = "", open = false;
  for (const p of pointsOf(method)) {
    if (!(p.errors > 0)) { open = false; continue; }
    path += `${open ? "L" : "M"}${x(p.parameter)},${y(Math.max(p.largest, y.domain()[0]))}`;
    if (!open) path += "h.01"; // a single point is visible, too
    open = true;
  }
  return path;
}

function drawMethod(axis, svg, method, x, y, top) {
  const color = colorOf(axis, method), kind = `${isMain(method) ? "main " : ""}${method.format ?? ""}`;
  const path = curve(method, x, y);
  if (path) svg.append("path").attr("class", "curve " + kind).attr("data-method", method.name).style("--own", color).attr("stroke-linecap", "round").attr("d", path);
  const row = svg.append("g").attr("class", "method").attr("data-method", method.name).attr("tabindex", 0).attr("role", "img")
    .attr("aria-label", `${method.name}: ${failureWords(method)}`);
  row.append("rect").attr("class", "track").attr("x", frame.left).attr("y", top + 1).attr("width", frame.width - frame.left - frame.right).attr("height", frame.row - 3);
  row.append("text").attr("class", "name").attr("x", frame.left - 42).attr("y", top + frame.row - 4).attr("text-anchor", "end").text(method.name);
  row.append("path").attr("class", "curve " + kind).attr("data-method", method.name).style("--own", color).attr("d", `M${frame.left - 36},${top + frame.row / 2}h28`);
  const values = (axis.values ?? []).filter(finite);
  for (const p of pointsOf(method)) {
    const failed = Object.keys(failureColors).filter(k => p.failures?.[k] > 0);
    if (failed.length === 0 && !p.not_walked) continue;
    const i = values.indexOf(p.parameter); // a cell reaches half-way to its neighbours
    const from = i > 0 ? (x(values[i - 1]) + x(p.parameter)) / 2 : frame.left;
    const to = i + 1 < values.length && i >= 0 ? (x(p.parameter) + x(values[i + 1])) / 2 : frame.width - frame.right;
    if (p.not_walked) {
      row.append("rect").attr("class", "unwalked").attr("x", from).attr("width", Math.max(1, to - from)).attr("y", top).attr("height", frame.row)
        .append("title").text(`${method.name} at ${number(p.parameter)}: not walked: ${p.not_walked}`);
      continue;
    }
    const share = failed.reduce((sum, k) => sum + p.failures[k], 0) / p.cases;
    row.append("rect").attr("x", from).attr("width", Math.max(1, to - from)).attr("y", top + 1).attr("height", frame.row - 3)
      .attr("fill", failureColors[failed[0]]).attr("opacity", Math.max(0.3, Math.min(1, 0.3 + 0.7 * share)))
      .append("title").text(`${method.name} at ${number(p.parameter)}: ` + failed.map(k => `${k} ${p.failures[k]} of ${p.cases}`).join(", ") + (p.refusal ? `: ${p.refusal}` : ""));
  }
  row.append("title").text(`${method.name}: ${failureWords(method)}`);
  return row;
}
const failureWords = method => {
  const text = (method.first_failures ?? []).map(f => `${f.kind} ${[f.below, f.above].filter((v, i, all) => finite(v) && all.indexOf(v) === i).map(v => "at " + number(v)).join(" and ")}`).join(", ");
  return text || "no failure";
};

function drawLimits(axis, svg, x, y) {
  for (const limit of limitsOf(axis)) {
    const color = colorOf(axis, { name: limit.method }), [low, high] = x.domain();
    const line = (limit.bound ?? []).filter(b => finite(b[0]) && b[1] > 0 && b[0] >= low && b[0] <= high).map(b => [x(b[0]), y(b[1])]);
    if (line.length) svg.append("path").attr("class", "bound").attr("data-method", limit.method).style("--own", color).attr("d", "M" + line.join("L"));
    if (limit.safe > low && limit.safe < high)
      svg.append("line").attr("class", "limit").attr("data-method", limit.method).style("--own", color).attr("x1", x(limit.safe)).attr("x2", x(limit.safe))
        .attr("y1", frame.top).attr("y2", frame.top + frame.curves);
  }
}

function addLegend(axis, place) {
  const seen = Object.keys(failureColors).filter(k => methodsOf(axis).some(m => pointsOf(m).some(p => p.failures?.[k] > 0)));
  const list = element("ul", { class: "legend" });
  for (const kind of seen) list.append(element("li", {}, element("i", { style: `background:${failureColors[kind]}` }), kind));
  if (methodsOf(axis).some(m => pointsOf(m).some(p => p.not_walked)))
    list.append(element("li", {}, element("i", { class: "unwalked" }), "not walked"));
  if (list.children.length) place.append(list);
}
