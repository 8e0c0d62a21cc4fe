// The charts of runs: probes, laws, energies, contacts, and cost of the steps.
import { chart } from "./chart.js";
import { h, labelled, plainTable, section, select } from "./dom.js";
import { axisTitle, byName, duration, format, quantityOf, words } from "./format.js";
import { colour, onThemeChange } from "./theme.js";

const time = { name: "time", unit: "s" };
const grid = (...charts) => h("div", { class: "charts" }, charts);

export const unitsOf = (run) => Object.fromEntries((run.scene?.probes ?? []).map((probe) => [probe.column, probe.unit]));

const columnsOf = (runs, table, wanted) => [...new Set(runs.flatMap((run) => run[table]?.columns ?? []))].filter(wanted);

// The stages of the first protocol of a single run, from the column of its steps.
export function bandsOf(runs) {
  const run = runs[0];
  const protocol = run?.scene?.protocols?.[0];
  const [numbers, times] = [protocol && run.steps?.get(protocol.column), run?.steps?.get("time")];
  if (runs.length !== 1 || !numbers || !times) return undefined;
  if (run.summary?.stages) return run.summary.stages.filter((one) => one.protocol === protocol.name).map((one) => ({ from: one.begin, to: one.end, label: one.stage }));
  const bands = [];
  numbers.forEach((number, i) => {
    const label = protocol.stages[number - 1];
    if (bands.at(-1)?.label === label) bands.at(-1).to = times[i];
    else bands.push({ from: bands.at(-1)?.to ?? 0, to: times[i], label });
  });
  return bands;
}

// One line per run for a column; several runs keep their colours in every chart.
const linesOf = (runs, table, x, y) => runs.flatMap((run, i) => {
  const [xs, ys] = [run[table]?.get(x), run[table]?.get(y)];
  return xs && ys ? [{ label: run.label, x: xs, y: ys, index: i }] : [];
});

// One line per stage of a single run's protocol; nothing without one.
function linesByStage(runs, x, y) {
  const bands = bandsOf(runs);
  const table = runs[0].probes;
  const [times, xs, ys] = [table?.get("time"), table?.get(x), table?.get(y)];
  if (!bands?.length || !xs || !ys) return null;
  return [...new Set(bands.map((band) => band.label))].map((label) => {
    const own = bands.filter((band) => band.label === label);
    return { label, x: xs, y: ys.map((v, i) => (own.some(({ from, to }) => from <= times[i] && times[i] <= to) ? v : NaN)) };
  });
}

export function probeSection(runs) {
  const columns = columnsOf(runs, "probes", (name) => name !== "time");
  if (columns.length === 0) return section("probes", "Probes", h("p", { class: "note" }, "The run has no probes."));
  const units = byName(...runs.map(unitsOf));
  const charts = runs.length === 1 ? probesByUnit(runs[0], columns, units)
    : columns.map((name) => chart({ title: words(name), bands: bandsOf(runs), x: time, y: { name: words(name), unit: units[name] }, group: "time", series: linesOf(runs, "probes", "time", name) }));
  return section("probes", "Probes", h("p", { class: "note", id: "chart-keys" },
    "Drag across a chart to zoom, double-click to show all. Keys: arrows move along the curve, + and − zoom, 0 shows all."),
    grid(charts), columns.length > 1 && against(runs, columns, units));
}

// Probes of one unit share a chart while it stays readable, if they are of like size.
function probesByUnit(run, columns, units) {
  const largest = (name) => run.probes.get(name).reduce((most, v) => (Number.isFinite(v) ? Math.max(most, Math.abs(v)) : most), 0);
  const charts = [];
  for (const name of columns) {
    const size = largest(name);
    const home = charts.find((one) => one.unit === units[name] && units[name] !== undefined && one.names.length < 4 && size > one.size / 30 && size < one.size * 30);
    if (home) home.names.push(name);
    else charts.push({ unit: units[name], names: [name], size });
  }
  return charts.map(({ unit, names }) => chart({
    title: names.map(words).join(", "), bands: bandsOf([run]), x: time, y: { name: names.length > 1 ? quantityOf(unit) : words(names[0]), unit }, group: "time",
    series: names.map((name) => ({ label: words(name), x: run.probes.get("time"), y: run.probes.get(name) })),
  }));
}

// Chooses the axes: those of an expectation along another probe than time; else a force over a gap, or the first two probes.
function axesOf(runs, columns, units) {
  const named = runs.flatMap((run) => run.scene?.expect ?? []).find(({ probe, along }) => along !== "time" && columns.includes(along) && columns.includes(probe));
  if (named) return [named.along, named.probe];
  const gap = columns.find((name) => /gap|separation|displacement/.test(name));
  return gap ? [gap, columns.find((name) => units[name] === "N") ?? columns.find((name) => name !== gap)] : [columns[0], columns[1]];
}

let chosen = null; // by the user; kept when the chart of a live run is made again

