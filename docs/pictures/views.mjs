// Pictures of runs as their reports show them in 3D, and of a report as a whole:
//   node views.mjs TACK MODULES CASES IMAGES     CASES: where the runs are; IMAGES: gets gallery/NAME.png and report.png
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { spawnSync } from "node:child_process";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { findBrowser, launch } from "../../tests/report/browser.mjs";

const [tack, modules, cases, images] = process.argv.slice(2).map((path) => resolve(path));
const { views, report } = JSON.parse(readFileSync(new URL("views.json", import.meta.url)));
const only = process.env.VIEWS?.split(" "); // the names of some
const playwright = createRequire(join(modules, "package.json"))("playwright-core");
const browser = await launch(playwright, findBrowser());
const folder = mkdtempSync(join(tmpdir(), "tack_views_"));

async function opened(run, size) {
  const file = join(folder, `${run}.html`);
  const made = spawnSync(tack, ["report", join(cases, run), "-o", file], { encoding: "utf8" });
  if (made.status !== 0) throw new Error(`${run}: ${made.stderr}${made.stdout}`);
  const page = await browser.newPage({ viewport: size, colorScheme: "light" });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector(".view[data-ready]", { timeout: 120000 });
  return page;
}

// at: the time as a part of the run; from: x, y, z or corner; keys: pressed in the view; hide: objects; field: the label of what colours;
// lines: edges of the mesh.
async function arrange(page, { at = 1, from = "corner", fit = "run", keys = [], hide = [], field, lines }) {
  await page.locator(".frames").evaluate((slider, part) => {
    slider.value = Math.round(part * Number(slider.max));
    slider.dispatchEvent(new Event("input"));
  }, at);
  if (field) await page.getByLabel("Colour").selectOption({ label: field });
  for (const name of hide) await page.locator(".objects label", { hasText: new RegExp(`^${name}$`) }).locator("input").uncheck();
  if (lines) await page.getByLabel("mesh lines").check();
  await page.getByLabel("View from").selectOption(from);
  await page.getByRole("button", { name: `Fit ${fit}` }).click();
  for (const [key, times] of keys) for (let i = 0; i < times; ++i) await page.locator(".screen canvas").first().press(key);
  await page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 200)))));
}

try {
  for (const view of views) {
    if (only && !only.includes(view.name)) continue;
    const page = await opened(view.run, { width: 960, height: 900 });
    await page.addStyleTag({ content: ".screen { width: 640px; aspect-ratio: 4 / 3 !important; border: none !important } .overlay { display: none !important } canvas { outline: none !important }" });
    await arrange(page, view);
    await page.locator(".screen").screenshot({ path: join(images, "gallery", `${view.name}.png`) });
    console.log(join("gallery", `${view.name}.png`));
    await page.close();
  }
  if (!only || only.includes("report")) {
    const page = await opened(report.run, { width: 1280, height: 1500 });
    await arrange(page, report);
    await page.evaluate((id) => document.getElementById(id).scrollIntoView(), report.section);
    await page.evaluate(() => new Promise((done) => setTimeout(done, 500)));
    await page.screenshot({ path: join(images, "report.png") });
    console.log("report.png");
  }
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
