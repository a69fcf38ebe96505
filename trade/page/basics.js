"use strict";
// What all parts of the page use: estimates, numbers with units, and the head of the page.

// ---- estimates: { value, low, high }, or null
const estimate = e => e && finite(e.value) ? { value: e.value, low: finite(e.low) ? e.low : e.value, high: finite(e.high) ? e.high : e.value } : null;
const configurations = Array.isArray(results.configurations) ? results.configurations : [];
const wall = (c, part) => estimate(c[part]?.wall);
const isMeasured = c => !c.problem && wall(c, "render")?.value > 0 && estimate(c.noise) !== null;
const measured = configurations.filter(isMeasured);
const base = measured.find(c => c.base) ?? measured[0];
const kinds = {
  unbiased: "no bias found",
  biased: "biased: more samples do not remove the error",
  undecided: "undecided: the data do not say whether it is biased"
};
const kindOf = c => c.bias?.verdict === "biased" ? "biased" : c.bias?.verdict === "none found" ? "unbiased" : "undecided";

// The samples per pixel that the base renders in one second, at least 1.
const samples = base ? Math.max(1, Math.round(1 / wall(base, "render").value)) : 1;
function timeFor(c, n) { // seconds for n samples per pixel, build included
  const build = wall(c, "build") ?? { value: 0, low: 0, high: 0 }, render = wall(c, "render");
  return { value: build.value + n * render.value, low: build.low + n * render.low, high: build.high + n * render.high };
}
function errorAt(c, n) { // relMSE of n samples per pixel
  // Noise in the estimate of the bias of one that is not biased would look like a limit of its error.
  const none = { value: 0, low: 0, high: 0 };
  const noise = estimate(c.noise), bias = kindOf(c) === "biased" ? estimate(c.bias_squared) ?? none : none;
  const sum = key => noise[key] / n + Math.max(0, bias[key]);
  return { value: sum("value"), low: sum("low"), high: sum("high") };
}
function errorAfter(c, seconds) { // relMSE after this time, build included; infinite if the build takes longer
  const left = seconds - (wall(c, "build")?.value ?? 0);
  return left > 0 ? errorAt(c, left / wall(c, "render").value).value : Infinity;
}

// ---- numbers as text
function withUnit(x, units) { // the largest unit that leaves at least 1
  if (!finite(x)) return none;
  const [factor, unit] = units.find(([f]) => Math.abs(x) >= f * 0.9995) ?? units[units.length - 1];
  return number(x / factor) + "\u00a0" + unit; // which a line does not break
}
const seconds = x => withUnit(x, [[1, "s"], [1e-3, "ms"], [1e-6, "µs"], [1e-9, "ns"]]);
const shortSeconds = x => seconds(x).replace(/(\.\d*?)0+\u00a0/, "$1\u00a0").replace(".\u00a0", "\u00a0");
const bytes = x => withUnit(x, [[2 ** 30, "GiB"], [2 ** 20, "MiB"], [2 ** 10, "KiB"], [1, "B"]]);
const times = x => finite(x) ? number(x) + "×" : none;
function percent(x) { // with a sign: for errors
  if (!finite(x)) return none;
  const p = 100 * x, size = Math.abs(p);
  const text = p.toFixed(size >= 9.995 ? 1 : size >= 0.0995 || size === 0 ? 2 : 3);
  return (p > 0 ? "+" : "") + minus(text) + "%";
}
const unsigned = x => percent(x).replace("+", "");
const range = (e, say) => `${say(e.low)} to ${say(e.high)}`;
const withRange = (e, say) => estimate(e) ? `${say(e.value)} (${range(estimate(e), say)})` : none;

