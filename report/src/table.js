// A table that can be sorted by columns and filtered by a text or a comparison ("wall_seconds > 2").
import { button, freshId, h, labelled } from "./dom.js";
import { format, words } from "./format.js";

const shownRows = 500;

const isNumber = (v) => typeof v === "number";

// Compares cells: numbers first, then texts; empty cells come last in both directions.
function compare(a, b, direction) {
  if (a === null || b === null) return a === b ? 0 : a === null ? 1 : -1;
  if (isNumber(a) !== isNumber(b)) return isNumber(a) ? -direction : direction;
  return direction * (isNumber(a) ? a - b : a.localeCompare(b, "en", { numeric: true }));
}

const comparisons = { "<": (a, b) => a < b, "<=": (a, b) => a <= b, ">": (a, b) => a > b, ">=": (a, b) => a >= b, "=": (a, b) => a === b, "!=": (a, b) => a !== b };

// Returns a predicate of rows: every word of the text occurs in some cell, and every comparison "column > number" holds.
export function filterOf(text, columns) {
  const tests = [];
  const rest = text.replace(/("[^"]+"|[^\s"<>=!]+)\s*(<=|>=|!=|<|>|=)\s*("[^"]*"|[^\s"]+)/g, (whole, name, sign, value) => {
    const plain = (t) => t.replace(/^"|"$/g, "");
    const wanted = plain(name).toLowerCase();
    const c = columns.findIndex((column) => column.toLowerCase() === wanted || words(column).toLowerCase() === wanted);
    if (c < 0) return whole;
    const number = Number(plain(value));
    tests.push((row) => (isNumber(row[c]) && !Number.isNaN(number)
      ? comparisons[sign](row[c], number)
      : row[c] !== null && comparisons[sign](String(row[c]).toLowerCase(), plain(value).toLowerCase())));
    return "";
  });
  for (const word of rest.toLowerCase().split(/\s+/).filter(Boolean))
    tests.push((row) => row.some((cell) => cell !== null && String(cell).toLowerCase().includes(word)));
  return (row) => tests.every((test) => test(row));
}

// changed(rows) is called with the filtered rows in their order. mark(row, column) may return an element for a cell.
export function sortedTable({ columns, rows }, { caption, changed = () => {}, mark = () => null }) {
  let sorted = null;
  let direction = 1;
  const filter = h("input", { type: "search", placeholder: `a word, or ${columns.find((c, i) => rows.some((row) => isNumber(row[i]))) ?? columns[0]} > 1`, oninput: () => draw() });
  const count = h("output", { class: "count", for: (filter.id = freshId("filter")), "aria-live": "polite" });
  const heads = columns.map((name, c) => h("th", { scope: "col", class: c > 0 && !rows.some((row) => isNumber(row[c])) ? "text" : null, "aria-sort": "none" }, button(words(name), () => {
    direction = sorted === c ? -direction : 1;
    sorted = c;
    heads.forEach((head, i) => head.setAttribute("aria-sort", i !== c ? "none" : direction > 0 ? "ascending" : "descending"));
    draw();
  }, { title: name })));
  const body = h("tbody");
  const draw = () => {
    const accepts = filterOf(filter.value, columns);
    const left = rows.filter(accepts);
    if (sorted !== null) left.sort((a, b) => compare(a[sorted], b[sorted], direction));
    count.textContent = left.length === rows.length ? `${rows.length} rows` : `${left.length} of ${rows.length} rows`;
    if (left.length > shownRows) count.textContent += `, the first ${shownRows} shown`;
    body.replaceChildren(...left.slice(0, shownRows).map((row) => h("tr", {}, row.map((value, c) =>
      h(c === 0 ? "th" : "td", { class: isNumber(value) ? "number" : null, scope: c === 0 ? "row" : null, title: isNumber(value) ? String(value) : null },
        mark(row, c) ?? (value === null ? "" : isNumber(value) ? format(value) : value))))));
    changed(left);
  };
  const element = h("div", { class: "sorted" },
    h("div", { class: "bar" }, labelled("Filter", filter, { class: "field grow" }), count),
    h("div", { class: "scroll tall", tabindex: 0, role: "region", "aria-label": caption },
      h("table", { class: "numbers" }, h("caption", { class: "hidden" }, caption), h("thead", {}, h("tr", {}, heads)), body)));
  draw();
  return element;
}
