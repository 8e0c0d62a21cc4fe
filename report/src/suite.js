// A suite of stored problems: the leaderboard of its solvers, performance profiles, work against precision, and every solve.
import { provenanceOf } from "./about.js";
import { chart } from "./chart.js";
import { h, plainTable, section } from "./dom.js";
import { duration, format } from "./format.js";
import { profileChart } from "./profile.js";
import { sortedTable } from "./table.js";

const failures = ["inexact", "intersects", "failed", "time limit", "refused", "crashed"];
const taskOf = (row) => JSON.stringify([row.problem, row.tolerance_scale]);
const solved = (row) => row.outcome === "solved";
const unique = (values) => [...new Set(values)];
// Iterations and seconds of zero would make every ratio infinite.
const costOf = (key, least) => (row) => (solved(row) && row[key] !== null ? Math.max(row[key], least) : null);
const leastSeconds = 1e-5;

export function suiteSections({ suite, table }) {
  const rows = table.rows.map((row) => Object.fromEntries(table.columns.map((name, c) => [name, row[c]])));
  // The order of the scores is that of all charts.
  const order = suite.scores.map((score) => score.solver);
  rows.sort((a, b) => order.indexOf(a.solver) - order.indexOf(b.solver));
  return [factsOf(suite), scoreSection(suite), profileSection(rows, suite), precisionSection(rows, order), problemSection(rows, suite, order),
    solvesSection(table),
    section("provenance", "Provenance", plainTable(null, provenanceOf({ provenance: suite.provenance }), "Provenance", { class: "pairs" }))];
}

// The texts of `status` may be long: they come last.
function solvesSection(table) {
  const order = table.columns.map((_, c) => c).sort((a, b) => (table.columns[a] === "status") - (table.columns[b] === "status"));
  const ordered = { columns: order.map((c) => table.columns[c]), rows: table.rows.map((row) => order.map((c) => row[c])) };
  return section("table", "All solves", sortedTable(ordered, {
    caption: "All solves",
    mark: (row, c) => (ordered.columns[c] === "outcome" && row[c] !== "solved" ? h("span", { class: "mark bad" }, row[c]) : null),
  }));
}

function factsOf(suite) {
  const p = suite.provenance;
  const facts = [["problems", format(suite.problems.length)], ["solvers", format(suite.solvers.length)], ["limit of a solve", `${duration(suite.cpu_limit)} of processor time`],
    ["threads of a solve", format(suite.threads)], ["concurrent solves", format(suite.jobs)], ["program", `tack ${p.version}${p.commit ? ` (${p.commit})` : ""}`],
    ["machine", `${p.cpu}, ${p.cores} cores`], ["wall time", duration(suite.wall_seconds)]];
  return h("dl", { class: "facts" }, facts.map(([name, value]) => h("div", {}, h("dt", {}, name), h("dd", {}, value))));
}

function scoreSection(suite) {
  const seen = failures.filter((name) => suite.scores.some((score) => score[name] > 0));
  const rows = suite.scores.map((score, i) => {
    const failed = score.tasks - score.solved;
    return h("tr", {}, h("td", { class: "number" }, String(i + 1)), h("th", { scope: "row" }, score.solver), h("td", { class: "number" }, `${score.solved} of ${score.tasks}`),
      h("td", { class: "number" }, failed > 0 ? h("span", { class: "mark bad" }, String(failed)) : "0"),
      seen.map((name) => h("td", { class: "number" }, score[name] > 0 ? String(score[name]) : "–")),
      h("td", { class: "number" }, score.other_minima > 0 ? String(score.other_minima) : "–"), h("td", { class: "number" }, format(score.penalized_seconds, 3)));
  });
  const heads = ["", "solver", "solved", "unsolved", ...seen, "another minimum", "PAR2 [s]"];
  return section("scores", "Leaderboard",
    h("p", { class: "note" }, "By tasks solved, then by PAR2, the mean processor time of a task in which a failure counts twice the limit. A task is a problem at a tolerance. "
      + "Solved: converged by the criterion of the problem, nothing intersects by exact predicates, and the Newton direction at the result is at most "
      + `${suite.judged_residual_max} tolerances (above that: inexact). A step may have several minima; each is a solution, and another one than the stored is counted beside.`),
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Leaderboard" },
      h("table", { class: "numbers" }, h("caption", { class: "hidden" }, "Leaderboard"), h("thead", {}, h("tr", {}, heads.map((name) => h("th", { scope: "col", class: name === "solver" ? "text" : null }, name)))), h("tbody", {}, rows))));
}

