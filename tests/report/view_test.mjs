// `tack view` in a browser: a scene before it is run, live runs that are paused and stopped, results, and refused access.
//   node view_test.mjs TACK MODULES PAGE     ends with code 77 and a message if a requirement is missing
import assert from "node:assert/strict";
import { execFileSync, spawn, spawnSync } from "node:child_process";
import { once } from "node:events";
import { existsSync, mkdtempSync, readFileSync, readdirSync, rmSync, writeFileSync } from "node:fs";
import { request } from "node:http";
import { connect } from "node:net";
import { networkInterfaces, tmpdir } from "node:os";
import { join } from "node:path";
import { Page, needBrowser, runTests } from "./browser.mjs";

const [tack, modules, pageFile] = process.argv.slice(2);
const start = needBrowser(modules, pageFile);

const folder = mkdtempSync(join(tmpdir(), "tack_view_test_"));
const patience = 60000; // ms
const env = { ...process.env, DISPLAY: "", WAYLAND_DISPLAY: "" };
const running = new Set();

// A block that falls on a sticky floor while a plate rotates above it, for an unlimited time.
const scene = (name, { duration = "0.1 s", height = 0.12, edge = "0.2" } = {}) => `name: ${name}
about: a block below a plate that turns
time: {step: 0.5 ms, duration: ${duration}}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [0.2, ${edge}, 0.2], cells: [2, 2, 2]}
    place: {translate: [0, ${height}, 0]}
    selections: [{name: top, select: {type: face, direction: [0, 1, 0]}}]
    loads: [{type: force, value: [0, -1, 0], select: {type: tag, name: top}}]
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.499, density: 1000}]
  - name: plate
    shape: {type: box, size: [0.4, 0.02, 0.1]}
    place: {translate: [0, 0.5, 0]}
    motion: [{type: rotate, axis: [0, 1, 0], angular_velocity: 90 deg/s}]
contact: {distance: 2 mm, pairs: [{between: [block, floor], adhesion: {type: fang, peak_traction: 2 kPa}}]}
probes:
  - {name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}
  - {name: push, type: contact_force, on: block, from: floor, direction: [0, 1, 0]}
output: {frame_interval: 5 ms, fields: [velocity]}
expect: [{name: it stays above the floor, probe: height, statistic: min, at_least: 0.05}]
`;
const written = (name, options) => {
  writeFileSync(join(folder, `${name}.yaml`), scene(name, options));
  return `${name}.yaml`;
};

// Starts a serving `tack view`. Returns its address and a function that ends it.
async function serve(...words) {
  const program = spawn(tack, ["view", ...words], { cwd: folder, env });
  running.add(program);
  const one = { program, out: "", err: "" };
  program.stdout.on("data", (text) => (one.out += text));
  program.stderr.on("data", (text) => (one.err += text));
  const end = Date.now() + patience;
  while (!one.out.includes("\n")) {
    assert.ok(Date.now() < end && program.exitCode === null, `tack view ${words.join(" ")}: ${one.err}${one.out}`);
    await new Promise((done) => setTimeout(done, 20));
  }
  [one.address] = one.out.split("\n");
  assert.match(one.address, /^http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/$/);
  one.port = Number(new URL(one.address).port);
  one.interrupt = async () => {
    program.kill("SIGINT");
    if (program.exitCode === null) await once(program, "exit");
    running.delete(program);
    return program.exitCode;
  };
  return one;
}

// Sends a request. Returns {status, body}.
const ask = (port, path, { method = "GET", headers = {} } = {}) => new Promise((done, fail) => {
  const asked = request({ host: "127.0.0.1", port, path, method, headers, agent: false }, (answer) => {
    let body = "";
    answer.on("data", (text) => (body += text));
    answer.on("end", () => done({ status: answer.statusCode, body }));
  });
  asked.on("error", fail);
  asked.end();
});
const reachable = (host, port) => new Promise((done) => {
  const socket = connect({ host, port, timeout: 2000 });
  const end = (answer) => () => { socket.destroy(); done(answer); };
  socket.on("connect", end(true)).on("error", end(false)).on("timeout", end(false));
});

