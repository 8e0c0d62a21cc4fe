// The site of the documents in a browser: it searches, draws formulas, and loads nothing from elsewhere.
//   node search.mjs MODULES SITE     MODULES: where playwright-core is; ends with 77, and says why, without what it takes
import assert from "node:assert/strict";
import { existsSync, readFileSync, readdirSync, statSync } from "node:fs";
import { createServer } from "node:http";
import { extname, join } from "node:path";
import { needBrowser, runTests } from "../report/browser.mjs";

const [modules, site] = process.argv.slice(2);
for (const [path, what] of [[join(site, "index.html"), "the site is not built"], [join(modules, "node_modules/playwright-core"), "there is no playwright-core: cmake --build --preset release --target tack_report"]])
  if (!existsSync(path)) {
    console.log(`skipped: ${what}`);
    process.exit(77);
  }
const start = needBrowser(modules, join(site, "index.html"), "the site");

const types = { ".html": "text/html", ".js": "text/javascript", ".css": "text/css", ".json": "application/json", ".svg": "image/svg+xml", ".png": "image/png", ".woff2": "font/woff2" };
const server = createServer((request, response) => {
  const file = join(site, decodeURIComponent(new URL(request.url, "http://x").pathname));
  if (!existsSync(file) || statSync(file).isDirectory()) return response.writeHead(404).end();
  response.writeHead(200, { "content-type": types[extname(file)] ?? "application/octet-stream", "cache-control": "max-age=3600" }).end(readFileSync(file));
});
await new Promise((done) => server.listen(0, "127.0.0.1", done));
const address = `http://127.0.0.1:${server.address().port}/`;

// Opens a page, lets `look` look at it, and checks that nothing failed and nothing was asked of anywhere else.
async function visit(context, path, look) {
  const page = await context.newPage();
  const said = [];
  page.on("console", (message) => said.push(message.text()));
  page.on("pageerror", (error) => said.push(error.stack));
  page.on("request", (request) => request.url().startsWith(address) || /^(data|blob):/.test(request.url()) || said.push(`asks for ${request.url()}`));
  page.on("response", (response) => response.status() < 400 || response.url().endsWith("/favicon.ico") || said.push(`${response.status()} ${response.url()}`));
  await page.goto(address + path);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth - document.documentElement.clientWidth);
  assert.ok(wide <= 0, `${path} is ${wide} pixels wider than the window`);
  await look(page);
  assert.deepEqual(said.filter((text) => !/favicon|404 \(/.test(text)), [], `${path} is silent`);
  await page.close();
}

// Types a query. The search listens to keys, so one is pressed behind it: the whole query is asked at once, not letter by letter.
async function type(page, query) {
  await page.locator("[data-md-component=search-query]").fill(query);
  await page.keyboard.press("Shift");
}

// Types a query and returns the pages that it finds, as addresses, the best first.
async function search(page, query) {
  const found = page.locator(".md-search-result__link");
  await page.click("[data-md-component=search-query]");
  await type(page, "");
  await found.first().waitFor({ state: "detached", timeout: 15000 });
  await type(page, query);
  await found.first().waitFor({ state: "attached", timeout: 15000 });
  return found.evaluateAll((links) => links.map((link) => new URL(link.href).pathname.slice(1)));
}

const pages = readdirSync(site).filter((name) => name.endsWith(".html"));
const tests = {
  async "search finds pages by words, keys and classes"(context) {
    const expected = { peel: "paper.html", friction: "theory/friction.html", peak_traction: "reference/adhesion.html", NormalLaw: "cpp_api.html", feasible_step: "python_api.html" };
    await visit(context, "index.html", async (page) => {
      for (const [query, where] of Object.entries(expected)) {
        const found = await search(page, query);
        assert.ok(found.includes(where), `'${query}' finds ${where}, not only ${[...new Set(found)]}`);
      }
      await type(page, "zzzzqqq");
      await page.waitForFunction(() => /No matching/.test(document.querySelector(".md-search-result__meta").textContent));
    });
  },

  async "every page opens, draws its formulas and fits the window"(context) {
    const theory = existsSync(join(site, "theory")) ? readdirSync(join(site, "theory")).filter((name) => name.endsWith(".html")).map((name) => `theory/${name}`) : [];
    for (const path of [...pages, ...theory])
      await visit(context, path, async (page) => {
        assert.ok((await page.locator("h1").first().innerText()).length > 1, path);
        const drawn = await page.evaluate(() => [...document.querySelectorAll(".arithmatex")].map((formula) => [formula.querySelectorAll(".katex-html").length, formula.querySelectorAll(".katex-error").length, formula.textContent]));
        for (const [formulas, errors, text] of drawn) assert.ok(formulas > 0 && errors === 0, `${path} draws ${text}`);
      });
  },

  async "a class in C++, reached from the list of classes"(context) {
    await visit(context, "cpp_api.html", async (page) => {
      await page.locator("a", { hasText: /^NormalLaw$/ }).click();
      await page.waitForSelector("text=Public Member Functions");
      assert.match(await page.locator(".contents").innerText(), /energy per area/);
    });
  },
};

const browser = await start();
const failures = await runTests(tests, await browser.newContext({ viewport: { width: 1280, height: 900 } }));
await browser.close();
server.close();
process.exit(failures ? 1 : 0);
