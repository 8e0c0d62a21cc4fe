// What a run is and what became of it: facts, expectations, provenance, its scene.
import { h, lazyDetails, plainTable, section } from "./dom.js";
import { duration, format, words } from "./format.js";

const open = new Set(["unfinished", "interrupted", "waiting", "running"]);

export function statusBadge(status) {
  return h("span", { class: `badge ${status === "done" ? "good" : open.has(status) ? "open" : "bad"}` }, status);
}

export function head(title, about, badges) {
  return h("header", {}, h("p", { class: "kind" }, "tack report"), h("h1", {}, title, " ", ...badges), about && h("p", { class: "about" }, about));
}

export function notesOf(notes) {
  return notes.length > 0 && h("div", { class: "notice", role: "note" }, h("p", {}, "Not everything could be read:"), h("ul", {}, notes.map((note) => h("li", {}, note))));
}

// What the runs warned of: it is told before what they show.
export function warnings(runs) {
  const lines = runs.flatMap((run) => (run.summary?.warnings ?? []).map(({ text, times }) => [runs.length > 1 ? `${run.label}: ` : "", text, times]));
  return lines.length > 0 && h("div", { class: "notice warnings", role: "note" }, h("p", {}, runs.length > 1 ? "The runs warned:" : "The run warned:"),
    h("ul", {}, lines.map(([label, text, times]) => h("li", {}, label, text, times > 1 && ` (and ${times - 1} more of the kind)`))));
}

function factsOf({ summary: s, scene, steps, frames }) {
  const facts = [];
  const last = steps?.get("time")?.at(-1);
  if (last !== undefined) facts.push(["simulated", duration(last)]);
  if (s) {
    facts.push(["steps", format(s.steps)], ["unknowns", format(s.dofs)], ["Newton iterations", format(s.totals?.newton_iterations)],
      ["wall time", duration(s.wall_seconds)], ["threads", format(s.threads)], ["smallest gap", `${format(s.min_gap ?? s.min_distance)} m`],
      ["most contacts", format(s.max_contacts)], ["intersections", format(s.intersections)]);
  } else if (steps) facts.push(["steps", format(steps.rows ? steps.get("step").at(-1) : 0)]);
  if (scene) facts.push(["objects", format(scene.objects.length)]);
  if (frames) facts.push(["frames", frames.times.length === frames.written ? format(frames.written) : `${frames.times.length} of ${frames.written}`]);
  return facts;
}

export function facts(runs) {
  if (runs.length === 1) {
    return h("dl", { class: "facts" }, factsOf(runs[0]).map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
  }
  const of = runs.map((run) => new Map(factsOf(run)));
  const names = [...new Set(of.flatMap((map) => [...map.keys()]))];
  return plainTable(["run", "status", ...names], runs.map((run, i) => [run.label, statusBadge(run.status), ...names.map((name) => of[i].get(name) ?? "–")]), "The runs");
}

const mark = (pass) => h("span", { class: `mark ${pass === null ? "open" : pass ? "good" : "bad"}` },
  h("span", { "aria-hidden": "true" }, pass === null ? "○ " : pass ? "✓ " : "✗ "), pass === null ? "not known" : pass ? "pass" : "fail");

// Unfinished runs know what they must show, but not whether they do.
function expectationsOf(run) {
  const judged = run.summary?.expect ?? [];
  if (judged.length > 0) return judged;
  return (run.scene?.expect ?? []).map((name) => ({ name, pass: null, text: "the run is not finished" }));
}

export function expectations(runs) {
  const rows = runs.flatMap((run) => expectationsOf(run).map((e) => [...(runs.length > 1 ? [run.label] : []), e.name, mark(e.pass), e.text]));
  const failed = runs.flatMap(expectationsOf).filter((e) => e.pass === false).length;
  if (rows.length === 0) return section("expectations", "What it must show", h("p", { class: "note" }, "The scene says nothing of what its run must show."));
  return section("expectations", "What it must show",
    failed > 0 && h("p", { class: "notice bad" }, failed === 1 ? "One expectation failed." : `${failed} expectations failed.`),
    plainTable([...(runs.length > 1 ? ["run"] : []), "expectation", "result", "value"], rows, "Expectations", { class: "expectations" }));
}

function textOf(value) {
  if (value === null || value === "") return "–";
  if (Array.isArray(value)) return value.map(textOf).join(" ");
  if (typeof value === "object") return Object.entries(value).map(([key, inner]) => `${words(key)} ${textOf(inner)}`).join(", ");
  return typeof value === "number" ? format(value, 6) : String(value);
}

// [[key, value]] of whatever stands in objects, nested ones by the keys on the way.
export function rowsOf(object, before = "") {
  return Object.entries(object).flatMap(([key, value]) => {
    const name = before ? `${before}, ${words(key)}` : words(key);
    return value !== null && typeof value === "object" && !Array.isArray(value) ? rowsOf(value, name) : [[name, textOf(value)]];
  });
}

const leadingKeys = ["version", "commit", "threads", "linear_solver"];

// What provenance says as well is left to it.
export function provenanceOf(summary) {
  const leading = Object.fromEntries(leadingKeys.filter((key) => summary?.[key] !== undefined && summary[key] !== "" && summary.provenance?.[key] === undefined)
    .map((key) => [key, summary[key]]));
  return [...rowsOf(leading), ...rowsOf(summary?.provenance ?? {})];
}

export function provenance(runs, extra = []) {
  const parts = runs.map((run) => {
    const rows = provenanceOf(run.summary);
    return [runs.length > 1 && h("h3", {}, run.label),
      run.summary?.error && h("p", { class: "notice bad" }, run.summary.error),
      rows.length > 0 ? plainTable(null, rows, `Provenance of ${run.label}`, { class: "pairs" }) : h("p", { class: "note" }, "Nothing is known: there is no summary.json."),
      run.summary && lazyDetails("All totals of the run", () => plainTable(null,
        rowsOf(Object.fromEntries(Object.entries(run.summary).filter(([key]) => !["expect", "provenance", "adhesion", "warnings", ...leadingKeys].includes(key)))),
        `Totals of ${run.label}`, { class: "pairs" })),
      run.scene && lazyDetails("Its scene, every default filled in", () => h("pre", { tabindex: 0 }, run.scene.text))];
  });
  return section("provenance", "Where it comes from", extra, parts);
}
