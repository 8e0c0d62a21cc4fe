// Makes the folders for reports: small runs by the program, and files in place of a comparison, a calibration and a batch.
import { execFileSync } from "node:child_process";
import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

export const evil = "</script><b>bold</b>";

const scene = (name, { about = "a block falls on a floor", expect = "", young = "1 MPa", probes = "" } = {}) => `name: ${JSON.stringify(name)}
about: ${JSON.stringify(about)}
time: {step: 0.01 s, duration: 0.3 s}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}
    place: {translate: [0, 0.2, 0]}
    energies: [{type: neo_hookean, young: ${young}, poisson: 0.3, density: 1000}]
  - {name: string, shape: {type: segment, length: 0.3, edges: 6}, place: {translate: [0.3, 0.3, 0.3]}, rod: {radius: 5 mm},
     energies: [{type: string, young: 1 MPa, density: 1000}]}
  - {name: dust, shape: {type: points, size: [0.2, 0, 0.2], counts: [3, 1, 3]}, place: {translate: [-0.4, 0.2, 0.3]}, particle: {radius: 10 mm},
     energies: [particle]}
contact:
  distance: 2 mm
  pairs:
    - {between: [block, floor], adhesion: {type: fang, peak_traction: 2 kPa}}
probes:
  - {name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}
  - {name: push, type: contact_force, on: block, from: floor, direction: [0, 1, 0]}
  - {name: gap, type: gap, between: [block, floor]}
${probes}output: {fields: [velocity, contact_force, von_mises_stress, contact_pressure]}
expect:
  - {name: it stays above the floor, probe: height, statistic: min, at_least: 0.05}
${expect}  - {name: work of the push, probe: push, statistic: integral, along: height, at_least: -10, at_most: 10}
`;

// Names of properties that every JavaScript object has.
const objectsHave = "  - {name: __proto__, type: energy, term: kinetic}\n  - {name: constructor, type: energy, term: gravity}\n";

const failing = "  - {name: it flies, probe: height, statistic: max, at_least: 10}\n";

// A block that a drive lowers, holds and lifts quickly: the last stage is a narrow band.
const staged = `name: staged
time: {step: 10 ms, duration: 2 s, integrator: quasi_static}
objects:
  - name: block
    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [1, 2, 1]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3}]
    motion:
      - {type: fixed, select: {type: face, direction: [0, -1, 0]}}
      - {type: driven, drive: head, direction: [0, 1, 0], select: {type: face, direction: [0, 1, 0]}}
protocols:
  - name: press
    stages:
      - {name: approach, drive: {head: {velocity: -5 mm/s}}, until: {time: 0.5 s}}
      - {name: hold, until: {time: 0.5 s}}
      - {name: retraction, drive: {head: {velocity: 50 mm/s}}, until: {time: 0.03 s}}
probes: [{name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}]
`;

