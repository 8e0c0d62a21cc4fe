// Every shipped file by a validator as editors have one, with the schema of its kind; and files with one mistake each, which it has to find.
//   node schemas_test.mjs SOURCE MODULES     MODULES: where ajv and yaml are; ends with 77, and says why, without them
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync } from "node:fs";
import { createRequire } from "node:module";
import { join, relative } from "node:path";

const [source, modules] = process.argv.slice(2);
if (!existsSync(join(modules, "node_modules", "ajv"))) {
  console.log("skipped: there is no validator: cmake --build --preset release --target tack_report (needs npm: apt-get install nodejs npm)");
  process.exit(77);
}
const require = createRequire(join(modules, "package.json"));
const Ajv = require("ajv").default;
const { parse } = require("yaml");

const ajv = new Ajv({ strict: true, strictTypes: false, strictTuples: false, strictRequired: false, allowUnionTypes: true });
const schemas = {};
for (const kind of ["scene", "compare", "batch", "calibrate", "plot"]) schemas[kind] = ajv.compile(JSON.parse(readFileSync(join(source, "docs", `${kind}.schema.json`), "utf8")));
const kindOf = (file) => ("fit" in file ? "calibrate" : "solvers" in file ? "compare" : "vary" in file || "bases" in file ? "batch" : "width" in file ? "plot" : "scene");
const problems = (validate) => (validate.errors ?? []).map((e) => `${e.instancePath} ${e.message}`).join("\n  ");

function yamlFiles(folder) {
  return readdirSync(folder, { withFileTypes: true }).flatMap((entry) => {
    const path = join(folder, entry.name);
    return entry.isDirectory() ? yamlFiles(path) : path.endsWith(".yaml") ? [path] : [];
  });
}

let refused = 0;
const count = { scene: 0, compare: 0, batch: 0, calibrate: 0, plot: 0 };
for (const path of yamlFiles(join(source, "experiments"))) {
  const file = parse(readFileSync(path, "utf8"));
  const kind = kindOf(file);
  ++count[kind];
  if (schemas[kind](file)) continue;
  ++refused;
  console.log(`${relative(source, path)}: refused\n  ${problems(schemas[kind])}`);
}
assert.equal(refused, 0, `${refused} shipped files are refused`);
assert.ok(count.scene > 150 && count.compare >= 4 && count.batch >= 4 && count.calibrate >= 4 && count.plot >= 1, `files of each kind: ${JSON.stringify(count)}`);

// Of one scene that is right.
const scene = () => parse(readFileSync(join(source, "experiments/first/hang.yaml"), "utf8"));
const cube = (file) => file.objects.find((o) => o.name === "cube");
const accepts = (change) => {
  const file = scene();
  change(file);
  return schemas.scene(file);
};
assert.ok(accepts(() => {}), problems(schemas.scene));
const mistakes = {
  "a misspelt key": (f) => (f.time = { duraton: "1 s" }),
  "a length as a time": (f) => (f.time.step = "5 mm"),
  "a force as Young's modulus": (f) => (cube(f).energies[0].young = "5 kN"),
  "a stiffness as Young's modulus": (f) => (cube(f).energies[0].young = "5 N/m"),
  "a velocity as gravity": (f) => (f.gravity = [0, "-9.81 m/s", 0]),
  "a pressure as a plain number": (f) => (cube(f).energies[0].poisson = "0.3 Pa"),
  "an unknown energy": (f) => (cube(f).energies[0].type = "neohookean"),
  "an unknown key of an energy": (f) => (cube(f).energies[0].yung = 1),
  "an energy without a type": (f) => delete cube(f).energies[0].type,
  "a number as a whole one": (f) => (cube(f).shape.cells = ["3.5", 1, 1]),
  "a negative step": (f) => (f.time.step = -1),
  "an object without a shape": (f) => delete cube(f).shape,
  "an object without a name": (f) => delete cube(f).name,
  "no objects": (f) => delete f.objects,
  "an entry to remove, of nothing": (f) => (cube(f).remove = true),
};
for (const [what, change] of Object.entries(mistakes)) assert.ok(!accepts(change), `not found: ${what}`);
const rights = {
  "other units of the right kind": (f) => { f.time.step = "5e-3 s"; cube(f).energies[0].young = "0.1 N/mm^2"; f.gravity = [0, "-981 cm/s^2", 0]; },
  "expressions of parameters": (f) => { f.parameters = { side: "10 cm", n: 2 }; f.time.step = "side / 1 m * 0.01 s"; cube(f).shape.size = ["side", "2 * side", "sqrt(side^2)"]; cube(f).shape.cells = ["n", "2 * n", 1]; },
  "units that the schema does not know": (f) => (cube(f).energies[0].young = "1e5 kg m-1 s-2"),
};
for (const [what, change] of Object.entries(rights)) assert.ok(accepts(change), `refused: ${what}\n  ${problems(schemas.scene)}`);

// What includes another file may give a part; what it gives has to be right all the same.
const over = (file) => schemas.scene({ include: "a.yaml", ...file });
assert.ok(over({ objects: [{ name: "cube", shape: { cells: [3, 3, 3] } }], expect: [{ name: "it hangs", remove: true }] }), problems(schemas.scene));
assert.ok(!over({ objects: [{ name: "cube", shape: { sells: [3, 3, 3] } }] }), "an unknown key in a part of a shape");
assert.ok(!over({ time: { step: "5 mm" } }), "a wrong unit in a part");
console.log(`${count.scene} scenes, ${count.compare} comparisons, ${count.batch} batches, ${count.calibrate} calibrations fit; ${Object.keys(mistakes).length + 2} mistakes found`);