// Returns a chart of any probe against any other.
function against(runs, columns, units) {
  const all = ["time", ...columns];
  const of = byName(units, { time: "s" });
  let [x, y] = chosen?.every((name) => all.includes(name)) ? chosen : axesOf(runs, columns, units);
  const holder = h("div", { class: "charts wide" });
  const draw = () => holder.replaceChildren(chart({
    title: `${words(y)} over ${words(x)}`, bands: x === "time" ? bandsOf(runs) : undefined, x: { name: words(x), unit: of[x], loose: x !== "time" }, y: { name: words(y), unit: of[y] },
    height: 300, series: (x !== "time" && linesByStage(runs, x, y)) || linesOf(runs, "probes", x, y),
  }));
  const options = all.map((name) => [name, words(name)]);
  const choose = () => {
    chosen = [x, y];
    draw();
  };
  draw();
  return h("div", { id: "against" }, h("h3", {}, "One probe over another"),
    h("div", { class: "bar" }, labelled("Vertical", select(options, y, (name) => { y = name; choose(); })), labelled("Horizontal", select(options, x, (name) => { x = name; choose(); }))), holder);
}

// Returns the laws in closed form, beside the force measured between their objects.
export function lawSection(runs) {
  const parts = runs.flatMap((run) => (run.laws ? lawsOf(run).map((law) => lawCharts(run, law, runs.length > 1)) : []));
  return parts.length > 0 && section("laws", "Laws of adhesion",
    h("p", { class: "note" }, "Traction over gap in closed form, as the run computed it: positive in attraction, negative in repulsion by the barrier."), parts);
}

function lawsOf(run) {
  const { columns, rows } = run.laws;
  const at = Object.fromEntries(columns.map((name, c) => [name, c]));
  const laws = new Map();
  for (const row of rows) {
    if (!laws.has(row[at.pair])) laws.set(row[at.pair], { pair: row[at.pair], gap: [], traction: [], barrier: [], adhesion: [] });
    for (const name of ["gap", "traction", "barrier", "adhesion"]) laws.get(row[at.pair])[name].push(row[at[name]]);
  }
  return [...laws.values()];
}

const names = (law, object) => object !== null && object !== undefined && law.pair.includes(`'${object}'`);

function lawCharts(run, law, several) {
  const x = { name: "gap", unit: "m", loose: true };
  // The barrier is drawn down to the largest repulsion of the sum.
  const within = (values) => values.map((v) => (v < 1.05 * Math.min(...law.traction) ? NaN : v));
  const sum = chart({
    title: `Traction, ${law.pair}${several ? ` (${run.label})` : ""}`, x, y: { name: "traction", unit: "Pa" },
    series: [{ label: "sum", x: law.gap, y: law.traction }, { label: "adhesion", x: law.gap, y: law.adhesion }, { label: "barrier", x: law.gap, y: within(law.barrier) }],
  });
  const probes = run.scene?.probes ?? [];
  const force = probes.find((p) => ["contact_force", "adhesion_force"].includes(p.type) && p.unit === "N" && names(law, p.on) && names(law, p.from));
  const gap = probes.find((p) => p.type === "gap" && (p.between ?? []).every((object) => names(law, object)));
  if (!force || !gap || !run.probes?.get(force.column)) return grid(sum);
  const range = Math.max(...law.gap);
  const xs = run.probes.get(gap.column);
  const ys = run.probes.get(force.column).map((v, i) => (xs[i] <= range ? v : NaN));
  const holder = h("div");
  const traction = force.type === "adhesion_force" ? law.adhesion : law.traction;
  const sign = Math.sign(ys.reduce((most, v) => (Math.abs(v) > Math.abs(most) ? v : most), 0)) || 1;
  const draw = (area) => holder.replaceChildren(chart({
    title: `Force measured, ${words(force.column)} over ${words(gap.column)}`, x, y: { name: "force", unit: "N" },
    series: [{ label: "measured", x: xs, y: ys }, ...(area > 0 ? [{ label: "law × area", x: law.gap, y: traction.map((t) => sign * t * area) }] : [])],
  }));
  draw(0);
  const area = h("input", { type: "number", min: 0, step: "any", placeholder: "not given", oninput: () => draw(Number(area.value)) });
  return grid(sum, h("div", {}, holder, h("div", { class: "bar" }, labelled("Contact area [m²], to overlay the law", area))));
}

// Returns the cumulative sums of the flows of steps.
function cumulative(values) {
  let sum = 0;
  return Float64Array.from(values, (v) => (sum += Number.isFinite(v) ? v : 0));
}

const nonzero = (run, table, name) => run[table].get(name).some((v) => Math.abs(v) > 0);