const redOf = (page, png) => page.evaluate(async (base64) => {
  const picture = await createImageBitmap(new Blob([Uint8Array.from(atob(base64), (c) => c.charCodeAt(0))], { type: "image/png" }));
  const ctx = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
  ctx.drawImage(picture, 0, 0);
  const { data } = ctx.getImageData(0, 0, picture.width, picture.height);
  let red = 0;
  for (let i = 0; i < data.length; i += 4) if (data[i] > 170 && data[i + 1] < 110 && data[i + 2] < 100) ++red;
  return red;
}, png.toString("base64"));

const bar = (page, name) => page.locator(".live").getAttribute(`data-${name}`);
const until = (page, name, value) => page.waitForFunction(([n, v]) => document.querySelector(".live").dataset[n] === v, [name, value], { timeout: patience });
const beyond = (page, name, value) => page.waitForFunction(([n, v]) => Number(document.querySelector(".live").dataset[n]) > v, [name, value], { timeout: patience });
const summaryOf = (name) => JSON.parse(readFileSync(join(folder, name, "summary.json"), "utf8"));
const rowsOf = (file) => readFileSync(join(folder, file), "utf8").trim().split("\n").slice(1);

const tests = {
  async "a scene before it is run: bodies, warnings with links to them, selections, motions, contact range"(browser) {
    assert.equal(execFileSync(tack, ["view", written("still"), "-o", "still.html"], { cwd: folder, encoding: "utf8" }), "still.html\n");
    const one = await Page.open(browser, join(folder, "still.html"));
    await one.ready();
    const { page } = one;
    assert.deepEqual(await one.text("h1"), ["still not run yet"]);
    assert.deepEqual(await one.text("nav a"), ["Warnings", "Initial state", "Bodies", "Expectations", "Scene"]);
    const rows = await one.text("#bodies tbody tr");
    assert.equal(rows.length, 3);
    assert.match(rows[0], /floor\s+8\s+\d+ tets\s+all\s+1 × 0\.1 × 1\s+2 mm/);
    assert.match(rows[1], /block\s+27\s+\d+ tets\s+–\s+0\.2 × 0\.2 × 0\.2\s+2 mm\s+4 mm/);
    const checked = spawnSync(tack, ["check", "still.yaml"], { cwd: folder, encoding: "utf8" }).stdout.split("\n").filter((line) => line.startsWith("warning: ")).map((line) => line.slice("warning: ".length));
    assert.ok(checked.length > 0 && checked.some((line) => line.includes("'block'")), `the scene has warnings: ${checked}`);
    assert.deepEqual((await one.text(".warnings li")).sort(), checked.sort(), "what `tack check` warns of");

    const start = await one.picture(".screen");
    assert.ok(start.colours > 20 && start.ink > 0.02, "the picture is not blank");
    await page.locator(".warnings").getByRole("button", { name: "'block'" }).first().click();
    assert.equal(await page.locator(".view").getAttribute("data-mark"), "block");
    await one.other(".screen", start, "an object that a warning names is shown");
    await page.locator(".warnings").getByRole("button", { name: "'block'" }).first().click();
    await page.evaluate(() => document.activeElement.blur());
    const again = await one.picture(".screen");

    const options = await page.getByLabel("Highlight").locator("option").allInnerTexts();
    assert.deepEqual(options, ["nothing", "block: group top (9)", "block: loads 0 (force) (9)", "floor", "block", "plate"]);
    await page.getByLabel("Highlight").selectOption({ label: "block: group top (9)" });
    const top = await one.other(".screen", again, "a selection stands out");
    assert.ok((await redOf(page, top.png)) > 50 && (await redOf(page, again.png)) === 0, "in red");
    await page.getByLabel("Highlight").selectOption({ label: "nothing" });
    await page.getByLabel("contact distance").check();
    await page.evaluate(() => document.activeElement.blur());
    await one.other(".screen", again, "how far contact reaches is drawn");
    await page.getByLabel("contact distance").uncheck();
    await page.evaluate(() => document.activeElement.blur());
    await one.same(".screen", again);

    assert.equal(await page.locator(".frames").getAttribute("max"), "60");
    await page.locator(".frames").evaluate((slider) => { slider.value = 60; slider.dispatchEvent(new Event("input")); });
    await one.other(".screen", again, "the plate turns");
    assert.deepEqual(await one.text(".time"), ["t = 0.1 s"]);
    await one.close();
  },

  async "a scene that starts with an intersection is shown with the error"(browser) {
    execFileSync(tack, ["view", written("crossed", { height: 0.05 }), "-o", "crossed.html"], { cwd: folder });
    const one = await Page.open(browser, join(folder, "crossed.html"));
    await one.ready();
    assert.match((await one.text("#warnings .bad"))[0], /The scene cannot be run: .*crossed\.yaml:\d+:\d+: the start intersects/s);
    assert.ok((await one.picture(".screen")).colours > 20);
    assert.equal(await one.page.getByLabel("contact distance").isVisible(), false);
    await one.close();
    const wrong = spawnSync(tack, ["view", "none.yaml"], { cwd: folder, encoding: "utf8", env });
    assert.equal(wrong.status, 2);
    assert.match(wrong.stderr, /none\.yaml: cannot read this file/);
  },

  async "only this machine has access, by the printed address"() {
    const one = await serve(written("doors"));
    const { pathname } = new URL(one.address);
    assert.equal((await ask(one.port, pathname)).status, 200);
    const wrong = pathname.replace(/[0-9a-f]/g, (c) => (c === "0" ? "1" : "0"));
    for (const path of ["/", "/favicon.ico", wrong, pathname.slice(0, -1), `${pathname.slice(0, -2)}/`, `${pathname}news`, `${pathname}../`, `//${pathname}`])
      assert.deepEqual(await ask(one.port, path), { status: 404, body: "" }, path);
    assert.deepEqual(await ask(one.port, pathname, { headers: { Host: "example.org" } }), { status: 403, body: "" });
    assert.deepEqual(await ask(one.port, pathname, { headers: { Origin: "http://example.org" } }), { status: 403, body: "" });
    assert.deepEqual(await ask(one.port, `${pathname}stop`, { method: "POST", headers: { Origin: "null" } }), { status: 403, body: "" });
    assert.equal((await ask(one.port, pathname, { method: "DELETE" })).status, 405);

    const sockets = ["tcp", "tcp6"].flatMap((kind) => (existsSync(`/proc/net/${kind}`) ? readFileSync(`/proc/net/${kind}`, "utf8").split("\n").slice(1) : []))
      .map((line) => line.trim().split(/\s+/)).filter(([, local, , state]) => state === "0A" && parseInt(local.split(":")[1], 16) === one.port);
    assert.deepEqual(sockets.map(([, local]) => local.split(":")[0]), ["0100007F"], "it listens on 127.0.0.1 and nowhere else");
    for (const { address, internal } of Object.values(networkInterfaces()).flat())
      if (!internal) assert.equal(await reachable(address, one.port), false, `not at ${address}`);
    assert.equal(await reachable("::1", one.port), false);
    assert.equal(await one.interrupt(), 0);
  },

  async "a served scene is read again when the page is reloaded"(browser) {
    const one = await serve(written("edited"));
    const page = await Page.open(browser, one.address);
    await page.ready();
    assert.match((await page.text("#bodies tbody tr"))[1], /0\.2 × 0\.2 × 0\.2/);
    written("edited", { edge: "0.15" });
    await page.page.reload();
    await page.ready();
    assert.match((await page.text("#bodies tbody tr"))[1], /0\.2 × 0\.15 × 0\.2/);
    await page.close();
    assert.equal(await one.interrupt(), 0);
  },

  async "a live run: frames and curves arrive; it pauses, resumes and stops with all results written"(browser) {
    const one = await serve(written("endless", { duration: "1000 s" }), "--run", "-o", "endless", "--threads", "1");
    const shown = await Page.open(browser, one.address);
    const { page } = shown;
    await beyond(page, "frames", 3);
    await shown.ready();
    await beyond(page, "step", 40);
    const first = await shown.picture(".screen");
    assert.ok(first.colours > 20, "a frame is drawn");
    await page.waitForSelector("#probes .plot canvas");
    await shown.checkCharts(4);

    await page.getByRole("button", { name: "Pause" }).click();
    await until(page, "state", "paused");
    const at = Number(await bar(page, "step"));
    await page.waitForTimeout(1500);
    assert.equal(Number(await bar(page, "step")), at, "it holds");
    assert.equal(rowsOf("endless/steps.csv").length, at, "and every step is written");
    await page.getByRole("button", { name: "Resume" }).click();
    await beyond(page, "step", at + 20);
    await shown.other(".screen", first, "newer frames are shown as they come");

    await page.getByRole("button", { name: "Stop" }).click();
    await until(page, "state", "interrupted");
    const steps = Number(await bar(page, "step"));
    const summary = summaryOf("endless");
    assert.equal(summary.status, "interrupted");
    assert.equal(summary.steps, steps);
    assert.equal(rowsOf("endless/steps.csv").length, steps);
    assert.equal(rowsOf("endless/probes.csv").length, steps + 1);
    assert.equal(readdirSync(join(folder, "endless", "checkpoints")).length, 1, "its last state is kept");
    assert.equal(await page.getByRole("button", { name: "Pause" }).isDisabled(), true);
    await page.waitForSelector("#provenance .pairs");
    assert.match((await shown.text("#provenance"))[0], /command\s+.*tack view endless\.yaml --run/);
    execFileSync(tack, ["report", "endless"], { cwd: folder });
    const { pathname } = new URL(one.address);
    assert.equal((await ask(one.port, `${pathname}stop`, { method: "POST" })).status, 200, "once more is nothing");
    assert.equal((await ask(one.port, pathname)).status, 200, "it is served on");
    await shown.close();
    assert.equal(await one.interrupt(), 130, "the code of a run that was interrupted");

    execFileSync(tack, ["run", "endless.yaml", "-q", "-o", "endless", "--resume", "--steps", String(steps + 5)], { cwd: folder });
    assert.equal(rowsOf("endless/steps.csv").length, steps + 5);
  },

  async "two runs at once have separate addresses; Ctrl-C ends both like `tack run`"(browser) {
    const scenes = ["left", "right"].map((name) => written(name, { duration: "1000 s" }));
    const both = await Promise.all(scenes.map((file, i) => serve(file, "--run", "-o", ["left", "right"][i], "--threads", "1")));
    assert.notEqual(both[0].port, both[1].port);
    const pages = await Promise.all(both.map((one) => Page.open(browser, one.address)));
    for (const [i, { page }] of pages.entries()) {
      await beyond(page, "frames", 2);
      assert.deepEqual(await page.locator("h1").allInnerTexts(), [["left", "right"][i]]);
    }
    await pages[0].page.getByRole("button", { name: "Pause" }).click();
    await until(pages[0].page, "state", "paused");
    const at = Number(await bar(pages[1].page, "step"));
    await beyond(pages[1].page, "step", at + 20);
    assert.equal(await bar(pages[0].page, "state"), "paused");
    const token = new URL(both[0].address).pathname;
    assert.equal((await ask(both[1].port, token)).status, 404, "the token of another one is a wrong one");
    for (const page of pages) await page.context.close();
    for (const one of both) assert.equal(await one.interrupt(), 130, "also while it is held");
    for (const name of ["left", "right"]) assert.equal(summaryOf(name).status, "interrupted");
  },

  async "results that another program writes: new frames and the final status arrive"(browser) {
    const file = written("apart", { duration: "1.5 s" });
    const run = spawn(tack, ["run", file, "-q", "-o", "apart", "--threads", "1"], { cwd: folder, env });
    running.add(run);
    const ended = once(run, "exit");
    const end = Date.now() + patience;
    while (!existsSync(join(folder, "apart", "scene.yaml")) && Date.now() < end) await new Promise((done) => setTimeout(done, 10));
    const one = await serve("apart");
    const shown = await Page.open(browser, one.address);
    const { page } = shown;
    assert.equal(await page.getByRole("button", { name: "Stop" }).count(), 0, "who only looks on stops nothing");
    await ended;
    running.delete(run);
    await until(page, "state", "done");
    await shown.ready();
    const frames = Number(await bar(page, "frames"));
    assert.equal(frames, 301);
    assert.match((await shown.text(".expectations tbody tr"))[0], /stays above.*✓ pass/s);
    assert.match((await shown.text(".facts"))[0], /steps\s+3000/);
    await shown.checkCharts(6);
    await shown.close();

    // Another run replaces the served one.
    const again = await Page.open(browser, one.address);
    await until(again.page, "state", "done");
    await again.page.evaluate(() => (window.before = true));
    execFileSync(tack, ["run", file, "-q", "-o", "apart", "--threads", "1", "--steps", "50"], { cwd: folder });
    await again.page.waitForFunction(() => !window.before && document.querySelector(".live")?.dataset.step === "50", null, { timeout: patience });
    await again.close();
    assert.equal(await one.interrupt(), 0);

    const report = execFileSync(tack, ["view", "apart", "-o", "apart.html"], { cwd: folder, encoding: "utf8" });
    assert.equal(report, "apart.html\n");
  },

  async "a viewed run has the bits of a run without a viewer"() {
    const file = written("bits");
    execFileSync(tack, ["run", file, "-q", "-o", "alone", "--threads", "1"], { cwd: folder });
    const one = await serve(file, "--run", "-o", "watched", "--threads", "1");
    const { pathname } = new URL(one.address);
    await ask(one.port, `${pathname}pause`, { method: "POST" });
    await ask(one.port, pathname);
    await ask(one.port, `${pathname}resume`, { method: "POST" });
    const end = Date.now() + patience;
    while (!existsSync(join(folder, "watched", "summary.json")) && Date.now() < end) await ask(one.port, `${pathname}news?steps=0&probes=0&frames=0`);
    assert.equal(await one.interrupt(), 0);
    assert.equal(readFileSync(join(folder, "alone", "probes.csv"), "utf8"), readFileSync(join(folder, "watched", "probes.csv"), "utf8"));
    const frames = readdirSync(join(folder, "alone", "frames"));
    assert.deepEqual(readdirSync(join(folder, "watched", "frames")), frames);
    for (const frame of frames) assert.ok(readFileSync(join(folder, "alone", "frames", frame)).equals(readFileSync(join(folder, "watched", "frames", frame))), frame);
    const refused = (words, why) => {
      const result = spawnSync(tack, ["view", ...words], { cwd: folder, encoding: "utf8", env });
      assert.equal(result.status, 2, words.join(" "));
      assert.match(result.stderr, why);
    };
    refused([file, "--run", "-o", "page.html"], /with --run, -o is the folder of the results/);
    refused(["watched", "--set", "name=x"], /--set is for a scene/);
    refused(["watched", "--run"], /watched/);
    refused([file, "--steps", "3"], /--steps requires --run/);
  },
};

const browser = await start();
let failures = 0;
try {
  failures = await runTests(tests, browser);
} finally {
  await browser.close();
  for (const program of running) program.kill("SIGKILL");
  rmSync(folder, { recursive: true, force: true });
}
process.exit(failures > 0 ? 1 : 0);
