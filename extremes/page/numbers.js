"use strict";
// A section per axis: what it is, its limits, its plot, and all numbers.
function numbersOf(axis) {
  const head = element("tr", {}, ...["method", "parameter", "cases", "median", "largest", "failures"].map((t, i) => element("th", i > 0 && i < 5 ? { class: "n" } : {}, t)));
  const rows = methodsOf(axis).flatMap(m => pointsOf(m).map(p => element("tr", {}, element("td", {}, m.name), element("td", { class: "n" }, number(p.parameter)),
    element("td", { class: "n" }, number(p.cases, 10)), element("td", { class: "n" }, p.errors > 0 ? number(p.median) : none), element("td", { class: "n" }, p.errors > 0 ? number(p.largest) : none),
    element("td", {}, Object.entries(p.failures ?? {}).map(([k, n]) => `${n} ${k}`).join(", ") + (p.refusal ? `: ${p.refusal}` : "") + (p.notice ? ` (notice: ${p.notice})` : "") + (p.not_walked ? `not walked: ${p.not_walked}` : "")))));
  return element("table", {}, element("thead", {}, head), element("tbody", {}, ...rows));
}
function addAxis(axis) {
  const section = element("section", { id: idOf(axis), class: "axis-section" }, element("h2", {}, `${axis.number ?? ""} ${axis.title ?? axis.name ?? ""}`));
  byId("axes").append(section);
  if (axis.about) section.append(element("p", { class: "about" }, axis.about));
  const list = element("ul", { class: "limits" });
  for (const limit of limitsOf(axis)) list.append(element("li", {}, element("b", {}, limit.method ?? ""), ` is safe ${limitWords(axis, limit)}, because ${limit.because ?? ""}`));
  if (list.children.length) section.append(list);
  const plot = element("div", { class: "plot" });
  section.append(plot);
  if ((axis.values ?? []).filter(finite).length > 1) drawAxis(axis, plot);
  addLegend(axis, plot);
  const all = element("details", {}, element("summary", {}, "All numbers"));
  section.append(all);
  all.addEventListener("toggle", () => { if (all.open && all.children.length === 1) all.append(element("div", { class: "scroll", tabindex: "0" }, numbersOf(axis))); });
}
axes.forEach(addAxis);
// #NAME:plot shows the plot of one axis alone.
const alone = /^#(.+):plot$/.exec(decodeURIComponent(location.hash));
if (alone && byId("axis-" + alone[1])) {
  document.body.classList.add("plot-only");
  byId("axis-" + alone[1]).classList.add("chosen");
}
