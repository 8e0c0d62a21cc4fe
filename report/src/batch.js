// A batch: the table of its cases, any number against any key that was varied, and curves of all cases side by side.
import { provenanceOf, rowsOf, statusBadge } from "./about.js";
import { chart } from "./chart.js";
import { h, labelled, plainTable, section, select } from "./dom.js";
import { byName, format, scaledNumber, words } from "./format.js";
import { sortedTable } from "./table.js";
import { numberTable } from "./unpack.js";

const unique = (values) => [...new Set(values)];
const isNumber = (v) => typeof v === "number";
// Formats the text of a cell: a number in SI gets its unit, other texts are unchanged.
const shown = (text, unit) => (text === undefined || text === null ? "–" : text !== "" && Number.isFinite(Number(text)) ? scaledNumber(Number(text), unit) : text);

export async function batchSections(data) {
  const batch = data.batch;
  const cases = batch.cases.map((one) => ({ ...one, values: one.values && byName(one.values) }));
  const curves = await Promise.all(data.curves.map((table) => table && numberTable(table)));
  const table = data.table ?? fromCases(cases, batch.keys ?? []);
  const keys = (batch.keys ?? []).filter((key) => table.columns.includes(key));
  const state = { left: null, listeners: [] };
  const changed = (rows) => {
    state.left = new Set(rows.map((row) => row[0]));
    state.listeners.forEach((draw) => draw());
  };
  const column = (name) => table.columns.indexOf(name);
  const mark = (row, c) => {
    const name = table.columns[c];
    if (name === "status" && row[c] !== null) return statusBadge(row[c]);
    if (!name.startsWith("expect:") || row[c] === null) return null;
    return h("span", { class: `mark ${row[c] ? "good" : "bad"}` }, row[c] ? "✓ pass" : "✗ fail");
  };
  const sections = [
    section("plots", "Results against varied keys", plotAgainst(table, keys, column, state, (batch.statistics ?? []).map((one) => one.name), byName(batch.units))),
    section("multiples", "Curves of all cases", smallMultiples(cases, curves, byName(data.units), keys, state, byName(batch.units))),
  ];
  const cases_ = section("table", "Cases", h("p", { class: "note" }, "The filter also applies to the plots below."), sortedTable(table, { caption: "Cases", changed, mark }));
  return [cases_, ...sections, section("origin", "Provenance",
    plainTable(null, [...provenanceOf(batch), ...rowsOf(Object.fromEntries(Object.entries(batch).filter(([key]) => !["name", "about", "cases", "provenance", "version", "commit", "statistics", "units"].includes(key))))],
      "Provenance of the batch", { class: "pairs" }))];
}

// Returns the table of a batch without results.csv.
function fromCases(cases, keys) {
  return { columns: ["case", ...keys, "status"], rows: cases.map((one) => [one.name, ...keys.map((key) => one.values?.[key] ?? null), one.status ?? null]) };
}

