// A headless browser for tests. Pages are loaded from files or from an address. Tests fail if a page writes to the console, or makes a request other than for itself
// and paths below its address.
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { createRequire } from "node:module";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

const noticeable = 2e-4; // of the pixels: a browser may round an edge in another way

export function findBrowser() {
  for (const name of ["chromium", "chromium-browser", "google-chrome"]) {
    const found = spawnSync("sh", ["-c", `command -v ${name}`], { encoding: "utf8" });
    if (found.status === 0) return found.stdout.trim();
  }
  return null;
}

export async function launch(playwright, executablePath) {
  return playwright.chromium.launch({
    executablePath,
    args: ["--no-sandbox", "--disable-gpu", "--use-gl=angle", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
      "--disable-background-networking", "--disable-component-update", "--disable-sync", "--no-first-run"],
  });
}

// Returns a function that starts a browser. Ends the test with code 77 and a message if the page or a browser is missing.
export function needBrowser(modules, page, what = "the page of reports") {
  const skip = (why) => {
    console.log(`skipped: ${why}`);
    process.exit(77);
  };
  if (!existsSync(page)) skip(`${what} is not built: cmake --build --preset release --target tack_report (needs npm: apt-get install nodejs npm)`);
  const executable = findBrowser();
  if (!executable) skip("there is no browser: apt-get install chromium");
  const playwright = createRequire(join(modules, "package.json"))("playwright-core");
  return () => launch(playwright, executable);
}

// Runs all tests by name and prints their results. Returns the number of failures.
export async function runTests(tests, browser) {
  let failures = 0;
  for (const [name, test] of Object.entries(tests)) {
    try {
      await test(browser);
      console.log(`pass  ${name}`);
    } catch (error) {
      ++failures;
      console.log(`FAIL  ${name}\n${error.stack}`);
    }
  }
  return failures;
}

export class Page {
  static async open(browser, file, { width = 1280, colorScheme = "light" } = {}) {
    const one = new Page();
    one.served = file.startsWith("http:");
    one.context = await browser.newContext({ viewport: { width, height: 900 }, colorScheme, offline: !one.served, acceptDownloads: true });
    one.page = await one.context.newPage();
    one.said = [];
    one.requests = [];
    // Console lines of screenshots, which are not of the page.
    const ours = /GPU stall due to ReadPixels/;
    one.page.on("console", (message) => ours.test(message.text()) || one.said.push(`${message.type()}: ${message.text()}`));
    one.page.on("pageerror", (error) => one.said.push(`error: ${error.stack}`));
    one.page.on("dialog", (dialog) => one.said.push(`dialog: ${dialog.message()}`));
    one.page.on("request", (request) => one.requests.push(request.url()));
    one.url = one.served ? file : pathToFileURL(file).href;
    await one.page.goto(one.url);
    await one.page.waitForSelector("html[data-ready]", { timeout: 60000 });
    // A page without the content policy, for the analysis of pictures.
    one.bench = await one.context.newPage();
    return one;
  }

  // Waits until the 3D view is ready, if there is one.
  async ready() {
    if (await this.page.locator(".view").count()) await this.page.waitForSelector(".view[data-ready]", { timeout: 60000 });
    await this.settle();
  }

