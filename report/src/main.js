// Builds a page from its data: a run, several runs, a comparison, a suite, a batch, a calibration, or a scene that was not run yet. A served run is updated while it runs
// (live.js).
import "uplot/dist/uPlot.min.css";
import "./style.css";
import { expectations, facts, head, notesOf, provenance, statusBadge, warnings } from "./about.js";
import { batchSections } from "./batch.js";
import { calibrationSections, calibrationWarnings } from "./calibration.js";
import { comparisonSections } from "./comparison.js";
import { contactSection, costSection, energySection, lawSection, probeSection } from "./curves.js";
import { h } from "./dom.js";
import { Live } from "./live.js";
import { previewSections } from "./preview.js";
import { suiteSections } from "./suite.js";
import { numberTable } from "./unpack.js";
import { viewSection } from "./view.js";

const understood = 1;

async function loaded(run) {
  const [steps, probes] = await Promise.all([run.steps, run.probes].map((table) => table && numberTable(table)));
  return { ...run, steps: steps?.rows > 0 ? steps : null, probes: probes?.rows > 0 ? probes : null };
}

const runSections = (runs) => [warnings(runs), expectations(runs), viewSection(runs), probeSection(runs), lawSection(runs), energySection(runs), contactSection(runs),
  costSection(runs), provenance(runs)];

const nameOf = (run) => run.summary?.name ?? run.scene?.name ?? run.label;

async function contentOf(data, runs) {
  if (data.kind === "preview") {
    const [run] = runs;
    return { title: nameOf(run), about: run.scene?.about, badges: [h("span", { class: "badge open" }, "not run yet")], parts: previewSections(data.preview, run) };
  }
  if (data.kind === "comparison") return { title: data.comparison.name || data.title, parts: comparisonSections(data.comparison) };
  if (data.kind === "suite") {
    const { suite } = data.suite;
    return { title: "Leaderboard of solvers", about: `${suite.problems.length} stored steps, ${suite.solvers.length} solvers side by side`,
      badges: suite.complete ? [] : [statusBadge("interrupted")], parts: suiteSections(data.suite) };
  }
  if (data.kind === "batch") {
    const { batch, notes } = data.batch;
    const done = batch.cases.length;
    return {
      title: batch.name ?? data.title, about: batch.about, notes, badges: [h("span", { class: "badge open" }, `${done} case${done === 1 ? "" : "s"}`)],
      parts: [...(await batchSections(data.batch)), ...(runs.length > 0 ? [h("h2", { class: "divider" }, `Runs of ${runs.map((run) => run.label).join(", ")}`), ...runSections(runs)] : [])],
    };
  }
  if (data.kind === "calibration") {
    const { calibration, notes } = data.calibration;
    return {
      title: calibration.name ?? data.title, about: calibration.about, notes, badges: [statusBadge(calibration.status ?? "unfinished")],
      parts: [calibrationWarnings(calibration), ...(await calibrationSections(data.calibration))],
    };
  }
  if (runs.length === 1) {
    const [run] = runs;
    const live = data.live && new Live(data.live, run);
    return { title: nameOf(run), about: run.scene?.about, badges: live ? [] : [statusBadge(run.status)], parts: live ? live.parts : [facts(runs), ...runSections(runs)], live };
  }
  return { title: runs.map((run) => run.label).join(", "), about: `${runs.length} runs overlaid`, parts: [facts(runs), ...runSections(runs)] };
}

function linksOf(parts) {
  return parts.flatMap((part) => [...(part.matches("section") ? [part] : part.querySelectorAll("section"))])
    .map((one) => h("a", { href: `#${one.id}` }, one.querySelector("h2").textContent));
}

async function main() {
  const content = document.getElementById("content");
  const data = JSON.parse(document.getElementById("data")?.textContent ?? "{}");
  if (data.format !== understood) {
    content.append(h("p", { class: "notice bad" }, "This page has no data in a format that it reads: make the report again with `tack report`."));
    return;
  }
  const runs = await Promise.all(data.runs.map(loaded));
  const { title, about, notes = [], badges = [], parts, live } = await contentOf(data, runs);
  document.title = `${title} – tack ${data.kind === "preview" ? "view" : "report"}`;
  const shown = parts.filter(Boolean);
  const contents = h("nav", { "aria-label": "Contents" }, linksOf(shown));
  const notice = notesOf([...notes, ...runs.flatMap((run) => run.notes)]);
  content.append(...[head(title, about, badges, data.kind === "preview" || live ? "tack view" : "tack report"), live && live.bar, contents, notice, ...shown].filter(Boolean));
  document.getElementById("made").textContent = `Made by tack ${data.made.version}${data.made.commit ? ` (${data.made.commit})` : ""}.`;
  live?.begin(() => contents.replaceChildren(...linksOf(shown)));
  document.documentElement.dataset.ready = "true";
}

main();
