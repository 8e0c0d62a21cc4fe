// Builds the pages of `tack report` and `tack render`: one file each with all scripts, styles and licences.
//   node build.mjs MODULES OUTPUT    MODULES: the folder that holds node_modules; OUTPUT: report.html, beside which film.html and render.mjs go
import { copyFileSync, mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [modules, output] = process.argv.slice(2).map((path) => resolve(path));
const source = join(dirname(fileURLToPath(import.meta.url)), "src");
const esbuild = createRequire(join(modules, "package.json"))("esbuild");

const bundle = (entry) => esbuild.build({
  entryPoints: [join(source, entry)],
  nodePaths: [join(modules, "node_modules")],
  bundle: true,
  minify: true,
  write: false,
  outdir: "out",
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none", // the page lists all licences
  metafile: true,
  logLevel: "warning",
});
const result = await bundle("main.js");

const textOf = (made, ending) => made.outputFiles.find((file) => file.path.endsWith(ending)).text;
const escaped = (plain) => plain.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

// Returns every package that the bundle contains.
const packages = new Set();
for (const input of Object.keys(result.metafile.inputs)) {
  const found = /node_modules\/((?:@[^/]+\/)?[^/]+)\//.exec(input);
  if (found) packages.add(found[1]);
}

function licence(name) {
  const folder = join(modules, "node_modules", name);
  const about = JSON.parse(readFileSync(join(folder, "package.json"), "utf8"));
  const file = readdirSync(folder).find((entry) => /^licen[cs]e/i.test(entry));
  if (!file) throw new Error(`${name}: has no licence file`);
  const terms = escaped(readFileSync(join(folder, file), "utf8").trim());
  return `<h3>${escaped(name)} ${escaped(about.version)}, ${escaped(about.license)}</h3><pre>${terms}</pre>`;
}

const parts = {
  "/* style */": textOf(result, ".css"),
  "/* script */": textOf(result, ".js"),
  "<!-- licences -->": [...packages].sort().map(licence).join("\n"),
};
function filled(name, parts) {
  let page = readFileSync(join(source, name), "utf8");
  for (const [place, part] of Object.entries(parts)) {
    if (!page.includes(place)) throw new Error(`${name}: has no place '${place}'`);
    page = page.replace(place, () => part);
  }
  return page;
}
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, filled("page.html", parts));
writeFileSync(join(dirname(output), "film.html"), filled("film.html", { "/* script */": textOf(await bundle("film.js"), ".js") }));
copyFileSync(join(source, "..", "render.mjs"), join(dirname(output), "render.mjs"));
