// Sections about a run: status, facts, warnings, expectations, provenance and scene.
import { button, h, lazyDetails, plainTable, section } from "./dom.js";
import { byName, duration, format, scaledNumber, words } from "./format.js";

const open = new Set(["unfinished", "interrupted", "waiting", "running"]);

export function statusBadge(status) {
  return h("span", { class: `badge ${status === "done" ? "good" : open.has(status) ? "open" : "bad"}` }, status);
}

export function head(title, about, badges, kind = "tack report") {
  return h("header", {}, h("p", { class: "kind" }, kind), h("h1", {}, title, " ", ...badges), about && h("p", { class: "about" }, about));
}

export function notesOf(notes) {
  return notes.length > 0 && h("div", { class: "notice", role: "note" }, h("p", {}, "Some files could not be read:"), h("ul", {}, notes.map((note) => h("li", {}, note))));
}

// Returns a button with the name of an object: it focuses the 3D view on the object (view.js).
export const objectButton = (name, text = name) => button(text, () => document.dispatchEvent(new CustomEvent("tack-object", { detail: name })), { class: "object", title: `show '${name}' in the 3D view` });

// Replaces the quoted names of objects in a text by such buttons.
export function withObjects(text, scene) {
  const names = new Set(scene?.objects.map(({ name }) => name) ?? []);
  return text.split(/('[^']+')/).map((part) => {
    const name = part.slice(1, -1);
    return part.startsWith("'") && names.has(name) ? objectButton(name, part) : part;
  });
}

// Returns the warnings of the runs; they stand before the results.
export function warnings(runs) {
  const lines = runs.flatMap((run) => (run.summary?.warnings ?? []).map(({ text, times }) =>
    h("li", {}, runs.length > 1 && `${run.label}: `, run.frames ? withObjects(text, run.scene) : text, times > 1 && ` (and ${times - 1} more of this kind)`)));
  return lines.length > 0 && section("warnings", "Warnings", h("div", { class: "notice warnings" }, h("ul", {}, lines)));
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
  return plainTable(["run", "status", ...names], runs.map((run, i) => [run.label, statusBadge(run.status), ...names.map((name) => of[i].get(name) ?? "–")]), "Runs");
}

const mark = (pass) => h("span", { class: `mark ${pass === null ? "open" : pass ? "good" : "bad"}` },
  h("span", { "aria-hidden": "true" }, pass === null ? "○ " : pass ? "✓ " : "✗ "), pass === null ? "unknown" : pass ? "pass" : "fail");

// Returns the expectations of a run; those of an unfinished run have no result.
function expectationsOf(run) {
  const units = byName(Object.fromEntries((run.scene?.expect ?? []).map(({ name, unit }) => [name, unit])));
  const judged = run.summary?.expect ?? [];
  if (judged.length > 0) return judged.map((e) => ({ ...e, ...resultText(e, units[e.name]) }));
  return (run.scene?.expect ?? []).map(({ name, wanted }) => ({ name, pass: null, is: run.status === "done" ? "not judged" : "the run is not finished", wanted: criterion(wanted, units[name]) }));
}

// Returns the accepted range as text: around a target, or between bounds of which one may be open.
function criterion({ target, tolerance, at_least: least, at_most: most }, unit) {
  const number = (n) => scaledNumber(n, unit);
  if (typeof target === "number") return `${number(target)} within ${number(tolerance)}`;
  if (typeof most !== "number") return `at least ${number(least)}`;
  return typeof least === "number" ? `from ${number(least)} to ${number(most)}` : `at most ${number(most)}`;
}

// Returns the result of an expectation as text. Without a number it gives the reason; details of the
// number follow in brackets.
function resultText(e, unit) {
  if (typeof e.value !== "number") return { is: e.text.replace(/, expected [^,]*$/, ""), wanted: criterion(e, unit) };
  const more = /^is \S+ (\(.*\)), expected/.exec(e.text);
  return { is: `${scaledNumber(e.value, unit)}${more ? ` ${more[1]}` : ""}`, wanted: criterion(e, unit) };
}

export function expectations(runs) {
  const all = runs.flatMap((run) => expectationsOf(run).map((e) => ({ run, ...e })));
  const rows = all.map((e) => [...(runs.length > 1 ? [e.run.label] : []), e.name, mark(e.pass), e.is, e.wanted]);
  const failed = all.filter((e) => e.pass === false).length;
  if (rows.length === 0) return section("expectations", "Expectations", h("p", { class: "note" }, "The scene has no expectations."));
  return section("expectations", "Expectations",
    failed > 0 && h("p", { class: "notice bad" }, failed === 1 ? "One expectation failed." : `${failed} expectations failed.`),
    plainTable([...(runs.length > 1 ? ["run"] : []), "expectation", "result", "value", "expected"], rows, "Expectations", { class: "expectations" }));
}

function textOf(value) {
  if (value === null || value === "") return "–";
  if (Array.isArray(value)) return value.map(textOf).join(" ");
  if (typeof value === "object") return Object.entries(value).map(([key, inner]) => `${words(key)} ${textOf(inner)}`).join(", ");
  return typeof value === "number" ? format(value, 6) : String(value);
}

// Returns [[key, value]] of an object; nested objects are flattened, with all keys of the path.
export function rowsOf(object, before = "") {
  return Object.entries(object).flatMap(([key, value]) => {
    const name = before ? `${before}, ${words(key)}` : words(key);
    return value !== null && typeof value === "object" && !Array.isArray(value) ? rowsOf(value, name) : [[name, textOf(value)]];
  });
}

const leadingKeys = ["version", "commit", "threads", "linear_solver"];

// Returns rows of provenance. Leading keys that the provenance also has are omitted.
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
      rows.length > 0 ? plainTable(null, rows, `Provenance of ${run.label}`, { class: "pairs" }) : h("p", { class: "note" }, "Unknown: there is no summary.json."),
      run.summary && lazyDetails("All totals of the run", () => plainTable(null,
        rowsOf(Object.fromEntries(Object.entries(run.summary).filter(([key]) => !["expect", "provenance", "adhesion", "warnings", ...leadingKeys].includes(key)))),
        `Totals of ${run.label}`, { class: "pairs" })),
      run.scene && lazyDetails("Scene with all defaults", () => h("pre", { tabindex: 0 }, run.scene.text))];
  });
  return section("provenance", "Provenance", extra, parts);
}