export function makeFixtures(tack, folder) {
  const run = (name, text, options = []) => {
    writeFileSync(join(folder, `${name}.yaml`), text);
    try {
      execFileSync(tack, ["run", `${name}.yaml`, "-q", "-o", name, "--threads", "1", ...options], { cwd: folder, stdio: "pipe" });
    } catch (error) {
      if (error.status !== 1) throw new Error(`tack run ${name}: ${error.stdout}${error.stderr}`); // 1: an expectation failed
    }
  };
  run("soft", scene("soft", { about: `${evil} falls`, expect: failing, young: "0.1 MPa" }));
  run("stiff", scene("stiff"));
  run("staged", staged);
  const warned = JSON.parse(readFileSync(join(folder, "soft", "summary.json"), "utf8"));
  warned.warnings = [{ text: `object '${evil}' is coarse, 'block' is not`, times: 1 }, { text: "step 3: rolled back", times: 12 }];
  writeFileSync(join(folder, "soft", "summary.json"), JSON.stringify(warned));
  run("evil", scene(evil, { probes: objectsHave }), ["--steps", "3"]);
  cpSync(join(folder, "stiff"), join(folder, "unfinished"), { recursive: true });
  for (const gone of ["summary.json", "laws.csv"]) rmSync(join(folder, "unfinished", gone));
  writeFileSync(join(folder, "unfinished", "frames", "frame_000020.vtu"), "cut off");

  mkdirSync(join(folder, "compared"));
  const compared = ["problem,solver,tolerance,time_step,wall_seconds,wall_spread,cpu_seconds,iterations,evaluations,linear_solves,status,branch,error_rms,error_max,relative_error,error_floor,energy_gap,intersections"];
  for (const problem of ["fall", evil])
    ["newton", "lbfgs", "ceres"].forEach((solver, s) => [1e-2, 1e-3, 1e-4].forEach((tolerance, t) => compared.push(
      solver === "ceres" && t === 2 ? `${problem},${solver},${tolerance},0.01,9,0,9,1000,1000,0,"stopped, too slow",,,,,2e-7,,0`
        : `${problem},${solver},${tolerance},0.01,${0.1 * (s + 1) * (t + 1)},0.01,${0.2 * (s + 1) * (t + 1)},${10 * (s * s + 1) * (t + 1)},20,10,converged,same,${1e-4 * tolerance * (s + 1)},${1e-3 * tolerance},1e-5,${problem === "fall" ? 1.5e-8 : 1},0,0`)));
  writeFileSync(join(folder, "compared", "compare.csv"), `${compared.join("\n")}\n`);
  writeFileSync(join(folder, "compared", "compare.md"), "# fall compared\n\nMeasured somewhere.\n\n## All 3 tasks together\n\n*Fastest*: or no slower.\n\n"
    + "| solver | done | |\n| --- | --- | --- |\n| newton | 3 | **best** |\n| a\\|b \\<i> | 2 | |\n");

  mkdirSync(join(folder, "batch", "cases"), { recursive: true });
  const cases = [];
  const results = ["case,young,mu,status,expect:it stays,value:it stays,height.min,push.max,steps,wall_seconds"];
  [["a", 1e5, 0, "soft"], ["b", 1e6, 0, "stiff"], ["c", 1e5, 0.5, "soft"], ["d", 1e6, 0.5, "stiff"], ["e", 1e7, 0.5, null]].forEach(([name, young, mu, from], i) => {
    if (from) cpSync(join(folder, from), join(folder, "batch", "cases", name), { recursive: true });
    cases.push({ name, folder: `cases/${name}`, values: { young, mu }, status: from ? "done" : "refused" });
    results.push(from ? `${name},${young},${mu},done,${i % 2},0.09,${0.1 - 0.01 * i},${20 + 3 * i},30,${0.1 * (5 - i)}` : `${name},${young},${mu},refused,,,,,,`);
  });
  writeFileSync(join(folder, "batch", "batch.json"), JSON.stringify({
    name: "falls", about: evil, provenance: { host: "somewhere", compiler: { name: "g++", version: "12.2" } }, keys: ["young", "mu"], cases,
  }));
  writeFileSync(join(folder, "batch", "results.csv"), `${results.join("\n")}\n`);
}

