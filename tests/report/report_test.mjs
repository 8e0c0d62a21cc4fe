// The reports of a run, several runs, an unfinished run, a comparison, a suite, a calibration and a batch, in a browser from the file system.
//   node report_test.mjs TACK MODULES PAGE     MODULES: where playwright-core is; ends with code 77 and a message if a requirement is missing
import assert from "node:assert/strict";
import { mkdtempSync, readFileSync, rmSync, statSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { Page, needBrowser, runTests } from "./browser.mjs";
import { evil, makeCalibration, makeFixtures, makeReport, makeSuite } from "./fixtures.mjs";

const [tack, modules, pageFile] = process.argv.slice(2);
const start = needBrowser(modules, pageFile);

const folder = mkdtempSync(join(tmpdir(), "tack_report_"));
const setSlider = (page, selector, value) => page.locator(selector).evaluate((slider, v) => {
  slider.value = v;
  slider.dispatchEvent(new Event("input"));
}, value);

const tests = {
  async "a run: facts, failed expectations, texts of the scene"(browser) {
    const one = await Page.open(browser, makeReport(tack, folder, ["soft"], "run.html"));
    await one.ready();
    assert.equal(await one.page.title(), "soft – tack report");
    assert.deepEqual(await one.text("h1 .badge"), ["expectation failed"]);
    assert.deepEqual(await one.text(".about"), ["</script><b>bold</b> falls"], "a text of the scene is a text");
    const warnings = await one.text(".warnings li");
    assert.equal(warnings.length, 2);
    assert.match(warnings[0], /'<\/script><b>bold<\/b>' is coarse, 'block' is not$/);
    assert.match(warnings[1], /^step 3: rolled back \(and 11 more of this kind\)$/);
    const rows = await one.text(".expectations tbody tr");
    assert.equal(rows.length, 3);
    assert.match(rows[0], /stays above.*✓ pass\s+[\d.]+ mm\s+at least 50 mm/s, "numbers have their units");
    assert.match(rows[1], /it flies.*✗ fail\s+[\d.]+ m?m\s+at least 10 m/s);
    assert.match(rows[2], /work of the push.*✓ pass\s+\S+ m?N m\s+from −10 N m to 10 N m/s);
    assert.match((await one.text("#expectations .notice"))[0], /One expectation failed/);
    assert.match((await one.text("#provenance"))[0], /commit/);
    assert.deepEqual(await one.text("nav a"), ["Warnings", "Expectations", "Motion", "Probes", "Laws of adhesion", "Energies", "Contact", "Cost of the steps", "Provenance"]);
    assert.equal(await one.page.locator("main b").count(), 0);
    assert.match(await one.page.locator("#licences").textContent(), /three .*MIT.*uplot .*MIT/s);
    assert.deepEqual(await one.text("#against figure h3"), ["push over height"], "the axes that the scene names in what it expects");
    await one.checkCharts(8);
    assert.deepEqual(await one.text("#cost .legend li span:nth-child(2)").then((all) => all.includes("assembly")), true);
    await one.page.locator("#probes details summary").first().click();
    await one.page.waitForSelector("#probes details table");
    assert.ok((await one.page.locator("#probes details table tbody tr").count()) > 20, "the numbers of a chart are there as a table");
    await one.close();
  },

  async "stages: numbers for narrow bands, names below the chart and at the cursor"(browser) {
    const one = await Page.open(browser, makeReport(tack, folder, ["staged"], "staged.html"));
    await one.ready();
    const plot = one.page.locator("#probes figure .plot").first();
    await plot.scrollIntoViewIfNeeded();
    assert.deepEqual(await one.text("#probes .band-key"), ["Narrow bands: 3 retraction"]);
    const { x, y, width, height } = await plot.locator(".u-over").boundingBox();
    for (const [at, stage] of [[0.2, "approach"], [0.7, "hold"], [0.99, "retraction"]]) {
      await one.page.mouse.move(x + at * width, y + height / 2);
      assert.match((await one.text("#probes .where"))[0], new RegExp(`^time .* s, ${stage}: `));
    }
    await plot.focus();
    for (const key of ["End", "+", "+", "+", "+"]) await one.page.keyboard.press(key);
    await one.page.waitForFunction(() => document.querySelector("#probes .band-key").hidden);
    await one.close();
  },

  async "the 3D view: frames, fields, objects, cuts, keys, pictures"(browser) {
    const one = await Page.open(browser, join(folder, "run.html"));
    await one.ready();
    const { page } = one;
    const stage = ".screen";
    const first = await one.picture(stage);
    assert.ok(first.colours > 20 && first.ink > 0.05, `the picture is not blank: ${first.colours} colours, ${first.ink}`);

    await setSlider(page, ".frames", 15);
    const later = await one.other(stage, first, "another frame moves the mesh");
    assert.deepEqual(await one.text(".time"), ["t = 0.15 s"]);

    assert.deepEqual(await one.text(".controls select >> nth=0").then(([all]) => all.split("\n")), ["object", "speed", "contact force (magnitude)", "contact pressure", "von mises stress"]);
    assert.equal(await page.locator(".scale").isVisible(), false);
    await page.getByLabel("Colour", { exact: true }).selectOption({ label: "speed" });
    const speed = await one.other(stage, later, "another field changes the colours");
    await page.locator(".scale-title", { hasText: "speed [m/s]" }).waitFor();
    await page.getByLabel("Colour", { exact: true }).selectOption({ label: "von mises stress" });
    const stress = await one.other(stage, speed);
    await page.locator(".scale-title", { hasText: /^von mises stress \[k?Pa\]$/ }).waitFor();
    await page.locator(".view").getByLabel("Scale").selectOption("frame");
    await page.getByLabel("logarithmic").check();
    await page.getByLabel("Colour", { exact: true }).selectOption({ label: "object" });

    const whole = await one.same(stage, later, "the same settings make the same picture");
    await page.locator(".objects").getByLabel("floor").uncheck();
    await one.other(stage, whole, "an object is hidden");
    await page.locator(".objects").getByLabel("floor").check();
    await page.getByLabel("Cut", { exact: true }).selectOption("0");
    await one.other(stage, whole, "a plane cuts");
    await page.getByLabel("Cut", { exact: true }).selectOption("");
    await page.getByLabel("mesh lines").check();
    await one.other(stage, whole, "mesh lines are drawn");
    await page.getByLabel("mesh lines").uncheck();
    await one.same(stage, whole);

    await page.locator(".screen canvas").first().focus();
    await page.keyboard.press("ArrowRight");
    const turned = await one.other(stage, whole, "keys turn the view");
    await page.keyboard.press("PageDown");
    assert.deepEqual(await one.text(".time"), ["t = 0.16 s"]);
    await page.keyboard.press("0");
    await page.keyboard.press("PageUp");
    // The canvas has the focus now, and its outline with it.
    await page.locator("h1").evaluate((h1) => { document.activeElement.blur(); });
    await one.same(stage, whole, "0 resets the view");
    const box = await page.locator(stage).boundingBox();
    await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
    await page.mouse.down();
    await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 20);
    await page.mouse.up();
    await one.other(stage, whole, "the mouse turns the view");

    const before = Number(await page.locator(".frames").inputValue());
    await page.getByRole("button", { name: "Play" }).click();
    await page.waitForFunction((b) => Number(document.querySelector(".frames").value) > b, before, { timeout: 20000 });
    await page.getByRole("button", { name: "Pause" }).click();

    const download = page.waitForEvent("download");
    await page.getByRole("button", { name: "Save picture" }).click();
    const saved = await download;
    assert.match(saved.suggestedFilename(), /^soft_\d{4}\.png$/);
    const picture = await one.analyse(readFileSync(await saved.path()));
    assert.ok(picture.colours > 20 && picture.ink > 0.05, "the saved picture is not blank");
    await one.close();
  },

  async "a field with both signs is white at zero, and buttons with object names focus the objects"(browser) {
    const one = await Page.open(browser, join(folder, "run.html"));
    await one.ready();
    const { page } = one;
    await page.getByLabel("Colour", { exact: true }).selectOption({ label: "von mises stress" });
    await page.waitForSelector(".view[data-map=viridis]");
    await page.getByLabel("Colour", { exact: true }).selectOption({ label: "contact pressure" });
    await page.waitForSelector(".view[data-map=red_blue]");
    const ticks = (await one.text(".scale-ticks")).join(" ").split(/\s+/);
    assert.equal(ticks[2], "0", `zero is in the middle: ${ticks}`);
    assert.equal(ticks[0], `−${ticks[4]}`);
    await page.getByLabel("Colours", { exact: true }).selectOption("magma");
    await page.waitForSelector(".view[data-map=magma]");
    await page.getByLabel("Colour", { exact: true }).selectOption({ label: "object" });
    await page.evaluate(() => document.activeElement.blur());
    const all = await one.picture(".screen");
    await page.locator("#warnings").getByRole("button", { name: "'block'" }).click();
    assert.equal(await page.getByLabel("Highlight").inputValue(), "object 1");
    const near = await one.other(".screen", all, "the block stands out, and is near");
    await page.getByLabel("Highlight").selectOption({ label: "floor" });
    await one.other(".screen", near);
    await one.close();
  },

  async "charts zoom together, and keys announce values"(browser) {
    const one = await Page.open(browser, join(folder, "run.html"));
    await one.ready();
    const { page } = one;
    const plots = page.locator("#probes .plot");
    await plots.first().scrollIntoViewIfNeeded();
    const before = [await one.picture("#probes .plot >> nth=0"), await one.picture("#probes .plot >> nth=1")];
    await plots.first().focus();
    for (let i = 0; i < 10; ++i) await page.keyboard.press("ArrowRight");
    assert.match((await one.text("#probes .where"))[0], /^time 0\.06 s/);
    const told = await page.locator("#probes .where").first().getAttribute("aria-label");
    assert.match(told, /height 0\.\d+ m|height/);
    await page.keyboard.press("+");
    await page.locator("h1").evaluate(() => document.activeElement.blur());
    await one.other("#probes .plot >> nth=1", before[1], "charts over time zoom together");
    const shown = page.getByRole("button", { name: "Show all" });
    assert.ok((await shown.count()) > 1);
    await shown.first().click();
    await page.mouse.move(0, 0);
    await page.locator("h1").evaluate(() => document.activeElement.blur());
    await one.same("#probes .plot >> nth=1", before[1], "and back");
    const area = page.getByLabel(/^Contact area/);
    const without = await one.text("#laws figure h3");
    await area.fill("0.04");
    assert.match((await one.text("#laws .legend")).join(" "), /law × area/);
    assert.equal((await one.text("#laws figure h3")).length, without.length);
    await page.locator("#against").getByLabel("Vertical").selectOption("push");
    assert.match((await one.text("#against figure h3"))[0], /^push over/);
    await one.close();
  },

  async "dark mode, a narrow window and paper"(browser) {
    for (const [width, colorScheme] of [[420, "dark"], [420, "light"], [1280, "dark"]]) {
      const one = await Page.open(browser, join(folder, "run.html"), { width, colorScheme });
      await one.ready();
      const { mean } = await one.picture("main");
      const bright = (mean[0] + mean[1] + mean[2]) / 3;
      assert.ok(colorScheme === "dark" ? bright < 70 : bright > 200, `${colorScheme}: mean brightness ${bright}`);
      await one.checkCharts(8);
      if (width === 1280) {
        const pdf = await one.page.pdf({ format: "A4", printBackground: false });
        assert.ok(pdf.length > 50000, "it prints");
      }
      await one.close();
    }
  },

  async "an unfinished run, whose last frames are damaged"(browser) {
    const one = await Page.open(browser, makeReport(tack, folder, ["unfinished"], "unfinished.html"));
    await one.ready();
    assert.deepEqual(await one.text("h1 .badge"), ["unfinished"]);
    assert.match((await one.text(".notice")).join(" "), /frame_000020\.vtu/);
    assert.match((await one.text(".expectations tbody tr"))[0], /stays above.*unknown/s);
    assert.equal(await one.page.locator(".frames").getAttribute("max"), "19");
    assert.ok((await one.picture(".screen")).colours > 20);
    await one.checkCharts(7);
    await one.close();
  },

  async "several runs are overlaid"(browser) {
    const one = await Page.open(browser, makeReport(tack, folder, ["soft", "stiff"], "runs.html"));
    await one.ready();
    const legend = (await one.text("#probes .legend")).join(" ");
    assert.match(legend, /soft.*stiff/s);
    await one.checkCharts(8);
    const soft = await one.picture(".screen");
    await setSlider(one.page, ".frames", 30);
    await one.page.getByLabel("Run", { exact: true }).selectOption({ label: "stiff" });
    await one.page.waitForFunction(() => document.querySelector(".screen canvas").getAttribute("aria-label").includes("stiff"));
    await one.other(".screen", soft);
    assert.equal((await one.text(".expectations tbody tr")).length, 5);
    await one.close();
  },

  async "a scene whose name is a tag"(browser) {
    const one = await Page.open(browser, makeReport(tack, folder, ["evil"], "evil.html"));
    await one.ready();
    assert.match((await one.text("h1"))[0], /^<\/script><b>bold<\/b> done/);
    assert.equal(await one.page.locator("main b").count(), 0);
    await one.close();
  },

  async "a suite: leaderboard, profiles, work against precision, problems"(browser) {
    makeSuite(folder);
    const one = await Page.open(browser, makeReport(tack, folder, ["suite"], "suite.html"));
    await one.ready();
    assert.match((await one.text("h1"))[0], /^Leaderboard of solvers/);
    assert.deepEqual(await one.text("nav a"), ["Leaderboard", "Performance profiles", "Work against precision", "Problems", "All solves", "Provenance"]);
    assert.deepEqual(await one.text("#scores thead th"), ["", "solver", "solved", "unsolved", "failed", "time limit", "another minimum", "PAR2 [s]"]);
    assert.deepEqual(await one.text("#scores tbody tr:nth-child(1) > *"), ["1", "newton", "4 of 4", "0", "–", "–", "1", "0.25"]);
    assert.deepEqual(await one.text("#scores tbody tr:nth-child(3) > *"), ["3", evil, "1 of 4", "3", "2", "1", "–", "30.1"]);
    await one.checkCharts(3);
    assert.match((await one.text("#profiles .note"))[0], /all 4 tasks/);
    assert.deepEqual(await one.text("#precision .legend li span:nth-child(2)"), ["newton", "lbfgs"]);
    assert.match((await one.text("#precision .note"))[0], /the 1 of 2 problems that all solvers shown solve.*less than half of the tasks: <\/script><b>bold<\/b> \(1 of 4\)/s);
    assert.deepEqual(await one.text("#problems tbody tr:nth-child(1) > *"), ["fall", "96", "0.1", "0.2", "0.3"]);
    assert.deepEqual(await one.text("#problems tbody tr:nth-child(2) > *"), [evil, "96", "0.3*", "failed", "limit"]);
    assert.equal(await one.page.locator("#table tbody tr").count(), 12);
    assert.equal(await one.page.locator("main b").count(), 0);
    await one.close();
  },

  async "a comparison: curves, profile, table that sorts and filters"(browser) {
    const one = await Page.open(browser, makeReport(tack, folder, ["compared"], "comparison.html"));
    await one.ready();
    const { page } = one;
    assert.match((await one.text("h1"))[0], /^fall compared/);
    await one.checkCharts(2);
    assert.deepEqual(await one.text("#precision .legend li span:nth-child(2)"), ["newton", "lbfgs", "ceres", "floor 1.5 × 10⁻⁸ m"]);
    assert.match((await one.text("#precision .note"))[0], /1 of 8 have no point: their errors are below the noise floor/);
    assert.deepEqual(await one.text("#text h3"), ["All 3 tasks together"]);
    assert.deepEqual(await one.text("#text tbody tr:last-child > *"), ["a|b <i>", "2", ""]);
    assert.deepEqual(await one.text("#text strong, #text em"), ["Fastest", "best"]);
    await page.getByLabel("Problem").selectOption("</script><b>bold</b>");
    await page.getByLabel("Cost").selectOption("iterations");
    assert.match((await one.text("#precision .note"))[0], /All errors are below the noise floor.*nothing is drawn/);
    assert.match((await one.text("#precision h3"))[0], /^Iterations against error: <\/script>/);
    const rows = page.locator("#table tbody tr");
    assert.equal(await rows.count(), 18);
    await page.getByRole("button", { name: "wall seconds" }).focus();
    await page.keyboard.press("Enter");
    assert.match(await rows.first().innerText(), /newton/);
    await page.keyboard.press("Enter");
    assert.match(await rows.first().innerText(), /ceres.*stopped, too slow/s);
    assert.equal(await page.locator("#table th[aria-sort=descending]").count(), 1);
    await page.getByLabel("Filter").fill("lbfgs iterations > 40");
    assert.equal(await rows.count(), 2);
    assert.match((await one.text("#table .count"))[0], /^2 of 18 rows/);
    await page.getByLabel("Filter").fill("stopped");
    assert.equal(await rows.count(), 2);
    await one.close();
  },

  async "a calibration: parameters, warnings, curves, evaluations"(browser) {
    makeCalibration(folder);
    const one = await Page.open(browser, makeReport(tack, folder, ["calibration"], "calibration.html"));
    await one.ready();
    const { page } = one;
    assert.match((await one.text("h1"))[0], /^a fit done/);
    assert.match((await one.text(".warnings li"))[0], /^the data do not determine <\/script>.*only work/);
    const rows = await one.text("#numbers tbody tr");
    assert.match(rows[0], /5 kPa\s*not known\s*not known/);
    assert.match(rows[0], /finite differences: /);
    assert.match(rows[1], /from the run/);
    assert.match(rows[1], /1 J\/m²\s*0\.98 J\/m² to 1\.02 J\/m²\s*1 %/);
    assert.deepEqual(await one.text("#fits h3"), ["pull: force over way", "pull: residuals"]);
    assert.deepEqual(await one.text("#fits figure:first-child .legend li span:nth-child(2)"), ["simulated", "measured"]);
    assert.match((await one.text("#combinations tbody"))[0], /not known/);
    await one.checkCharts(3);
    await page.getByLabel("Horizontal").selectOption("work");
    assert.match((await one.text("#misfits h3"))[0], /^Misfit against work/);
    assert.equal(await page.locator("#table tbody tr").count(), 3);
    assert.equal(await page.locator("main b").count(), 0);
    await one.close();
  },

  async "a batch: table, plots against keys, curves of all cases, a case in 3D"(browser) {
    const file = makeReport(tack, folder, ["batch"], "batch.html", ["--case", "b"]);
    const one = await Page.open(browser, file);
    await one.ready();
    const { page } = one;
    assert.match((await one.text("h1"))[0], /^falls 5 cases/);
    await one.checkCharts(5);
    assert.match((await one.text("#origin"))[0], /compiler, version\s+12\.2/);
    const rows = page.locator("#table tbody tr");
    assert.equal(await rows.count(), 5);
    assert.match(await rows.nth(4).innerText(), /refused/);
    assert.match((await one.text("#table .mark.good")).join(), /pass/);
    assert.equal(await page.locator("#multiples .chart").count(), 4);
    const all = await one.picture("#plots .plot");
    await page.locator("#table").getByLabel("Filter").fill("young >= 1e6");
    assert.equal(await rows.count(), 3);
    assert.equal(await page.locator("#multiples .chart").count(), 2);
    await one.other("#plots .plot", all, "the filter holds for the plot");
    await page.locator("#table").getByLabel("Filter").fill("");
    await page.locator("#plots").getByLabel("Vertical").selectOption("wall_seconds");
    await page.locator("#plots").getByLabel("Grouped by").selectOption("mu");
    assert.deepEqual(await one.text("#plots .legend li span:nth-child(2)"), ["mu = 0", "mu = 0.5"]);
    assert.match((await one.text("#plots h3"))[0], /^wall seconds against young/);
    await page.locator("#multiples").getByLabel("Shown").selectOption("over");
    assert.equal(await page.locator("#multiples .chart").count(), 1);
    await one.checkCharts(5);
    assert.ok((await one.picture(".screen")).colours > 20);
    await one.close();
    assert.ok(statSync(file).size < 2e6, "a small batch is a small file");
  },
};

makeFixtures(tack, folder);
const browser = await start();
const failures = await runTests(tests, browser);
await browser.close();
rmSync(folder, { recursive: true, force: true });
process.exit(failures > 0 ? 1 : 0);