export function energySection(runs) {
  const stored = (name) => name.startsWith("energy_");
  const flowing = (name) => name.startsWith("work_") || name.startsWith("dissipated_");
  const charts = runs.filter((run) => run.steps).flatMap((run) => {
    const lines = (wanted, values) => run.steps.columns.filter((name) => wanted(name) && nonzero(run, "steps", name))
      .map((name) => ({ label: words(name.replace(/^energy_/, "")), x: run.steps.get("time"), y: values(run.steps.get(name)) }));
    const [has, gone] = [lines(stored, (v) => v), lines(flowing, cumulative)];
    const of = runs.length > 1 ? `, ${run.label}` : "";
    return [has.length > 0 && chart({ title: `Energy at the end of each step${of}`, x: time, y: { name: "energy", unit: "J" }, series: has, group: "time" }),
      gone.length > 0 && chart({ title: `Cumulative work and dissipation${of}`, x: time, y: { name: "energy", unit: "J" }, series: gone, group: "time" })];
  });
  return charts.some(Boolean) && section("energies", "Energies", grid(charts.filter(Boolean)));
}

// Returns the smallest gaps between objects; if no objects come near each other, the smallest distances within objects.
function gapsOf(runs) {
  const near = runs.some((run) => run.steps?.get("min_gap")?.some(Number.isFinite));
  return near ? linesOf(runs, "steps", "time", "min_gap") : linesOf(runs, "steps", "time", "min_distance");
}

export function contactSection(runs) {
  const some = runs.filter((run) => run.steps);
  if (some.length === 0) return null;
  return section("contacts", "Contact", grid(
    chart({ title: "Smallest gap", x: time, y: { name: "smallest gap", unit: "m", log: true }, series: gapsOf(runs), group: "time" }),
    chart({ title: "Contacts", x: time, y: { name: "contacts", zero: true }, series: linesOf(runs, "steps", "time", "contacts"), group: "time" })));
}

// Time per phase, stacked: of each step, and of the whole run (the paper's figures 17 and 18).
export function costSection(runs) {
  const some = runs.filter((run) => run.steps);
  if (some.length === 0) return null;
  const step = { name: "step" };
  return section("cost", "Cost of the steps",
    grid(some.map((run) => phasesOverSteps(run, runs.length > 1)),
      chart({ title: "Newton iterations per step", x: step, y: { name: "iterations", zero: true }, series: linesOf(runs, "steps", "step", "newton_iterations"), group: "step" }),
      columnsOf(runs, "steps", (name) => name === "linear_iterations").length > 0 && some.some((run) => nonzero(run, "steps", "linear_iterations"))
        && chart({ title: "Iterations of the linear solver per step", x: step, y: { name: "iterations", zero: true }, series: linesOf(runs, "steps", "step", "linear_iterations"), group: "step" })),
    phaseTotals(some));
}

const phaseColumns = (run) => run.steps.columns.filter((name) => name.startsWith("seconds_"));
// A phase has one colour everywhere.
const phaseIndex = (run, name) => Math.max(0, phaseColumns(run).indexOf(`seconds_${name}`));

function phasesOverSteps(run, several) {
  const sum = (name) => run.steps.get(name).reduce((a, b) => a + b, 0);
  const columns = phaseColumns(run).filter((name) => sum(name) > 0).sort((a, b) => sum(b) - sum(a));
  let below = new Float64Array(run.steps.rows);
  const series = columns.map((name) => {
    const lower = below;
    below = lower.map((v, k) => v + run.steps.get(name)[k]);
    return { label: words(name.replace("seconds_", "")), x: run.steps.get("step"), y: below, lower, index: phaseIndex(run, name.replace("seconds_", "")) };
  });
  return chart({ title: `Time per phase of each step${several ? `, ${run.label}` : ""}`, x: { name: "step" }, y: { name: "wall time", unit: "s" }, series, stacked: true, group: "step" });
}

function dotOf(index) {
  const dot = h("span", { class: "dot square" });
  const draw = () => (dot.style.background = colour(index));
  draw();
  onThemeChange(draw);
  return dot;
}

function phaseTotals(runs) {
  const totalsOf = (run) => {
    const of = run.summary?.phases ?? Object.fromEntries(phaseColumns(run).map((name) => [name.replace("seconds_", ""), run.steps.get(name).reduce((a, b) => a + b, 0)]));
    return Object.entries(of).filter(([, seconds]) => seconds > 0).sort((a, b) => b[1] - a[1]);
  };
  return h("div", { class: "totals" }, h("h3", {}, "Total time per phase"), runs.map((run) => {
    const totals = totalsOf(run);
    const sum = totals.reduce((a, [, seconds]) => a + seconds, 0);
    const bar = h("div", { class: "stack", role: "img", "aria-label": totals.map(([name, seconds]) => `${words(name)} ${Math.round((100 * seconds) / sum)} %`).join(", ") });
    const draw = () => bar.replaceChildren(...totals.map(([name, seconds]) => h("span", { style: `flex-grow:${seconds / sum};background:${colour(phaseIndex(run, name))}`, title: `${words(name)}: ${duration(seconds)}` })));
    draw();
    onThemeChange(draw);
    return h("div", {}, runs.length > 1 && h("h4", {}, run.label), bar,
      plainTable(["phase", axisTitle("time", "s"), "share"], totals.map(([name, seconds]) => [h("span", {}, dotOf(phaseIndex(run, name)), words(name)), format(seconds, 3), `${format((100 * seconds) / sum, 3)} %`]),
        `Time per phase of ${run.label}`, { class: "numbers narrow" }));
  }));
}
