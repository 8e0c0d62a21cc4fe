// Performance profiles (Dolan and Moré 2002): the fraction of tasks that a solver solves within a multiple of the best cost.
import { chart } from "./chart.js";

// rows: one per task and solver; taskOf(row): a key of its task; costOf(row): the cost, or null for a failure. Tasks that no solver solves count as failures of all.
export function profileChart({ rows, taskOf, costOf, title, note, cost, height = 300 }) {
  const solvers = [...new Set(rows.map((row) => row.solver))];
  const tasks = new Map();
  for (const row of rows) {
    const key = taskOf(row);
    if (!tasks.has(key)) tasks.set(key, new Map());
    const value = costOf(row);
    if (value !== null) tasks.get(key).set(row.solver, value);
  }
  const best = [...tasks.values()].map((costs) => Math.min(...costs.values()));
  const ratios = solvers.map((solver) => [...tasks.values()].map((costs, t) => (costs.has(solver) ? costs.get(solver) / best[t] : Infinity)).filter(Number.isFinite).sort((a, b) => a - b));
  const most = Math.max(2, ...ratios.flat());
  const series = solvers.map((solver, i) => {
    const [x, y] = [[1], [0]];
    ratios[i].forEach((ratio, k) => {
      x.push(ratio, ratio);
      y.push(k / tasks.size, (k + 1) / tasks.size);
    });
    x.push(1.05 * most);
    y.push(ratios[i].length / tasks.size);
    return { label: solver, x, y };
  });
  return chart({ title, note, x: { name: `multiple of the ${cost}`, log: true }, y: { name: "fraction of tasks", span: [0, 1] }, height, series });
}
