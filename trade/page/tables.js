"use strict";
// Pictures at equal time, what the scene requires, and the table of all numbers.

function addPictures() {
  const shown = configurations.filter(c => !c.problem && typeof c.picture === "string" && c.picture);
  if (shown.length === 0) return;
  byId("picture-section").hidden = false;
  const spent = shown.map(c => c.picture_seconds).filter(finite);
  if (spent.length) byId("picture-note").textContent = `Each was rendered for about ${shortSeconds(Number(d3.median(spent).toPrecision(2)))}, after its build. What looks smooth may still be biased.`;
  for (const c of shown) {
    const kind = kindOf(c);
    const mark = kind === "unbiased" ? "" : element("span", { class: `badge ${kind}` }, kind);
    const count = finite(c.picture_samples) ? `${c.picture_samples} sample${c.picture_samples === 1 ? "" : "s"}` : "";
    const time = finite(c.picture_seconds) ? seconds(c.picture_seconds) : "";
    byId("pictures").append(element("figure", {}, element("img", { src: "data:image/png;base64," + c.picture, alt: `picture of ${c.name}` }),
      element("figcaption", {}, element("b", {}, c.name), element("span", { class: "line" }, count),
        element("span", { class: "line" }, time, mark && time ? ", " : "", mark))));
  }
}

function addRequirements() {
  const list = Array.isArray(results.requirements) ? results.requirements : [];
  if (list.length === 0) return;
  byId("requirement-section").hidden = false;
  const heads = ["what", "the scene has", "left out", "gain", ""];
  byId("requirements").append(element("table", {},
    element("thead", {}, element("tr", {}, ...heads.map(h => element("th", h === "gain" ? { class: "n" } : {}, h)))),
    element("tbody", {}, ...list.map(r => element("tr", {}, element("td", {}, r.what ?? ""), element("td", {}, r.has ?? ""),
      element("td", {}, r.left_out ?? ""), estimateCell(r.gain, times), element("td", {}, r.sentence ?? ""))))));
}

function estimateCell(e, say) {
  const cell = element("td", { class: "n" }, estimate(e) ? say(e.value) : none);
  if (estimate(e) && (e.low !== e.value || e.high !== e.value)) cell.append(element("small", {}, range(estimate(e), say)));
  return cell;
}

// ---- the table: a column has a head, a value to sort by, and a cell
const one = { value: 1, low: 1, high: 1 };
const columns = [
  { head: "configuration", key: c => c.name, cell: c => element("td", {}, c.name) },
  { head: "verdict", key: c => c.bias?.verdict, cell: c => element("td", { class: kindOf(c) }, element("span", { class: `badge ${kindOf(c)}`, title: c.bias?.reason ?? "" }, c.bias?.verdict ?? none)) },
  estimateColumn("time to equal noise", c => c === base ? one : c.time_to_equal_noise, times),
  estimateColumn("efficiency, 1/(relMSE s)", c => c.efficiency, number),
  estimateColumn("speed", c => c === base ? one : c.speed, times),
  estimateColumn("error of the mean", c => c.bias?.whole, percent),
  estimateColumn("strongest evidence of bias", c => c.bias?.worst, percent),
  { head: "where", key: c => c.bias?.worst_region, cell: c => element("td", { class: "where" }, c.bias?.worst_region ?? none) },
  { head: "detectable error", numeric: true, key: c => c.bias?.detectable, cell: c => element("td", { class: "n" }, unsigned(c.bias?.detectable)) },
  estimateColumn("noise, relMSE of 1 sample", c => c.noise, number, c => c.skewed ? "heavy-tailed" : ""),
  estimateColumn("bias², relMSE", c => c.bias_squared, number),
  estimateColumn("relMSE after 1 s", c => c.relmse_1s, number),
  estimateColumn("build, wall", c => c.build?.wall, seconds),
  estimateColumn("build, CPU", c => c.build?.cpu, seconds),
  estimateColumn("sample, wall", c => c.render?.wall, seconds),
  estimateColumn("sample, CPU", c => c.render?.cpu, seconds),
  estimateColumn("memory", c => c.memory, bytes),
  { head: "batches", numeric: true, key: c => c.batches, cell: c => element("td", { class: "n" }, finite(c.batches) ? `${c.batches} × ${c.batch_size ?? 1}` : none) },
  { head: "on the front", key: c => c.front ? "yes" : "no", cell: c => element("td", {}, c.front ? "yes" : "no") },
  { head: "command", key: c => c.command, cell: commandCell }
];
function estimateColumn(head, of, say, note = () => "") {
  return { head, numeric: true, key: c => estimate(of(c))?.value, cell: c => {
    const cell = estimateCell(of(c), say);
    if (note(c)) cell.append(element("small", {}, note(c)));
    return cell;
  } };
}

function commandCell(c) {
  const code = element("code", {}, c.command ?? ""), button = element("button", { class: "copy", type: "button" }, "copy");
  button.addEventListener("click", async () => {
    getSelection().selectAllChildren(code);
    try { await navigator.clipboard.writeText(code.textContent); } catch { document.execCommand("copy"); }
    button.textContent = "copied";
    setTimeout(() => button.textContent = "copy", 1500);
  });
  return element("td", { class: "command" }, ...(c.command ? [button, code] : [none]));
}

/// Rows that have no value come after all others in both directions, and failed configurations after these. Equal rows
/// stay in the order of the measurement.
function sorted(column, direction) {
  const rank = c => isMeasured(c) ? [undefined, null].includes(column?.key(c)) ? 1 : 0 : 2;
  const compare = (a, b) => typeof a === "number" ? a - b : String(a).localeCompare(String(b), "en", { numeric: true });
  return [...configurations].sort((a, b) => rank(a) - rank(b) || (column && rank(a) === 0 ? direction * compare(column.key(a), column.key(b)) : 0));
}

function rowOf(c) {
  if (isMeasured(c)) return element("tr", {}, ...columns.map(column => column.cell(c)));
  return element("tr", { class: "problem" }, element("td", {}, c.name ?? ""),
    element("td", { colspan: columns.length - 2 }, "not measured: " + (c.problem ?? "no times")), commandCell(c));
}

function addTable() {
  if (configurations.length === 0) { byId("table").append("There are no configurations."); return; }
  const body = element("tbody", {}), heads = columns.map(column => {
    const button = element("button", { type: "button" }, column.head);
    const head = element("th", { scope: "col", class: column.numeric ? "n" : "", "aria-sort": "none" }, button);
    button.addEventListener("click", () => {
      const direction = head.getAttribute("aria-sort") === "ascending" ? "descending" : "ascending";
      for (const other of heads) other.setAttribute("aria-sort", other === head ? direction : "none");
      body.replaceChildren(...sorted(column, direction === "ascending" ? 1 : -1).map(rowOf));
    });
    return head;
  });
  body.append(...sorted(null, 1).map(rowOf));
  byId("table").append(element("table", {}, element("thead", {}, element("tr", {}, ...heads)), body));
  byId("table-note").textContent = "Small print: the interval" + (finite(results.confidence) ? ` of ${number(100 * results.confidence, 2)}%` : "") +
    ", for the memory the range over the rounds. Time to equal noise and speed are relative to the base. Click on a column head to sort.";
}

addPictures();
addRequirements();
addTable();