// ---- elements
const d3Symbol = { unbiased: "circle", biased: "diamond", undecided: "square" };
function addMark(parent, kind, size = 1) { // at the origin of `parent`; hollow diamonds are biased
  const area = { unbiased: 95, biased: 92, undecided: 88 }[kind] * size;
  parent.append("g").attr("class", "mark " + kind).append("path").attr("d", d3.svg.symbol().type(d3Symbol[kind]).size(area)());
}
/// Ticks of a logarithmic scale that have room for labels.
function logTicks([low, high]) {
  const decades = Math.log10(high / low);
  const mantissas = decades > 2 ? [1] : decades > 1.8 ? [1, 3] : decades > 0.6 ? [1, 2, 5] : [1, 1.5, 2, 3, 4, 5, 6, 8];
  const ticks = [];
  for (let e = Math.floor(Math.log10(low)); e <= Math.ceil(Math.log10(high)); ++e)
    for (const m of mantissas) ticks.push(Number(`${m}e${e}`));
  return ticks.filter(t => t >= low && t <= high);
}

// ---- the head of the page
function addFacts() {
  const add = (term, ...content) => { if (content.some(Boolean)) byId("facts").append(element("dt", {}, term), element("dd", {}, ...content)); };
  const join = parts => parts.filter(Boolean).join(", ");
  const { machine, truth, scene } = results;
  add("made by", join([results.program && "plumbline " + results.program, results.date,
    machine?.processor && `${machine.processor}${finite(machine.threads) ? `, ${machine.threads} thread${machine.threads === 1 ? "" : "s"}` : ""}`]));
  if (results.command) add("command", element("code", {}, results.command));
  add("measured", join([finite(results.width) && finite(results.height) && `${results.width} × ${results.height} pixels`,
    finite(results.rounds) && `${results.rounds} rounds`, finite(results.seconds) && `${results.seconds} s in all`,
    finite(results.seed) && `seed ${results.seed}`, finite(results.confidence) && `intervals of ${number(100 * results.confidence, 2)}%`,
    scene?.hash && `scene ${scene.hash}`]));
  if (truth) add("truth", join([truth.source, finite(truth.samples) && `${truth.samples} samples per pixel`,
    finite(truth.relmse) && `its own relMSE ${number(truth.relmse, 2)}`,
    finite(truth.whole_error) && `its mean known within ${unsigned(truth.whole_error)}`]));
  const times = results.noise_of_machine;
  if (times?.sentence) add("times", times.sentence);
}
function addLead() {
  const count = (n, what) => `${n} ${what}${n === 1 ? "" : "s"}`;
  const lead = byId("lead");
  lead.append(`${count(measured.length, "configuration")} of the renderer, measured for speed, noise and bias.`);
  const front = (results.front ?? []).filter(f => f && f.configuration);
  const biased = f => measured.some(c => c.name === f.configuration && kindOf(c) === "biased");
  front.forEach((f, i) => {
    const from = finite(f.from) ? shortSeconds(f.from) : "0 s", to = finite(f.to) ? shortSeconds(f.to) : "";
    const when = front.length === 1 ? " at any time measured" : i === front.length - 1 ? ` after ${from}` : ` from ${from} to ${to}`;
    lead.append(i === 0 ? " The least error has " : i === front.length - 1 ? " and " : ", ", element("b", {}, f.configuration), biased(f) ? " (biased)" : "", when);
  });
  if (front.length) lead.append(".");
  const wrong = measured.filter(c => kindOf(c) === "biased").length, failed = configurations.length - measured.length;
  if (wrong) lead.append(` ${count(wrong, "configuration")} ${wrong === 1 ? "is" : "are"} biased.`);
  if (failed) lead.append(` ${count(failed, "configuration")} could not be measured.`);
}
function showNotices() {
  const noise = results.noise_of_machine;
  if (noise && noise.half_width > noise.stated) {
    byId("too-noisy").hidden = false;
    byId("too-noisy").textContent = `Too noisy: the times have a relative half width of ${unsigned(noise.half_width)}, ` +
      `more than the ${unsigned(noise.stated)} asked for. Measure again on a machine with nothing else to do, or for longer.`;
  }
  if (results.complete === false) {
    byId("interrupted").hidden = false;
    byId("interrupted").textContent = "Interrupted: the measurement ended before all rounds were done. The intervals are wider than intended.";
  }
}
if (location.hash === "#plot") document.body.classList.add("plot-only");
addFacts();
addLead();
showNotices();