function plotAgainst(table, keys, column, state, statistics, units) {
  const numeric = table.columns.filter((name, c) => c > 0 && table.rows.some((row) => isNumber(row[c])));
  const results = numeric.filter((name) => !keys.includes(name));
  if (keys.length === 0 || results.length === 0) return h("p", { class: "note" }, "There is no varied key, or no number to plot.");
  // Statistics of the runs are preferred to their cost.
  const first = results.find((name) => statistics.includes(name)) ?? results.find((name) => name.includes(".")) ?? results[0];
  const chosen = { x: keys[0], y: first, by: keys[1] ?? "", logX: false, logY: false };
  const holder = h("div", { class: "charts wide" });
  const draw = () => {
    const [cx, cy, cb] = [column(chosen.x), column(chosen.y), column(chosen.by)];
    const rows = table.rows.filter((row) => (!state.left || state.left.has(row[0])) && row[cx] !== null && isNumber(row[cy]));
    const texts = unique(table.rows.map((row) => row[cx])).filter((v) => v !== null && !isNumber(v));
    const at = (v) => (isNumber(v) ? v : texts.indexOf(v) + 1);
    const groups = cb < 0 ? [null] : unique(rows.map((row) => row[cb])).sort((a, b) => (isNumber(a) && isNumber(b) ? a - b : String(a).localeCompare(String(b))));
    const series = groups.map((value, index) => {
      const some = rows.filter((row) => cb < 0 || row[cb] === value).sort((a, b) => at(a[cx]) - at(b[cx]));
      return { label: cb < 0 ? words(chosen.y) : `${words(chosen.by)} = ${isNumber(value) ? scaledNumber(value, units[chosen.by]) : value ?? "none"}`, index, points: true, line: new Set(some.map((row) => row[cx])).size === some.length, x: some.map((row) => at(row[cx])), y: some.map((row) => row[cy]) };
    });
    holder.replaceChildren(chart({
      title: `${words(chosen.y)} against ${words(chosen.x)}`, height: 340, series,
      note: texts.length > 0 ? `${words(chosen.x)}: ${texts.map((text, i) => `${i + 1} is ${text}`).join(", ")}` : undefined,
      x: { name: words(chosen.x), unit: units[chosen.x], loose: true, log: chosen.logX }, y: { name: words(chosen.y), unit: units[chosen.y], log: chosen.logY },
    }));
  };
  state.listeners.push(draw);
  draw();
  const choose = (key, options) => select(options.map((name) => [name, words(name) || "nothing"]), chosen[key], (value) => { chosen[key] = value; draw(); });
  const log = (key) => select([["", "linear"], ["log", "logarithmic"]], "", (value) => { chosen[key] = value === "log"; draw(); });
  return h("div", {}, h("div", { class: "bar" },
    labelled("Vertical", choose("y", results)), labelled("Scale", log("logY")),
    labelled("Horizontal", choose("x", unique([...keys, ...results]))), labelled("Scale", log("logX")),
    labelled("Grouped by", choose("by", ["", ...keys]))), holder);
}

const mostPanels = 48;

// Draws a small chart per case with equal axes, or all cases in one chart.
function smallMultiples(cases, curves, units, keys, state, keyUnits) {
  const columns = unique(curves.flatMap((table) => table?.columns ?? [])).filter((name) => name !== "time");
  if (columns.length === 0) return h("p", { class: "note" }, "The cases have no probes.");
  const chosen = { y: columns[0], x: "time", how: "grid" };
  const holder = h("div");
  const label = (one) => (one.values && keys.length > 0 ? keys.map((key) => `${words(key)} ${shown(one.values[key], keyUnits[key])}`).join(", ") : one.name);
  const draw = () => {
    const some = cases.map((one, i) => ({ one, table: curves[i] })).filter(({ one, table }) => table?.get(chosen.y) && table.get(chosen.x) && (!state.left || state.left.has(one.name)));
    const x = { name: words(chosen.x), unit: chosen.x === "time" ? "s" : units[chosen.x], loose: chosen.x !== "time" };
    const y = { name: words(chosen.y), unit: units[chosen.y] };
    if (chosen.how === "over") {
      holder.className = "charts wide";
      holder.replaceChildren(chart({ title: `${words(chosen.y)} over ${words(chosen.x)}`, x, y, height: 380, series: some.map(({ one, table }) => ({ label: label(one), x: table.get(chosen.x), y: table.get(chosen.y) })) }));
      return;
    }
    holder.className = "multiples";
    const all = (name) => some.flatMap(({ table }) => Array.from(table.get(name))).filter(Number.isFinite);
    const span = (values) => values.reduce(([low, high], v) => [Math.min(low, v), Math.max(high, v)], [Infinity, -Infinity]);
    const shared = { x: span(all(chosen.x)), y: span(all(chosen.y)) };
    holder.replaceChildren(...some.slice(0, mostPanels).map(({ one, table }) => chart({
      title: one.name, note: keys.length > 0 ? label(one) : undefined, x: { ...x, span: shared.x }, y: { ...y, span: shared.y }, height: 170, plain: true, group: "multiples",
      series: [{ label: words(chosen.y), x: table.get(chosen.x), y: table.get(chosen.y) }],
    })), ...(some.length > mostPanels ? [h("p", { class: "note" }, `The first ${mostPanels} of ${some.length} cases; filter the table to see others.`)] : []));
  };
  state.listeners.push(draw);
  draw();
  const choose = (key, options) => select(options, chosen[key], (value) => { chosen[key] = value; draw(); });
  const named = (list) => list.map((name) => [name, words(name)]);
  return h("div", {}, h("div", { class: "bar" }, labelled("Vertical", choose("y", named(columns))), labelled("Horizontal", choose("x", named(["time", ...columns]))),
    labelled("Shown", choose("how", [["grid", "side by side"], ["over", "overlaid"]]))), holder);
}