function profileSection(rows, suite) {
  const tasks = unique(rows.map(taskOf));
  const unsolved = tasks.filter((task) => !rows.some((row) => taskOf(row) === task && solved(row))).length;
  const note = `The fraction of all ${tasks.length} tasks that a solver solves within a multiple of the best. Failures lower the right end${unsolved > 0 ? `; ${unsolved} tasks that no solver solves count as failures of all` : ""}.`;
  const common = { rows, taskOf, note };
  return section("profiles", "Performance profiles", h("div", { class: "charts wide" },
    profileChart({ ...common, title: "By iterations", costOf: costOf("iterations", 1), cost: "fewest iterations" }),
    profileChart({ ...common, title: "By processor time", costOf: costOf("seconds", leastSeconds), cost: `shortest time${suite.jobs > 1 ? ` (${suite.jobs} solves side by side)` : ""}` })));
}

// Draws processor time against error over the problems that all compared solvers solve at all tolerances. Solvers that solve less than half of the tasks are not compared.
function precisionSection(rows, order) {
  const tasks = unique(rows.map(taskOf)).length;
  const counts = new Map(order.map((solver) => [solver, rows.filter((row) => row.solver === solver && solved(row)).length]));
  const compared = order.filter((solver) => 2 * counts.get(solver) >= tasks);
  const omitted = order.filter((solver) => !compared.includes(solver)).map((solver) => `${solver} (${counts.get(solver)} of ${tasks})`);
  const hasPoint = (row) => solved(row) && row.error > 0 && row.seconds > 0;
  const problems = unique(rows.map((row) => row.problem));
  const common = problems.filter((problem) => rows.every((row) => row.problem !== problem || !compared.includes(row.solver) || hasPoint(row)));
  const scales = unique(rows.map((row) => row.tolerance_scale)).sort((a, b) => b - a);
  const series = compared.map((solver, index) => {
    const points = scales.map((scale) => {
      const of = rows.filter((row) => row.solver === solver && row.tolerance_scale === scale && common.includes(row.problem));
      return { x: Math.exp(of.reduce((sum, row) => sum + Math.log(row.error), 0) / of.length), y: of.reduce((sum, row) => sum + row.seconds, 0), left: of.length };
    }).filter((point) => point.left > 0);
    return { label: solver, index, points: true, x: points.map((p) => p.x), y: points.map((p) => p.y) };
  }).filter((one) => one.x.length > 0);
  const note = `Sum of times against the geometric mean of errors over the ${common.length} of ${problems.length} problems that all solvers shown solve; a point per tolerance. `
    + "The error of a result is its distance from the minimum that it leads to, relative to the motion of the step. Lower is faster, further left more accurate."
    + (omitted.length > 0 ? ` Without a curve, as they solve less than half of the tasks: ${omitted.join(", ")}.` : "");
  return section("precision", "Work against precision", h("div", { class: "charts wide" }, chart({
    title: "Processor time against error, commonly solved problems", note, x: { name: "relative error", log: true }, y: { name: "processor time", unit: "s", log: true }, height: 340, series,
  })));
}

const short = { "time limit": "limit", intersects: "cuts" };

// Lets a name break after its underscores.
const breakable = (name) => name.replaceAll("_", "_\u200b");

// A table of problems by solvers: processor time, or why not.
function problemSection(rows, suite, order) {
  const scale = rows.some((row) => row.tolerance_scale === 1) ? 1 : rows[0]?.tolerance_scale;
  const at = new Map(rows.filter((row) => row.tolerance_scale === scale).map((row) => [JSON.stringify([row.problem, row.solver]), row]));
  const cell = (row, best) => {
    if (!row) return h("td", {}, "");
    const iterations = row.iterations === null ? "" : `, ${format(row.iterations)} iterations`;
    if (!solved(row)) return h("td", { class: "number", title: `${row.status}${iterations}` }, h("span", { class: "mark bad" }, short[row.outcome] ?? row.outcome));
    const text = format(row.seconds, 2) + (row.minimum === "another" ? "*" : "");
    return h("td", { class: "number", title: `${row.status}${iterations}` }, row.seconds <= best ? h("strong", {}, text) : text);
  };
  const lines = suite.problems.map((problem) => {
    const of = order.map((solver) => at.get(JSON.stringify([problem.name, solver])));
    const best = Math.min(...of.filter((row) => row && solved(row)).map((row) => row.seconds));
    return h("tr", {}, h("th", { scope: "row" }, problem.name), h("td", { class: "number" }, format(problem.unknowns)), of.map((row) => cell(row, best)));
  });
  return section("problems", "Problems",
    h("p", { class: "note" }, `Processor time [s] of each solve${scale === 1 ? "" : ` at ${format(scale)} of the tolerances`}, the shortest in bold; *: another minimum than the stored one.`),
    h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": "Problems by solvers" },
      h("table", { class: "numbers" }, h("caption", { class: "hidden" }, "Problems by solvers"),
        h("thead", {}, h("tr", {}, ["problem", "unknowns", ...order.map(breakable)].map((name) => h("th", { scope: "col", class: "wrap" }, name)))), h("tbody", {}, lines))));
}
