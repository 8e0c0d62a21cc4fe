// A comparison of solvers: time against error, performance profile, and the whole table.
import { chart } from "./chart.js";
import { h, labelled, section, select } from "./dom.js";
import { format } from "./format.js";
import { markdown } from "./markdown.js";
import { profileChart } from "./profile.js";
import { sortedTable } from "./table.js";

const rowsWith = ({ columns, rows }) => rows.map((row) => Object.fromEntries(columns.map((name, c) => [name, row[c]])));

export function comparisonSections({ table, text }) {
  const rows = rowsWith(table);
  return [h("div", { id: "plots" }, precisionSection(rows), profileSection(rows)),
    section("table", "All combinations", sortedTable(table, {
      caption: "All combinations",
      mark: (row, c) => (table.columns[c] === "status" && row[c] !== "converged" ? h("span", { class: "mark bad" }, row[c] ?? "") : null),
    })),
    text && section("text", "Report", markdown(text.replace(/^# .*\n/, "")))];
}

const unique = (values) => [...new Set(values)];
// Another minimum of a single step, which has an energy gap, is a solution; another branch of a run is not. Tables of earlier versions have no column `solved`.
const solved = (row) => (row.solved === undefined ? row.status === "converged" && (row.branch !== "another" || row.energy_gap !== null) : row.solved === 1) && row.wall_seconds > 0;

// Returns true for an error below the noise floor, the distance of the two references: it has no point.
const belowFloor = (row) => row.error_floor !== undefined && row.error_floor !== null && row.error_rms !== null && row.error_rms <= row.error_floor;

const costs = [["wall_seconds", "wall time", "s"], ["cpu_seconds", "processor time", "s"], ["iterations", "iterations"], ["evaluations", "evaluations"], ["linear_solves", "linear solves"]];

// Draws a curve per solver and time step, with a point per tolerance.
function precisionSection(rows) {
  const problems = unique(rows.map((row) => row.problem));
  const steps = unique(rows.map((row) => row.time_step));
  const solvers = unique(rows.map((row) => row.solver));
  let [problem, cost] = [problems[0], costs[0]];
  const holder = h("div", { class: "charts wide" });
  const draw = () => {
    const series = solvers.flatMap((solver, index) => steps.flatMap((step) => {
      const some = rows.filter((row) => row.problem === problem && row.solver === solver && row.time_step === step && solved(row) && row.error_rms > 0 && !belowFloor(row))
        .sort((a, b) => b.tolerance - a.tolerance);
      if (some.length === 0) return [];
      const several = unique(rows.filter((row) => row.problem === problem).map((row) => row.time_step)).length > 1;
      return [{ label: several ? `${solver}, h = ${step} s` : solver, index, points: true, x: some.map((row) => row.error_rms), y: some.map((row) => row[cost[0]]) }];
    }));
    const here = rows.filter((row) => row.problem === problem && solved(row));
    const hidden = here.filter(belowFloor).length;
    const heights = series.flatMap((one) => one.y).filter((v) => v > 0);
    for (const floor of heights.length > 0 ? unique(here.map((row) => row.error_floor).filter((v) => v > 0)) : [])
      series.push({ label: `floor ${format(floor, 2)} m`, index: solvers.length, x: [floor, floor], y: [Math.min(...heights), Math.max(...heights)] });
    const omitted = hidden === 0 ? "" : hidden === here.length ? " All errors are below the noise floor, and nothing is drawn."
      : ` ${hidden} of ${here.length} have no point: their errors are below the noise floor.`;
    holder.replaceChildren(chart({
      title: `${cost[1][0].toUpperCase()}${cost[1].slice(1)} against error: ${problem}`, note: `A curve per solver, a point per tolerance. Lower is faster, further left more accurate.${omitted}`,
      x: { name: "RMS error", unit: "m", log: true }, y: { name: cost[1], unit: cost[2], log: true }, height: 340, series,
    }));
  };
  draw();
  return section("precision", "Time against error", h("div", { class: "bar" },
    labelled("Problem", select(problems.map((p) => [p, p]), problem, (value) => { problem = value; draw(); })),
    labelled("Cost", select(costs.map(([key, name]) => [key, name]), cost[0], (value) => { cost = costs.find(([key]) => key === value); draw(); }))), holder);
}

function profileSection(rows) {
  return section("profile", "Performance profile", h("div", { class: "charts wide" }, profileChart({
    rows, taskOf: (row) => JSON.stringify([row.problem, row.tolerance, row.time_step]), costOf: (row) => (solved(row) ? row.wall_seconds : null),
    title: "Fraction of tasks solved", cost: "fastest time",
    note: "The fraction of all tasks (problem, tolerance, time step) that a solver solves within a multiple of the fastest time.",
  })));
}