  async settle() {
    await this.page.evaluate(() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(() => setTimeout(done, 50)))));
  }

  // Returns {colours, ink: fraction of pixels without the most frequent colour, bytes} of an element as drawn.
  async picture(selector) {
    await this.settle();
    const png = await this.page.locator(selector).first().screenshot();
    return this.analyse(png);
  }

  // Waits until the picture differs from `from`, or equals it: drawing follows input with a delay.
  async other(selector, from, why) { return this.once(selector, from, (part) => part > noticeable, why ?? "the picture changes"); }
  async same(selector, from, why) { return this.once(selector, from, (part) => part <= noticeable, why ?? "the picture is the same"); }

  async once(selector, from, accepted, why) {
    const end = Date.now() + 15000;
    for (;;) {
      const now = await this.picture(selector);
      const part = await this.difference(from.png, now.png);
      if (accepted(part)) return now;
      assert.ok(Date.now() < end, `${why}: ${part} of its pixels differ`);
    }
  }

  // Returns the fraction of visibly different pixels; 1 if the sizes differ.
  async difference(a, b) {
    return this.bench.evaluate(async (pictures) => {
      const [one, two] = await Promise.all(pictures.map(async (base64) => {
        const bitmap = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "image/png" }));
        const ctx = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        ctx.drawImage(bitmap, 0, 0);
        return ctx.getImageData(0, 0, bitmap.width, bitmap.height);
      }));
      if (one.width !== two.width || one.height !== two.height) return 1;
      let count = 0;
      for (let i = 0; i < one.data.length; i += 4)
        if ([0, 1, 2].some((c) => Math.abs(one.data[i + c] - two.data[i + c]) > 16)) ++count;
      return count / (one.width * one.height);
    }, [a.toString("base64"), b.toString("base64")]);
  }

  async analyse(png) {
    const result = await this.bench.evaluate(async (base64) => {
      const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
      const bitmap = await createImageBitmap(new Blob([bytes], { type: "image/png" }));
      const canvas = new OffscreenCanvas(bitmap.width, bitmap.height);
      const ctx = canvas.getContext("2d");
      ctx.drawImage(bitmap, 0, 0);
      const { data } = ctx.getImageData(0, 0, bitmap.width, bitmap.height);
      const counts = new Map();
      let [red, green, blue] = [0, 0, 0];
      for (let i = 0; i < data.length; i += 4) {
        const key = (data[i] << 16) | (data[i + 1] << 8) | data[i + 2];
        counts.set(key, (counts.get(key) ?? 0) + 1);
        red += data[i];
        green += data[i + 1];
        blue += data[i + 2];
      }
      const pixels = data.length / 4;
      return { colours: counts.size, ink: 1 - Math.max(...counts.values()) / pixels, mean: [red, green, blue].map((v) => v / pixels), width: bitmap.width, height: bitmap.height };
    }, png.toString("base64"));
    return { ...result, png };
  }

  // Checks that every chart has lines of data: coloured pixels. Axes and letters are grey.
  async checkCharts(least) {
    // All at once, as those of a live run are made anew while they are looked at.
    const pictures = () => {
      const plots = [...document.querySelectorAll(".plot")];
      return plots.every((plot) => plot.querySelector("canvas")) && plots.map((plot) => ({
        title: plot.closest("figure").querySelector("h3").textContent,
        label: plot.getAttribute("aria-label"),
        picture: plot.querySelector("canvas").toDataURL(),
      }));
    };
    await this.page.waitForFunction(pictures);
    await this.settle();
    const charts = await (await this.page.waitForFunction(pictures)).jsonValue();
    for (const chart of charts) {
      chart.coloured = await this.bench.evaluate(async (url) => {
        const bitmap = await createImageBitmap(await (await fetch(url)).blob());
        const ctx = new OffscreenCanvas(bitmap.width, bitmap.height).getContext("2d");
        ctx.drawImage(bitmap, 0, 0);
        const { data } = ctx.getImageData(0, 0, bitmap.width, bitmap.height);
        let coloured = 0;
        for (let i = 0; i < data.length; i += 4)
          if (data[i + 3] > 100 && Math.max(data[i], data[i + 1], data[i + 2]) - Math.min(data[i], data[i + 1], data[i + 2]) > 40) ++coloured;
        return coloured;
      }, chart.picture);
    }
    assert.ok(charts.length >= least, `${charts.length} charts, expected ${least}: ${charts.map((c) => c.title)}`);
    for (const { title, coloured, label } of charts) {
      assert.ok(coloured > 30, `chart '${title}' has ${coloured} coloured pixels`);
      assert.match(label, /from .* to /, `chart '${title}' says what it shows`);
    }
    return charts;
  }

  text(selector) { return this.page.locator(selector).allInnerTexts(); }

  async close() {
    assert.deepEqual(this.said, [], "the console stays silent");
    const own = (url) => (this.served ? url.startsWith(this.url) : url === this.url) || url.startsWith("blob:");
    assert.deepEqual(this.requests.filter((url) => !own(url)), [], "nothing is fetched");
    // Every control has a name.
    const nameless = await this.page.evaluate(() => [...document.querySelectorAll("button, input, select, [role=application], [role=img]")]
      .filter((e) => e.offsetParent && !(e.getAttribute("aria-label") || e.labels?.[0]?.textContent.trim() || e.textContent.trim())).map((e) => e.outerHTML.slice(0, 120)));
    assert.deepEqual(nameless, [], "every control has a name");
    const wide = await this.page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
    assert.ok(wide <= 0, `the page is ${wide} pixels wider than the window`);
    await this.context.close();
  }
}
