// Renders pictures and films of runs in a headless browser:
//   node render.mjs MODULES PAGE VIEW OUTPUT
// MODULES: the folder that holds node_modules; PAGE: film.html with the data of the runs; VIEW: settings of `tack render` (JSON); OUTPUT: a file that ends
// in .png, .mp4 or .gif; "film_%04d.png" is a film as numbered pictures. Prints a line per frame: "frame 3 of 120".
import { spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { readFileSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { join, resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [modules, page, viewFile, output] = process.argv.slice(2);
const numbered = /%0(\d+)d(?=[^/]*\.png$)(?![^/]*%0\d+d)/; // the last of the file's name, as in blender_runs.py
const view = JSON.parse(readFileSync(viewFile, "utf8"));

function fail(message) {
  process.stderr.write(`${message}\n`);
  process.exit(2);
}

function browserOf() {
  for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
    const found = spawnSync("sh", ["-c", `command -v ${name}`], { encoding: "utf8" });
    if (found.status === 0) return found.stdout.trim();
  }
  return fail("there is no browser to draw with; install chromium");
}

const arguments_ = ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
  "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"];
const { chromium } = createRequire(join(modules, "package.json"))("playwright-core");
const browser = await chromium.launch({ executablePath: browserOf(), args: arguments_ });
try {
  const context = await browser.newContext({ offline: true, viewport: { width: 400, height: 300 } });
  const tab = await context.newPage();
  tab.on("pageerror", (error) => process.stderr.write(`${error.message}\n`));
  await tab.goto(pathToFileURL(page).href);
  await tab.waitForSelector("html[data-ready]", { timeout: 120000, state: "attached" });
  const run = await tab.evaluate(async (v) => {
    try {
      return await window.film.open(v);
    } catch (error) {
      return { error: error.message };
    }
  }, view);
  if (run.error) fail(run.error);

  const draw = async (time) => Buffer.from(await tab.evaluate((t) => window.film.draw(t), time), "base64");
  // Calls use(PNG, index) for each picture of a film. An unchanged picture is not drawn again.
  const drawAll = async (use) => {
    let last = null;
    for (const [i, time] of view.times.entries()) {
      const frame = run.times.reduce((best, t, k) => (Math.abs(t - time) < Math.abs(run.times[best] - time) ? k : best), 0);
      if (!last || last.frame !== frame || run.kept.length > 1) last = { frame, png: await draw(time) };
      await use(last.png, i);
      process.stdout.write(`frame ${i + 1} of ${view.times.length}\n`);
    }
  };
  if (numbered.test(output)) {
    await drawAll((png, i) => writeFileSync(output.replace(numbered, (_, digits) => String(i).padStart(Number(digits), "0")), png));
  } else if (output.endsWith(".png")) {
    const at = view.at ?? run.last;
    writeFileSync(output, await draw(at));
  } else {
    const coder = spawn("ffmpeg", ["-y", "-loglevel", "error", "-f", "image2pipe", "-framerate", String(view.fps), "-c:v", "png", "-i", "-",
      ...view.film_coding, resolve(output)],  // "a:b.mp4" alone would be a protocol
      { stdio: ["pipe", "inherit", "inherit"] });
    coder.on("error", () => fail("there is no ffmpeg to make films with; install it, or draw a picture (-o picture.png)"));
    await drawAll(async (png) => {
      if (!coder.stdin.write(png)) await once(coder.stdin, "drain");
    });
    coder.stdin.end();
    const [code] = await once(coder, "close");
    if (code !== 0) fail(`ffmpeg ended with ${code}`);
  }
} finally {
  await browser.close();
}
