// The subset of Markdown that `tack compare` writes: headings, paragraphs, tables, **bold**, *italic*, `code`, \ before a literal
// character.
import { h, plainTable } from "./dom.js";

function inline(text) {
  const parts = [];
  let plain = "";
  const flush = () => { if (plain) parts.push(plain); plain = ""; };
  const marks = [["**", "strong"], ["*", "em"], ["`", "code"]];
  for (let i = 0; i < text.length;) {
    const mark = marks.find(([sign]) => text.startsWith(sign, i));
    const end = mark ? text.indexOf(mark[0], i + mark[0].length + 1) : -1;
    if (text[i] === "\\" && i + 1 < text.length) {
      plain += text[i + 1];
      i += 2;
    } else if (end > 0) {
      flush();
      parts.push(h(mark[1], {}, text.slice(i + mark[0].length, end).replace(/\\(.)/g, "$1")));
      i = end + mark[0].length;
    } else plain += text[i++];
  }
  flush();
  return parts;
}

// Returns the cells of "| a | b |".
const cells = (line) => line.trim().slice(1, -1).split(/(?<!\\)\|/).map((cell) => cell.trim());

export function markdown(text) {
  const out = [];
  let title = "";
  const blocks = text.split(/\n{2,}/).map((block) => block.trim()).filter(Boolean);
  for (const block of blocks) {
    const lines = block.split("\n");
    const heading = /^(#+) (.*)$/.exec(lines[0]);
    if (heading) out.push(h("h3", {}, ...inline((title = heading[2]))));
    const rest = heading ? lines.slice(1) : lines;
    if (rest.length === 0) continue;
    if (rest.length > 1 && rest[0].startsWith("|") && /^[|\s:-]+$/.test(rest[1]))
      out.push(plainTable(cells(rest[0]), rest.slice(2).map((line) => cells(line).map((cell) => h("span", {}, ...inline(cell)))), title));
    else out.push(h("p", {}, ...inline(rest.join(" "))));
  }
  return h("div", { class: "markdown" }, out);
}
