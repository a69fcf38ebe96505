"use strict";
// What all parts of the page use: axes, methods, colours, and the head of the page.
const axes = Array.isArray(results.axes) ? results.axes : [];
const methodsOf = axis => (axis.methods ?? []).filter(m => m && m.name);
const pointsOf = method => (method.points ?? []).filter(p => p && finite(p.parameter));
const limitsOf = axis => (axis.limits ?? []).filter(l => l && finite(l.safe));

// Failures from the gravest to the mildest: where several occur, a cell shows the first.
const failureColors = {
  "not finite": "#000000", "leaked": "#d55e00", "missed": "#e69f00", "self-hit": "#0072b2", "wrong order": "#cc79a7",
  "biased": "#009e73", "endless": "#56b4e9", "inaccurate": "#b8a000", "refused": "#8a8f99"
};
const colorOf = (axis, method) => {
  if (["ref", "host", "cuda"].includes(method.name)) return `var(--${method.name})`;
  // A trick has one colour in both formats: "float, fixed 1e-3" and "double, fixed 1e-3", "ref, path" and "host, path".
  const trick = name => name.replace(/^(double|float|ref|host),? ?/, "");
  const tricks = [...new Set(methodsOf(axis).filter(m => !["ref", "host", "cuda"].includes(m.name)).map(m => trick(m.name)))];
  return `var(--c${tricks.indexOf(trick(method.name)) % 8})`;
};
const isMain = method => ["ref", "host", "cuda"].includes(method.name);
const idOf = axis => "axis-" + String(axis.name).replace(/[^A-Za-z0-9-]/g, "-");
const power = t => { // a tick: 10^k, or the number itself
  const e = Math.log10(t);
  return Math.abs(e - Math.round(e)) < 1e-6 && Math.abs(e) > 2 ? "10" + raised(Math.round(e)) : String(Number(t.toPrecision(3)));
};

function addFacts() {
  const add = (term, ...content) => { if (content.some(Boolean)) byId("facts").append(element("dt", {}, term), element("dd", {}, ...content)); };
  const join = parts => parts.filter(Boolean).join(", ");
  add("made by", join([results.program && "plumbline " + results.program, results.date, results.processor]));
  if (results.command) add("command", element("code", {}, results.command));
  add("walked", join([`${axes.length} axes`, finite(results.cases) && `${results.cases} cases at each point`, finite(results.seed) && `seed ${results.seed}`]));
}
byId("interrupted").hidden = results.complete !== false;
const broken = axes.flatMap(a => limitsOf(a).filter(l => l.contradiction).map(l => `${a.name}, ${l.method}: ${l.contradiction}`));
byId("contradicted").hidden = broken.length === 0;
byId("contradicted").textContent = "A limit does not hold: " + broken.join("; ");
addFacts();
