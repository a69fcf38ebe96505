"use strict";
// What the pages have in common: the data, numbers as text, and elements.
const results = JSON.parse(document.getElementById("data").textContent);
const byId = id => document.getElementById(id);
const finite = x => typeof x === "number" && Number.isFinite(x);

// ---- numbers as text
const minus = text => text.replace("-", "−");
const raised = n => String(n).replace(/./g, c => "⁰¹²³⁴⁵⁶⁷⁸⁹"[c] ?? "⁻");
const none = "–";
function number(x, digits = 3) {
  if (!finite(x)) return none;
  if (x === 0) return "0";
  const [mantissa, power] = x.toExponential(digits - 1).split("e"); // rounded; also the smallest and largest doubles
  const exponent = Number(power);
  if (exponent < -3 || exponent > 5) return minus(mantissa) + "\u00a0×\u00a010" + raised(exponent);
  return minus(Number(x.toPrecision(digits)).toFixed(Math.max(0, digits - 1 - exponent)));
}

// ---- elements
function element(name, attributes = {}, ...content) {
  const e = document.createElement(name);
  for (const [key, value] of Object.entries(attributes)) e.setAttribute(key, value);
  e.append(...content);
  return e;
}