// A suite of two problems at two tolerances, of which one solver solves all.
export function makeSuite(folder) {
  const root = join(folder, "suite");
  mkdirSync(root, { recursive: true });
  const [solvers, problems] = [["newton", "lbfgs", evil], ["fall", evil]];
  const rows = ["problem,solver,tolerance_scale,outcome,status,iterations,evaluations,linear_solves,seconds,wall_seconds,residual,judged_residual,distance,error,minimum,energy_gap,intersections"];
  problems.forEach((problem, p) => [1, 0.1].forEach((scale, t) => solvers.forEach((solver, s) => {
    const outcome = s === 0 || (s === 1 && !(p === 1 && t === 0)) || (p === 0 && t === 0) ? "solved" : s === 2 && p === 1 && t === 0 ? "time limit" : "failed";
    const seconds = 0.1 * (s + 1) * (t + 1) + 0.2 * (p === 1 && s === 0 && t === 0) + 0.1 * (p === 1 && s === 0 && t === 1);
    rows.push(`${problem},${solver},${scale},${outcome},"stopped, somehow",${10 * (s + 1)},20,10,${seconds},${seconds},0.5,0.6,0.01,${1e-3 * scale * (s + 1)},${p === 1 && s === 0 && t === 0 ? "another" : "same"},0,0`);
  })));
  writeFileSync(join(root, "leaderboard.csv"), `${rows.join("\n")}\n`);
  const score = (solver, counts, seconds, others = 0) => ({ solver, tasks: 4, solved: 0, inexact: 0, intersects: 0, failed: 0, "time limit": 0, refused: 0, crashed: 0, ...counts, other_minima: others, penalized_seconds: seconds });
  writeFileSync(join(root, "leaderboard.json"), JSON.stringify({
    provenance: { version: "1", commit: "0123", cpu: evil, cores: 2, threads: 1, host: "somewhere" }, complete: true, cpu_limit: 20, judged_residual_max: 10, tolerance_scales: [1, 0.1], threads: 1,
    jobs: 1, wall_seconds: 5, solvers, problems: problems.map((name) => ({ name, file: name, program: "1", unknowns: 96, step_size: 0.01, quasi_static: false, minimum_tolerance: 1e-10 })),
    scores: [score("newton", { solved: 4 }, 0.25, 1), score("lbfgs", { solved: 3, failed: 1 }, 10.2), score(evil, { solved: 1, failed: 2, "time limit": 1 }, 30.1)],
  }));
}

// A calibration with a determined and an undetermined parameter.
export function makeCalibration(folder) {
  const root = join(folder, "calibration");
  mkdirSync(join(root, "fits"), { recursive: true });
  const number = { keys: { pull: ["a.b"] }, scale: "log", from: 1, to: 100 };
  writeFileSync(join(root, "calibration.json"), JSON.stringify({
    name: "a fit", about: evil, status: "done", misfit: 3, provenance: { host: "somewhere" },
    numbers: [{ ...number, name: evil, unit: "Pa", value: 5000, sigma: null, low: null, high: null, determined: false, derivatives: "differences", why_differences: evil },
      { ...number, name: "work", unit: "J/m^2", value: 1, sigma: 0.01, low: 0.98, high: 1.02, determined: true, derivatives: "run", why_differences: "" }],
    correlation: [[1, null], [null, 1]], combinations: [{ text: "work", sigma: 0.01, weights: [0, 1] }, { text: evil, sigma: null, weights: [1, 0] }],
    experiments: [{ name: "pull", x: "way", y: "force", x_unit: "m", y_unit: "N", points: 3, rms: 0.1, noise: 0.2, fit: "fits/pull.csv", run: "fits/pull_run.csv" }],
    warnings: [`the data do not determine ${evil}; only work (to 1%) is determined`],
  }));
  writeFileSync(join(root, "fits", "pull.csv"), "way,measured,simulated\n0,1,1.1\n0.5,2,1.9\n1,1,1\n");
  writeFileSync(join(root, "fits", "pull_run.csv"), "way,simulated\n0,1.1\n0.25,1.6\n0.5,1.9\n1,1\n");
  writeFileSync(join(root, "evaluations.csv"), `number,phase,"${evil}",work,misfit,derivatives,status,error\n1,design,5,1,30,0,done,\n2,design,50,1,,0,timed out,too slow\n3,polish,7,1,3,1,done,\n`);
}

export function makeReport(tack, folder, folders, output, options = []) {
  execFileSync(tack, ["report", ...folders, "-o", output, ...options], { cwd: folder, stdio: "pipe" });
  return join(folder, output);
}
