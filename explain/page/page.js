"use strict";
// The sample: `results.sample` is what `plumbline explain --json` prints, `results.lines` the places in the source.
const sample = results.sample;
const rgb = v => v.map(x => number(x, 4)).join(" ");
const cell = (content, numeric = false) => element("td", numeric ? { class: "n" } : {}, content);
const head = (...names) => element("thead", {}, element("tr", {}, ...names.map(([name, n]) => element("th", n ? { class: "n" } : {}, name))));
const source = line => element("code", {}, line);
const paragraph = (...content) => element("p", {}, ...content);

const limit = sample.max_edges === null ? "paths of any length" : `paths of at most ${sample.max_edges} edges`;
byId("lead").textContent = `Pixel ${sample.pixel.join(",")} of ${sample.size.join(" × ")}, sample ${sample.sample}, seed ${sample.seed}; ` +
  `${sample.integrator}${sample.integrator === "bdpt" ? `, heuristic ${sample.heuristic}` : ""}, ${limit}. ` +
  `It adds ${rgb(sample.own)} (R G B) to its pixel.`;

// ---- strategies
const name_of = strategy => `(${strategy.s},${strategy.t})`;
function row_of(strategy, index) {
  const button = element("button", { type: "button", "data-strategy": `${strategy.s},${strategy.t}` }, name_of(strategy));
  button.addEventListener("click", () => choose(index));
  const cells = strategy.value
    ? [cell(rgb(strategy.value)), cell(number(strategy.weight_balance, 4), true), cell(number(strategy.weight_power, 4), true),
       cell(rgb(strategy.contribution)), cell(strategy.pixel.join(","))]
    : [element("td", { colspan: "5" }, strategy.reason)];
  return element("tr", strategy.value ? {} : { class: "nothing" }, cell(button), cell(strategy.family.replace("_", " ")), ...cells);
}
byId("strategies").append(
  head(["(s,t)"], ["family"], ["value alone (R G B)"], ["balance", true], ["power", true], ["adds (R G B)"], ["to pixel"]),
  element("tbody", {}, ...sample.strategies.map(row_of)));

