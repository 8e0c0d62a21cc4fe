// Draws the 3D view and the first plots of a report:
//   node report.mjs MODULES PAGE PICTURE     MODULES: the folder that holds node_modules
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";
import { findBrowser, launch } from "../../tests/report/browser.mjs";

const [modules, file, picture] = process.argv.slice(2).map((path) => resolve(path));
const shownAt = 0.8; // of the run
const browser = await launch(createRequire(join(modules, "package.json"))("playwright-core"), findBrowser());
try {
  const page = await browser.newPage({ viewport: { width: 1280, height: 1500 }, colorScheme: "light" });
  await page.goto(pathToFileURL(file).href);
  await page.waitForSelector(".view[data-ready]", { timeout: 120000 });
  await page.locator(".frames").evaluate((slider, part) => {
    slider.value = Math.round(part * Number(slider.max));
    slider.dispatchEvent(new Event("input"));
  }, shownAt);
  await page.evaluate(() => document.getElementById("view").scrollIntoView());
  await page.waitForTimeout(500); // until the view is drawn
  await page.screenshot({ path: picture });
} finally {
  await browser.close();
}
