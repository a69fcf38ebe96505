"use strict";
// The table of limits.
function limitWords(axis, limit) { return (limit.safe < axis.ordinary ? "down to " : "up to ") + number(limit.safe); }
function addLimits() {
  const rows = axes.flatMap(axis => limitsOf(axis).map(limit => ({ axis, limit })));
  byId("limit-section").hidden = rows.length === 0;
  const head = element("tr", {}, ...["axis", "method", "safe", "largest bound", "what fails beyond", "because"].map(t => element("th", {}, t)));
  const body = rows.map(({ axis, limit }) => {
    const bounds = (limit.bound ?? []).map(b => b[1]).filter(finite);
    return element("tr", {}, element("td", {}, element("a", { href: "#" + idOf(axis) }, axis.name ?? "")), element("td", {}, limit.method ?? ""),
      element("td", { class: "n" }, limitWords(axis, limit)), element("td", { class: "n" }, bounds.length ? number(Math.max(...bounds), 2) : none),
      element("td", {}, finite(limit.beyond) ? `${limit.failure ?? ""} at ${number(limit.beyond)}` : "no failure found"), element("td", {}, limit.because ?? ""));
  });
  byId("limits").append(element("table", {}, element("thead", {}, head), element("tbody", {}, ...body)));
}
addLimits();