// ---- one strategy
const is_path = sample.integrator === "path";
function lines_of(strategy) {
  const { lines } = results;
  const value = is_path ? lines["path_" + strategy.family] : lines[strategy.family];
  const weight = is_path ? (strategy.s === 0 ? lines.path_weight_hit : lines.path_weight_event) : lines.weight;
  return { value, weight };
}
function value_formula(strategy) {
  const names = strategy.factors.map(f => (f.divides ? " / " : " · ") + f.name).join("").slice(3);
  const numbers = strategy.factors.map(f => (f.divides ? " / " : " · ") + (f.scalar ? number(f.value[0], 4) : `(${rgb(f.value)})`)).join("").slice(3);
  return [element("p", { class: "formula" }, "value = " + names), paragraph(`= ${numbers} = (${rgb(strategy.value)})`)];
}
function density_table(strategy) {
  const shares = strategy.densities.reduce((sum, d) => sum + d.relative, 0);
  const rows = strategy.densities.map(d => element("tr", {},
    cell(`p${d.s}`), cell(is_path ? (d.s === 0 ? "emission hit" : "next event") : `(${d.s},${strategy.s + strategy.t - d.s})`),
    cell(d.p === 0 && d.log10_p !== null ? "10^" + number(d.log10_p, 5) : number(d.p, 4), true), cell(number(d.relative, 4), true),
    cell(number(d.relative / shares, 4), true)));
  return element("table", {}, head(["density"], ["of strategy"], ["p_i", true], ["p_i / p_s", true], ["weight of i (balance)", true]), element("tbody", {}, ...rows));
}
function factor_table(strategy) {
  const { light, eye } = strategy.vertex_densities;
  const rows = strategy.path.map((vertex, i) => element("tr", {},
    cell(`x${i}`), cell(i < strategy.s ? `y_${i}` : `z_${strategy.s + strategy.t - 1 - i}`), cell(vertex.on),
    cell(number(light[i], 4), true), cell(number(eye[i], 4), true)));
  return element("table", {}, head(["vertex"], ["here"], ["on"], ["p by the light walk", true], ["p by the eye walk", true]), element("tbody", {}, ...rows));
}
function detail_of(strategy) {
  const title = element("h2", {}, `Strategy ${name_of(strategy)}, ${strategy.family.replace("_", " ")}`);
  if (!strategy.value) return [title, paragraph(`It contributes nothing: ${strategy.reason}.`)];
  const { value, weight } = lines_of(strategy);
  const sum = strategy.densities.map(d => number(d.relative, 4)).join(" + ");
  const content = [title, ...value_formula(strategy), paragraph("Computed in ", source(value), "."),
    element("p", { class: "formula" }, `weight (balance) = 1 / (${sum}) = ${number(strategy.weight_balance, 6)}`),
    paragraph("One over the sum of p_i / p_s over all strategies that can make this path [Veach 1997, sec. 9.2]. Computed in ", source(weight), "."),
    density_table(strategy)];
  if (strategy.vertex_densities)
    content.push(element("h3", {}, "The factors of the densities"),
      paragraph("p_i is the product of the light walk's densities of the first i vertices and the eye walk's of all others: per area, per solid angle at infinity. Computed in ",
        source(results.lines.vertex_densities), ", their quotients in ", source(results.lines.quotient), "."), factor_table(strategy));
  return content;
}
function choose(index) {
  const strategy = sample.strategies[index];
  const key = `${strategy.s},${strategy.t}`;
  for (const path of document.querySelectorAll("#drawing .path")) path.style.display = path.dataset.strategy === key ? "" : "none";
  [...byId("strategies").tBodies[0].rows].forEach((row, i) => row.classList.toggle("chosen", i === index));
  byId("detail").replaceChildren(...detail_of(strategy));
}
const largest = sample.strategies.reduce((best, strategy, i) =>
  strategy.value && (best < 0 || Math.max(...strategy.contribution) > Math.max(...sample.strategies[best].contribution)) ? i : best, -1);
if (sample.strategies.length) choose(Math.max(0, largest));

// ---- walks and random numbers
function step_row(step, j, letter) {
  const at = step.position ? rgb(step.position) : "towards " + rgb(step.towards);
  const density = step.probability !== null ? `probability ${number(step.probability, 4)}` : "";
  return element("tr", {}, cell(`${letter}_${j}`), cell(step.on), cell(at), cell(step.normal ? rgb(step.normal) : none),
    cell(step.pdf_solid_angle !== null ? number(step.pdf_solid_angle, 4) : density || none, true), cell(number(step.pdf_area, 4), true), cell(rgb(step.alpha)));
}
byId("walk-note").replaceChildren(
  `The eye walk ends: ${results.eye_end}.` + (sample.light_walk.vertices.length ? ` The light walk ends: ${results.light_end}.` : "") + " alpha is computed in ",
  source(is_path ? results.lines.path_alpha : results.lines.walk_alpha), ".");
byId("walks").append(
  head(["vertex"], ["on"], ["position"], ["normal"], ["pdf_solid_angle", true], ["pdf_area", true], ["alpha (R G B)"]),
  element("tbody", {}, ...sample.eye_walk.vertices.map((v, j) => step_row(v, j, "z")), ...sample.light_walk.vertices.map((v, j) => step_row(v, j, "y"))));
byId("draw-note").replaceChildren("Philox4x32-10, with the seed as key and (pixel, sample, event, 0) as counter: ", source(results.lines.uniforms), ".");
byId("draws").append(
  head(["event"], ["vertex"], ["word 0"], ["word 1"], ["word 2"], ["word 3"]),
  element("tbody", {}, ...sample.random_numbers.map(draw => element("tr", {}, cell(draw.event.replace("_", " ")), cell(/bounce|next/.test(draw.event) ? String(draw.vertex) : none),
    ...draw.uniforms.map((u, i) => cell(draw.use[i] === null ? none : `${u.toFixed(7)} ${draw.use[i]}`))))));
