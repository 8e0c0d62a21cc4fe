// A calibration: fitted parameters with intervals, measured and simulated curves, and all evaluations.
import { provenanceOf, rowsOf } from "./about.js";
import { chart } from "./chart.js";
import { h, labelled, plainTable, section, select } from "./dom.js";
import { format, scaledNumber, words } from "./format.js";
import { sortedTable } from "./table.js";
import { numberTable } from "./unpack.js";

const percent = (part) => (part === null || part === undefined ? "not known" : `${format(100 * part, 3)} %`);

export async function calibrationSections(data) {
  const { calibration } = data;
  const fits = await Promise.all(data.fits.map(async ({ fit, run }) => ({ fit: fit && (await numberTable(fit)), run: run && (await numberTable(run)) })));
  const left = Object.fromEntries(Object.entries(calibration).filter(([key]) => ["file", "status", "misfit", "wall_seconds"].includes(key)));
  return [numbers(calibration), fitted(calibration, fits), correlations(calibration), misfits(calibration, data.table),
    data.table && section("table", "Evaluations", sortedTable(data.table, { caption: "Evaluations" })),
    section("origin", "Provenance", plainTable(null, [...provenanceOf(calibration), ...rowsOf(left)], "Provenance of the calibration", { class: "pairs" }))];
}

export function calibrationWarnings({ warnings = [] }) {
  return warnings.length > 0 && h("div", { class: "notice warnings", role: "note" }, h("p", {}, "Warnings:"), h("ul", {}, warnings.map((text) => h("li", {}, text))));
}

// Returns the mark of a parameter: "good" if the data determine it and the model describes them, "open" if the model does not.
function trust(number, fits) {
  if (!number.determined) return "bad";
  return fits === false ? "open" : "good";
}

function numbers({ numbers: all = [], fits }) {
  const interval = ({ low, high, unit }) => (low === null || high === null || low === undefined ? "not known" : `${scaledNumber(low, unit)} to ${scaledNumber(high, unit)}`);
  const sigma = ({ scale, sigma: s, from, to, unit }) => (scale === "log" ? percent(s) : s === null || s === undefined ? "not known" : scaledNumber((s * (to - from)) / 3, unit));
  const derivatives = ({ derivatives: from, why_differences: why }) =>
    from === "run" ? "from the run" : from === "differences" ? (why ? `finite differences: ${why}` : "finite differences") : "not known";
  return section("numbers", "Parameters", plainTable(["parameter", "value", "95 % interval", "standard deviation", "searched from", "to", "sensitivities", "keys"],
    all.map((n) => [n.name, h("strong", {}, scaledNumber(n.value, n.unit)), interval(n), h("span", { class: `mark ${trust(n, fits)}` }, sigma(n)), scaledNumber(n.from, n.unit),
      scaledNumber(n.to, n.unit), derivatives(n), [...new Set(Object.values(n.keys ?? {}).flat())].join(", ")]), "Parameters"));
}

function fitted({ experiments = [] }, fits) {
  const charts = experiments.flatMap((one, i) => {
    const { fit, run } = fits[i] ?? {};
    if (!fit) return [];
    const [x] = fit.columns;
    return [chart({
      title: `${one.name}: ${words(one.y)} over ${words(one.x)}`, height: 320,
      note: `RMS residual ${scaledNumber(one.rms, one.y_unit)} (${one.points} points)${one.noise ? `; the noise is ${scaledNumber(one.noise, one.y_unit)}` : ""}.`,
      x: { name: words(one.x), unit: one.x_unit }, y: { name: words(one.y), unit: one.y_unit },
      series: [...(run ? [{ label: "simulated", index: 0, x: run.get(run.columns[0]), y: run.get("simulated") }] : []),
        { label: "measured", index: 1, points: true, line: false, x: fit.get(x), y: fit.get("measured") }],
    }), chart({
      title: `${one.name}: residuals`, height: 160, note: "Simulated minus measured.", x: { name: words(one.x), unit: one.x_unit }, y: { name: "difference", unit: one.y_unit, zero: true },
      series: [{ label: "difference", index: 1, points: true, line: false, x: fit.get(x), y: Array.from(fit.get("simulated"), (v, k) => v - fit.get("measured")[k]) }],
    })];
  });
  return charts.length > 0 && section("fits", "Measured and simulated", h("div", { class: "charts wide" }, charts));
}

function correlations({ numbers: all = [], correlation = [], combinations = [] }) {
  if (combinations.length === 0) return null;
  return section("combinations", "Determined combinations",
    h("p", { class: "note" }, "Independent combinations of parameters, the best determined one first. The data do not determine combinations with a large standard deviation."),
    plainTable(["combination", "standard deviation"], combinations.map((one) => [one.text, percent(one.sigma)]), "Combinations of parameters"),
    all.length > 1 && h("h3", {}, "Correlations"),
    all.length > 1 && plainTable(["", ...all.map((n) => n.name)], all.map((n, i) => [n.name, ...correlation[i].map((c) => (c === null ? "not known" : format(c, 3)))]), "Correlations of parameters"));
}

// Draws the misfit of each evaluation against its number or a parameter, with a mark for each phase.
function misfits({ numbers: all = [] }, table) {
  if (!table) return null;
  const column = (name) => table.columns.indexOf(name);
  const phases = [...new Set(table.rows.map((row) => row[column("phase")]))];
  let chosen = "number";
  const holder = h("div", { class: "charts wide" });
  const draw = () => {
    const number = all.find((n) => n.name === chosen);
    const of = (phase) => table.rows.filter((row) => row[column("phase")] === phase && row[column("misfit")] > 0);
    holder.replaceChildren(chart({
      title: `Misfit against ${words(chosen)}`, height: 320, note: "The sum of squared residuals, in units of the noise if it is known.",
      x: { name: chosen === "number" ? "evaluation" : words(chosen), unit: number?.unit, loose: true, log: number?.scale === "log" }, y: { name: "misfit", log: true },
      series: phases.map((phase, index) => ({ label: phase, index, points: true, line: false, x: of(phase).map((row) => row[column(chosen)]), y: of(phase).map((row) => row[column("misfit")]) }))
        .filter((one) => one.x.length > 0),
    }));
  };
  draw();
  return section("misfits", "Search", h("div", { class: "bar" },
    labelled("Horizontal", select([["number", "evaluation"], ...all.map((n) => [n.name, words(n.name)])], chosen, (value) => { chosen = value; draw(); }))), holder);
}
