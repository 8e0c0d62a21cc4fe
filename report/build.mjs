// Makes the page of `tack report`: one file with all scripts, styles and the licences of what is in it.
//   node build.mjs MODULES OUTPUT    MODULES: the folder that holds node_modules
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { dirname, join, resolve } from "node:path";
import { fileURLToPath } from "node:url";

const [modules, output] = process.argv.slice(2).map((path) => resolve(path));
const source = join(dirname(fileURLToPath(import.meta.url)), "src");
const esbuild = createRequire(join(modules, "package.json"))("esbuild");

const result = await esbuild.build({
  entryPoints: [join(source, "main.js")],
  nodePaths: [join(modules, "node_modules")],
  bundle: true,
  minify: true,
  write: false,
  outdir: "out",
  format: "iife",
  target: "es2022",
  charset: "utf8",
  legalComments: "none", // all of them stand in the page's list
  metafile: true,
  logLevel: "warning",
});

const text = (ending) => result.outputFiles.find((file) => file.path.endsWith(ending)).text;
const escaped = (plain) => plain.replaceAll("&", "&amp;").replaceAll("<", "&lt;").replaceAll(">", "&gt;");

// Every package that something of is in the bundle.
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
  "/* style */": text(".css"),
  "/* script */": text(".js"),
  "<!-- licences -->": [...packages].sort().map(licence).join("\n"),
};
let page = readFileSync(join(source, "page.html"), "utf8");
for (const [place, part] of Object.entries(parts)) {
  if (!page.includes(place)) throw new Error(`page.html: has no place '${place}'`);
  page = page.replace(place, () => part);
}
mkdirSync(dirname(output), { recursive: true });
writeFileSync(output, page);
