// Pictures and films by `tack render`: their contents, checked in a browser, and refused settings.
//   node render_test.mjs TACK MODULES PAGE     ends with code 77 and a message if a requirement is missing
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { needBrowser, runTests } from "./browser.mjs";

const [tack, modules, pageFile] = process.argv.slice(2);
const start = needBrowser(modules, pageFile, "what draws");
const blender = spawnSync("blender", ["--version"]).status === 0;
const films = spawnSync("ffmpeg", ["-version"]).status === 0;

const folder = mkdtempSync(join(tmpdir(), "tack_render_test_"));
const run = (...words) => spawnSync(tack, words, { encoding: "utf8", cwd: folder });
const done = (...words) => {
  const result = run(...words);
  assert.equal(result.status, 0, `${words.join(" ")}: ${result.stderr}${result.stdout}`);
  return result.stdout;
};
const refused = (pattern, ...words) => {
  const result = run(...words);
  assert.equal(result.status, 2, `${words.join(" ")}: ${result.stdout}`);
  assert.match(result.stderr, pattern);
};

// A cube of 1 m above a plate, a rod and particles beside it.
writeFileSync(join(folder, "scene.yaml"), `
name: still_life
time: {step: 20 ms, duration: 0.2 s}
gravity: [0, -5, 0]
objects:
  - {name: plate, shape: {type: box, size: [6, 0.1, 6]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}
  - name: cube
    shape: {type: box, size: [1, 1, 1], cells: [2, 2, 2]}
    place: {translate: [0, 1, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]
output: {frame_interval: 20 ms, fields: [displacement]}
`);
done("run", "scene.yaml", "-q", "-o", "out");

// Two sheets, one of them upside down.
writeFileSync(join(folder, "sheets.yaml"), `
name: sheets
time: {step: 20 ms, duration: 20 ms}
objects:
  - {name: up, shape: {type: grid, size: [2, 2]}, place: {translate: [-2, 0, 0]}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}], shell: {thickness: 1 mm}}
  - {name: down, shape: {type: grid, size: [2, 2]}, place: {axis: [1, 0, 0], angle: 180 deg, translate: [2, 0, 0]}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}], shell: {thickness: 1 mm}}
`);
done("run", "sheets.yaml", "-q", "-o", "sheets");

// Two balls on the ground, z upwards.
writeFileSync(join(folder, "balls.yaml"), `
name: balls
time: {step: 20 ms, duration: 20 ms}
gravity: [0, 0, -10]
objects:
  - {name: left, shape: {type: sphere, radius: 1, cells: 16}, place: {translate: [-1.2, 0, 1]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]}
  - {name: right, shape: {type: sphere, radius: 1, cells: 16}, place: {translate: [1.2, 0, 1]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]}
`);
done("run", "balls.yaml", "-q", "-o", "balls");
const ballView = ["--set", "size=[400, 300]", "camera={from: [0, -9, 3], to: [0, 0, 1], angle: 40 deg}", "time=false", "at=0 s"];
const matt = "objects={left: {colour: '#767676', roughness: 1, smooth: 60 deg}, right: {colour: '#ffffff', roughness: 1, smooth: 60 deg}}"; // 18% and 100%
const metal = "objects={'*': {colour: '#ffffff', metalness: 1, roughness: 0.1, smooth: 60 deg}}";
const ballPlaces = [-1, 1].flatMap((side) => [[-16, -33], [28, 0], [0, 28], [0, -25]].map(([x, y]) => [0.5 + (55 * side + x) / 400, 0.5 + (y - 2) / 300])); // each: facing the sun, right, low, high
const shadowPlace = [0.5 + 108 / 400, 0.5 + 33 / 300]; // on the ground, right of the right ball

// A grain and a rod of radius 1.
writeFileSync(join(folder, "round.yaml"), `
name: round
time: {step: 20 ms, duration: 20 ms}
objects:
  - {name: grain, shape: {type: points, size: [0, 0, 0], counts: [1, 1, 1]}, particle: {radius: 1}, energies: [particle]}
  - {name: rod, shape: {type: segment, length: 4, edges: 4}, place: {translate: [0, 0, -4]}, rod: {radius: 1}, energies: [{type: string, young: 1 MPa, density: 1000}]}
`);
done("run", "round.yaml", "-q", "-o", "round");

const browser = await start();
const tab = await browser.newPage();

// Returns {width, height, pixels: [r, g, b] at fractions of width and height}.
async function looked(file, places) {
  const base64 = readFileSync(join(folder, file)).toString("base64");
  return tab.evaluate(async ([data, at]) => {
    const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
    const canvas = new OffscreenCanvas(picture.width, picture.height);
    const ctx = canvas.getContext("2d");
    ctx.drawImage(picture, 0, 0);
    const pixels = at.map(([x, y]) => [...ctx.getImageData(Math.floor(x * picture.width), Math.floor(y * picture.height), 1, 1).data].slice(0, 3));
    return { width: picture.width, height: picture.height, pixels };
  }, [base64, places]);
}
const grey = ([r, g, b]) => 0.3 * r + 0.6 * g + 0.1 * b;
const above = ["--set", "size=[400, 300]", "camera={from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}", "time=false", "lights=12",
  "objects={plate: {colour: '#808080'}, cube: {colour: '#ff0000', smooth: 0}}"];
const still = ["size=[80, 60]", "camera={from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}", "time=false", "samples=4"];

const tests = {
  async "a view from above: a red cube, its shadow on the plate, the background beside it"() {
    done("render", "out", "-o", "above.png", ...above, "background='#0000ff'");
    const { width, height, pixels } = await looked("above.png", [[0.5, 0.5], [0.585, 0.4], [0.3, 0.2], [0.03, 0.5]]);
    assert.deepEqual([width, height], [400, 300]);
    const [cube, shade, open, beside] = pixels;
    assert.ok(cube[0] > 150 && cube[1] < 60 && cube[2] < 60, `the cube: ${cube}`);
    assert.ok(Math.max(...open) - Math.min(...open) < 12, `the plate is grey: ${open}`);
    assert.ok(grey(open) > 90, `and lit: ${open}`);
    assert.ok(grey(shade) < grey(open) - 3, `the cube shades it: ${shade}, ${open}`);
    assert.deepEqual(beside, [0, 0, 255]);
  },
  async "hidden objects are not drawn and cast no shadow"() {
    done("render", "out", "-o", "hidden.png", ...above, "objects.cube.hide=true");
    const { pixels: [middle, side] } = await looked("hidden.png", [[0.5, 0.5], [0.625, 0.6]]);
    assert.ok(Math.abs(grey(middle) - grey(side)) < 4, `${middle}, ${side}`);
  },
  async "a sheet is equally bright on both sides"() {
    done("render", "sheets", "-o", "sheets.png", "--set", "size=[400, 300]", "camera={from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}", "time=false", "lights=12",
      "objects={'*': {colour: '#808080'}}");
    const { pixels: [one, other] } = await looked("sheets.png", [[0.25, 0.5], [0.75, 0.5]]);
    assert.ok(grey(one) > 90 && grey(other) > 90 && Math.abs(grey(one) - grey(other)) < 12, `${one}, ${other}`);
  },
  async "what faces the sun is exposed fully, and glossy metal mirrors the sky"() {
    done("render", "balls", "-o", "matt.png", ...ballView, matt);
    done("render", "balls", "-o", "dim.png", ...ballView, matt, "light={sun: 0}");
    done("render", "balls", "-o", "one.png", ...ballView, matt, "lights=1");
    done("render", "balls", "-o", "metal.png", ...ballView, metal);
    const [lit, dim, one, mirror] = (await Promise.all(["matt.png", "dim.png", "one.png", "metal.png"].map((file) => looked(file, ballPlaces)))).map(({ pixels }) => pixels.map(grey));
    assert.ok(lit[4] > 235, `white: ${lit}`);
    assert.ok(lit[0] > 105 && lit[0] < 130, `18% grey is half as bright to the eye: ${lit}`); // 118 of 255
    assert.ok(lit[5] < lit[4] - 40, `away from the sun it is darker: ${lit}`);
    assert.ok(dim[4] < lit[4] - 40 && dim[6] > 60, `without a sun there is the sky: ${dim}; ${lit}`);
    assert.ok(Math.abs(one[4] - lit[4]) < 12, `a single drawing is as bright: ${one}; ${lit}`);
    assert.ok(mirror[7] > mirror[6] + 25, `the sky is brighter above, where z points: ${mirror}`);
  },
  async "a field is coloured by its range"() {
    done("render", "out", "-o", "field.png", ...above, "field={name: displacement, range: [0, 0.1]}", "scale_bar=false");
    const { pixels: [cube, plate] } = await looked("field.png", [[0.5, 0.5], [0.3, 0.2]]);
    assert.ok(cube[0] > 120 && cube[1] > 120 && cube[2] < 100, `it fell by more: yellow: ${cube}`);
    assert.ok(plate[2] > plate[1] && plate[0] < 110, `it stood: violet: ${plate}`);
  },
  async "a range with both signs is white at zero and red above it, also if it is asymmetric"() {
    done("render", "out", "-o", "signed.png", ...above, "field={name: displacement, range: [-0.02, 0.1]}", "scale_bar=false");
    const { pixels: [cube, plate] } = await looked("signed.png", [[0.5, 0.5], [0.3, 0.2]]);
    assert.ok(cube[0] > 90 && cube[0] > 1.7 * cube[1] && cube[0] > 1.7 * cube[2], `it fell: red: ${cube}`);
    assert.ok(Math.max(...plate) - Math.min(...plate) < 25, `it stood: white: ${plate}`);
    done("render", "out", "-o", "told.png", ...above, "field={name: displacement, range: [-0.02, 0.1], map: viridis}", "scale_bar=false");
    const { pixels: [, told] } = await looked("told.png", [[0.5, 0.5], [0.3, 0.2]]);
    assert.ok(told[2] > told[0] + 30, `the given colour map is used: ${told}`);
  },
  async "equal calls give equal pictures"() {
    done("render", "out", "-o", "again.png", ...above, "background='#0000ff'");
    assert.ok(readFileSync(join(folder, "above.png")).equals(readFileSync(join(folder, "again.png"))));
  },
  async "a scene is drawn before it is run, as its run at the start"() {
    assert.match(done("check", "scene.yaml", "--picture", "setup.png"), /is OK\nsetup\.png\n$/);
    done("render", "out", "-o", "first.png", "--set", "at=0 s");
    const places = [[0.5, 0.5], [0.5, 0.4], [0.45, 0.45], [0.3, 0.6], [0.7, 0.6], [0.02, 0.02]];
    const setup = await looked("setup.png", places), first = await looked("first.png", places);
    assert.deepEqual([setup.width, setup.height], [first.width, first.height]);
    setup.pixels.forEach((pixel, i) => pixel.forEach((value, k) => assert.ok(Math.abs(value - first.pixels[i][k]) < 4, `${places[i]}: ${pixel}, ${first.pixels[i]}`)));
    assert.ok(Math.abs(grey(setup.pixels[0]) - grey(setup.pixels[5])) > 10, `an object in the middle: ${setup.pixels}`);
  },
  async "several runs are drawn side by side"() {
    done("render", "out", "out", "-o", "both.png", "--set", "size=[600, 200]", "camera={from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}", "lights=4", "labels=[one, other]",
      "objects={cube: {colour: '#ff0000'}}");
    const { pixels } = await looked("both.png", [[0.25, 0.5], [0.75, 0.5]]);
    for (const one of pixels) assert.ok(one[0] > 120 && one[1] < 90, `${one}`);
  },
  async "a later pattern keeps what it does not name"() {
    done("render", "out", "-o", "merged.png", ...above.slice(0, -1), "objects={'*': {hide: true, colour: '#0000ff'}, cube: {hide: false}}", "background='#00ff00'");
    const { pixels: [cube, plate] } = await looked("merged.png", [[0.5, 0.5], [0.3, 0.2]]);
    assert.ok(cube[2] > 150 && cube[0] < 60, `the cube is blue, and shown again: ${cube}`);
    assert.deepEqual(plate, [0, 255, 0]);
  },
  async "an object whose name is a whole number has its own look rather than that of a pattern"() {
    done("run", "scene.yaml", "-q", "-o", "numbers", "--set", "objects.cube.name='1'", "time.duration=20 ms");
    for (const by of blender ? ["browser", "blender"] : ["browser"]) {
      done("render", "numbers", "-o", "number.png", "--with", by, "--set", "size=[80, 60]", "camera={from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}", "time=false",
        "objects={'*': {colour: '#0000ff'}, '1': {colour: '#ff0000'}}", by === "blender" ? "samples=4" : "lights=2");
      const { pixels: [cube, plate] } = await looked("number.png", [[0.5, 0.5], [0.3, 0.2]]);
      assert.ok(cube[0] > 1.5 * cube[2], `${by}: the object 1 is red: ${cube}`);
      assert.ok(plate[2] > 1.5 * plate[0], `${by}: all others are blue: ${plate}`);
    }
  },
  async "the camera stands in the scene, wherever its objects are"() {
    done("run", "scene.yaml", "-q", "-o", "away", "--set", "objects.plate.place.translate=[40, -0.05, 7]", "objects.cube.place.translate=[40, 1, 7]");
    done("render", "away", "-o", "away.png", ...above, "background='#0000ff'", "camera={from: [40, 8, 7.01], to: [40, 0, 7], angle: 40 deg}");
    const places = [[0.5, 0.5], [0.3, 0.2], [0.03, 0.5]];
    const [here, there] = [(await looked("above.png", places)).pixels, (await looked("away.png", places)).pixels];
    here.forEach((pixel, i) => assert.ok(pixel.every((x, c) => Math.abs(x - there[i][c]) < 12), `${pixel}; ${there[i]}`));
  },
  async "the time that is written is that of the frame"() {
    const view = ["--set", "size=[400, 300]", "lights=2"];
    done("render", "out", "-o", "end.png", ...view, "at=0.2s");
    const later = run("render", "out", "-o", "later.png", ...view, "at=7s");
    assert.equal(later.status, 0);
    assert.equal(later.stderr, "note: at: 7 s is after the end of out; its last frame, at t = 0.2 s, is drawn\n");
    assert.equal(run("render", "out", "-o", "later.png", "-q", ...view, "at=7s").stderr, "");
    assert.equal(run("render", "out", "-o", "within.png", ...view, "at=0.2s").stderr, "");
    done("render", "out", "-o", "earlier.png", ...view, "at=0.18s");
    assert.ok(readFileSync(join(folder, "end.png")).equals(readFileSync(join(folder, "later.png"))));
    assert.ok(!readFileSync(join(folder, "end.png")).equals(readFileSync(join(folder, "earlier.png"))));
  },
  async "the ground has the shadow of what is above it, and the background beside it"() {
    const view = [...above.slice(0, -1), "objects={plate: {hide: true}, cube: {colour: '#ff0000', smooth: 0}}", "background='#ffffff'"];
    done("render", "out", "-o", "ground.png", ...view, "ground={at: 0}");
    const { pixels: [cube, shade, open] } = await looked("ground.png", [[0.5, 0.5], [0.585, 0.4], [0.05, 0.95]]);
    assert.ok(cube[0] > 150 && cube[1] < 60, `the cube: ${cube}`);
    assert.ok(grey(shade) < 245 && Math.max(...shade) - Math.min(...shade) < 12, `grey shadow: ${shade}`);
    assert.ok(grey(open) > 252, `white far from it: ${open}`);
    // Few lights, as films have, shade it as smoothly as many.
    done("render", "out", "-o", "few.png", ...view, "ground={at: 0}", "lights=4");
    const places = Array.from({ length: 60 }, (_, i) => [0.1 + 0.8 * ((i % 10) / 9), 0.1 + 0.8 * (Math.floor(i / 10) / 5)]);
    const [many, few] = [(await looked("ground.png", places)).pixels, (await looked("few.png", places)).pixels];
    many.forEach((pixel, i) => pixel[0] > 200 && pixel[1] < 100 || assert.ok(Math.abs(grey(pixel) - grey(few[i])) < 12, `${places[i]}: ${pixel}, ${few[i]}`));
    done("render", "out", "-o", "green.png", ...view, "ground={at: 0, colour: '#00a000'}");
    const { pixels: [, darker, lit] } = await looked("green.png", [[0.5, 0.5], [0.585, 0.4], [0.05, 0.95]]);
    assert.ok(lit[1] > 90 && lit[1] > lit[0] + 60 && darker[1] < lit[1] - 3, `${lit}, ${darker}`);
  },
  async "the ground lies below a body in oblique gravity"() {
    done("run", "scene.yaml", "-q", "-o", "tilted", "--set", "gravity=[3.5, -3.5, 0]", "time.duration=20 ms");
    // From the side, up in the picture is against gravity: the cube stands on an edge.
    done("render", "tilted", "-o", "tilted.png", "--set", "size=[200, 200]", "camera={from: [-0.5, 1.5, 6], to: [0, 1, 0], angle: 40 deg}", "time=false", "lights=2",
      "objects={plate: {hide: true}, cube: {colour: '#ff0000'}}", "ground={colour: '#0000ff'}");
    const { pixels } = await looked("tilted.png", [[0.5, 0.45], [0.5, 0.58], [0.5, 0.9]]);
    for (const cube of pixels.slice(0, 2)) assert.ok(cube[0] > 1.5 * cube[2], `the cube, also its lower half: ${pixels}`);
    assert.ok(pixels[2][2] > 1.5 * pixels[2][0], `the ground: ${pixels}`);
  },
  async "the ground lies below rods and particles, which have radii"() {
    // From the side, at the height of the centres: the lower half of a ball and of a rod, then the ground.
    for (const by of blender ? ["browser", "blender"] : ["browser"])
      for (const name of ["grain", "rod"]) {
        done("render", "round", "-o", `${name}.png`, "--with", by, "--set", "size=[200, 200]", "camera={from: [0, 0, 8], to: [0, 0, 0], angle: 40 deg}", "time=false", "at=0 s",
          `objects={'*': {hide: true}, ${name}: {hide: false, colour: '#ff0000'}}`, "ground={colour: '#0000ff'}", by === "blender" ? "samples=4" : "lights=2");
        const { pixels: [low, ground] } = await looked(`${name}.png`, [[0.5, 0.55], [0.5, 0.75]]);
        assert.ok(low[0] > 1.5 * low[2], `${name}, ${by}: its lower half is above the ground: ${low}`);
        assert.ok(ground[2] > 1.5 * ground[0], `${name}, ${by}: the ground: ${ground}`);
      }
  },
  async "a transparent background, also below a shadow, and numbered pictures"() {
    const view = [...above.slice(0, -1), "objects={plate: {hide: true}, cube: {colour: '#ff0000', smooth: 0}}", "background=transparent"];
    done("render", "out", "-o", "clear.png", ...view, "ground={at: 0}");
    const alphas = await tab.evaluate(async ([data, at]) => {
      const picture = await createImageBitmap(await (await fetch(`data:image/png;base64,${data}`)).blob());
      const ctx = new OffscreenCanvas(picture.width, picture.height).getContext("2d");
      ctx.drawImage(picture, 0, 0);
      return at.map(([x, y]) => ctx.getImageData(Math.floor(x * picture.width), Math.floor(y * picture.height), 1, 1).data[3]);
    }, [readFileSync(join(folder, "clear.png")).toString("base64"), [[0.5, 0.5], [0.585, 0.4], [0.02, 0.98]]]);
    assert.equal(alphas[0], 255);
    assert.ok(alphas[1] > 10 && alphas[1] < 250, `a shadow: ${alphas[1]}`);
    assert.ok(alphas[2] <= 5, `nothing: ${alphas[2]}`);
    assert.match(done("render", "out", "-o", "part_%03d.png", ...view, "lights=1", "from=0.1"), /frame 6 of 6/);
    for (const i of [0, 5]) assert.ok(statSync(join(folder, `part_00${i}.png`)).size > 500);
    refused(/films have no transparent background/, "render", "out", "-o", "film.mp4", "--set", "background=transparent");
  },
  async "a film has each frame once, however they are spaced"() {
    done("run", "scene.yaml", "-q", "-o", "late", "--set", "output.frames_from=0.16");
    const view = [...above.slice(0, -1), "size=[80, 60]", "lights=1", "objects.cube.colour='#ff0000'"];
    assert.match(done("render", "late", "-o", "each_%01d.png", ...view), /frame 4 of 4/); // 0, 0.16, 0.18, 0.2 s
    const pictures = [0, 1, 2, 3].map((i) => readFileSync(join(folder, `each_${i}.png`)).toString("base64"));
    assert.equal(new Set(pictures).size, 4);
  },
  async "film-like tones darken what is bright less than exposure brightens it"() {
    for (const [file, ...more] of [["plain.png"], ["bright.png", "exposure=4"], ["toned.png", "exposure=4", "tone=filmic"]])
      done("render", "out", "-o", file, ...above, "background='#000000'", ...more);
    const [plain, bright, toned] = await Promise.all(["plain.png", "bright.png", "toned.png"].map(async (f) => grey((await looked(f, [[0.3, 0.2]])).pixels[0])));
    assert.ok(bright > plain + 30 && toned < bright - 3 && toned > plain, `${plain}, ${bright}, ${toned}`);
  },
  async "films"() {
    if (!films) return console.log("skipped: there is no ffmpeg: apt-get install ffmpeg");
    for (const film of ["film.mp4", "film.gif"]) {
      const told = done("render", "out", "-o", film, "--set", "size=[160, 120]", "lights=2");
      assert.match(told, /frame 11 of 11/);
      assert.ok(statSync(join(folder, film)).size > 1000);
      const probe = spawnSync("ffprobe", ["-v", "error", "-count_frames", "-select_streams", "v", "-show_entries", "stream=width,height,nb_read_frames", "-of", "csv=p=0", film],
        { encoding: "utf8", cwd: folder });
      assert.match(probe.stdout, /^160,120,11/);
    }
    assert.match(done("render", "out", "-o", "slow.mp4", "--set", "size=[160, 120]", "lights=1", "speed=0.2", "from=0.1"), /frame 16 of 16/);
  },
  async "Blender draws the same objects at the same places as the browser"() {
    if (!blender) return console.log("skipped: there is no Blender: apt-get install blender");
    const places = Array.from({ length: 1200 }, (_, i) => [((i % 40) + 0.5) / 40, (Math.floor(i / 40) + 0.5) / 30]);
    const kind = ([r, g, b]) => (r > 1.5 * g && r > 1.5 * b ? "cube" : b > 1.5 * r && b > 1.5 * g ? "background" : "plate");
    const common = ["--set", "size=[200, 150]", "time=false", "background='#0000ff'", "objects={plate: {colour: '#808080'}, cube: {colour: '#ff0000', smooth: 0}}"];
    for (const camera of ["{from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}", "{look: corner, turn: 20 deg, lift: 10 deg}", "{look: x, zoom: 1.5, fit: last}"]) {
      done("render", "out", "-o", "browser.png", ...common, "lights=4", `camera=${camera}`);
      done("render", "out", "-o", "blender.png", "--with", "blender", ...common, "samples=4", `camera=${camera}`);
      const [one, other] = [(await looked("browser.png", places)).pixels.map(kind), (await looked("blender.png", places)).pixels.map(kind)];
      assert.equal(new Set(one).size, 3, `the view shows the cube, the plate and the background: ${camera}`);
      const same = one.filter((k, i) => k === other[i]).length;
      assert.ok(same > 0.97 * places.length, `${camera}: ${same} of ${places.length} places agree`);
    }
    done("render", "out", "-o", "50% strain/numbered_%02d.png", "--with", "blender", ...common, "samples=1", "from=0.18");
    for (const i of [0, 1]) assert.ok(statSync(join(folder, `50% strain/numbered_0${i}.png`)).size > 300);
    if (films) {
      done("render", "out", "-o", "traced.mp4", "--with", "blender", ...common, "samples=1", "from=0.16");
      assert.ok(statSync(join(folder, "traced.mp4")).size > 500);
    }
    assert.match(run("render", "out", "-o", "after.png", "--with", "blender", ...common, "samples=1", "at=7s").stderr, /^note: at: 7 s is after the end of out; its last frame, at t = 0\.2 s, is drawn$/m);
    refused(/field is not drawn by Blender/, "render", "out", "--with", "blender", "--set", "field={name: displacement}");
    refused(/no run has an object 'cubo'/, "render", "out", "--with", "blender", "--set", "objects={cubo: {hide: true}}");
    refused(/Blender takes colours as #rrggbb/, "render", "out", "--with", "blender", "--set", "background=tomato");
  },
  async "Blender draws as brightly as the browser"() {
    if (!blender) return console.log("skipped: there is no Blender: apt-get install blender");
    for (const [name, looks, tolerance, shadowTolerance] of [["matt", matt, 15, 30], ["metal", metal, 15, 30]]) {
      const common = [...ballView, looks, "ground={}"];
      done("render", "balls", "-o", `browser_${name}.png`, ...common);
      done("render", "balls", "-o", `blender_${name}.png`, "--with", "blender", ...common, "samples=64");
      const [one, other] = (await Promise.all(["browser", "blender"].map((by) => looked(`${by}_${name}.png`, [...ballPlaces, shadowPlace])))).map(({ pixels }) => pixels.map(grey));
      const shadows = [one.pop(), other.pop()];
      one.forEach((value, i) => assert.ok(Math.abs(value - other[i]) < tolerance, `${name}: ${one}; Blender ${other}`));
      assert.ok(Math.max(...shadows) < 235 && Math.abs(shadows[0] - shadows[1]) < shadowTolerance, `shadows: ${shadows}`);
      console.log(name, one.map(Math.round).join(" "), "|", other.map(Math.round).join(" "), "| shadows", shadows.map(Math.round).join(" "));
    }
  },
  async "Blender draws runs side by side, cuts them and offsets their surfaces"() {
    if (!blender) return console.log("skipped: there is no Blender: apt-get install blender");
    const view = ["--set", "time=false", "samples=4", "background='#0000ff'", "objects={plate: {hide: true}, cube: {colour: '#ff0000'}}", "camera={from: [0, 8, 0.01], to: [0, 0, 0], angle: 40 deg}"];
    // Seen from above the cube, of 1 m, is red; counts the red of pixels 200 wide.
    const red = async (file, from, to) => {
      const places = Array.from({ length: 4000 }, (_, i) => [from + ((to - from) * ((i % 80) + 0.5)) / 80, (Math.floor(i / 80) + 0.5) / 50]);
      return (await looked(file, places)).pixels.filter(([r, , b]) => r > 1.5 * b).length;
    };
    const draw = (file, ...more) => done("render", "out", "-o", file, "--with", "blender", ...view, "size=[200, 150]", ...more);
    draw("whole.png");
    draw("half.png", "section={through: [0, 0, 0], normal: [1, 0, 0]}");
    draw("closed.png", "section={through: [0, 1, 0], normal: [0, 1, 0]}");
    draw("larger.png", "objects.cube.offset=0.2");
    const [whole, half, closed, larger] = await Promise.all(["whole.png", "half.png", "closed.png", "larger.png"].map((file) => red(file, 0, 1)));
    assert.ok(whole > 100, `${whole}`);
    assert.ok(Math.abs(half / whole - 0.5) < 0.1, `half of it is left: ${half} of ${whole}`);
    assert.equal(await red("half.png", 0.52, 1), 0);
    assert.ok(closed > 0.7 * whole, `the section is closed: ${closed} of ${whole}`);
    assert.ok(larger > 1.2 * whole && larger < 2 * whole, `${larger} against ${whole}`);
    done("render", "out", "out", "-o", "pair.png", "--with", "blender", ...view, "size=[400, 150]", "labels=[a, b]");
    const [left, right] = [await red("pair.png", 0, 0.5), await red("pair.png", 0.5, 1)];
    assert.ok(Math.abs(left / whole - 1) < 0.15 && Math.abs(right / whole - 1) < 0.15, `each run has its half: ${left} and ${right} of ${whole}`);
    refused(/labels: 1 for 2 runs; give one for each/, "render", "out", "out", "--with", "blender", "--set", "labels=[a]");
  },
  async "Blender keeps the background's colour, whatever exposure and tone"() {
    if (!blender) return console.log("skipped: there is no Blender: apt-get install blender");
    for (const settings of [["tone=filmic"], ["exposure=4"], ["tone=filmic", "exposure=0.5"]]) {
      done("render", "out", "-o", "kept.png", "--with", "blender", ...above.slice(0, 1), ...still, "background='#808080'", "objects={'*': {colour: '#ff0000'}}", ...settings);
      const { pixels: [cube, beside] } = await looked("kept.png", [[0.5, 0.5], [0.03, 0.5]]);
      assert.deepEqual(beside, [128, 128, 128], `${settings}`);
      assert.ok(cube[0] > 1.5 * cube[2], `the cube: ${cube}`);
    }
  },
  async "Blender rounds by subdivision, and lets light through by transmission and translucency"() {
    if (!blender) return console.log("skipped: there is no Blender: apt-get install blender");
    const places = Array.from({ length: 80 * 60 }, (_, i) => [((i % 80) + 0.5) / 80, (Math.floor(i / 80) + 0.5) / 60]);
    const draw = async (...look) => {
      done("render", "out", "-o", "look.png", "--with", "blender", ...above.slice(0, 1), ...still, "background='#0000ff'", "samples=16",
        "objects={plate: {hide: true}, cube: {colour: '#ff4000', roughness: 0}}", ...look);
      return (await looked("look.png", places)).pixels;
    };
    const plain = await draw();
    const inside = places.map((_, i) => i).filter((i) => plain[i][0] > plain[i][2]);
    assert.ok(inside.length > 100, `the cube covers ${inside.length} of ${places.length} places`);
    const mean = (picture) => [0, 1, 2].map((c) => inside.reduce((sum, i) => sum + picture[i][c], 0) / inside.length);
    const rounded = (await draw("objects.cube.subdivide=2")).filter(([r, , b]) => r > b).length;
    assert.ok(rounded > 0.5 * inside.length && rounded < 0.97 * inside.length, `the corners are rounded off: ${rounded} of ${inside.length}`);
    const opaque = mean(plain);
    for (const [key, least] of [["transmission", 20], ["translucency", 3]]) {
      const passed = mean(await draw(`objects.cube.${key}=1`));
      const difference = Math.hypot(...opaque.map((x, c) => x - passed[c]));
      console.log(key, opaque.map(Math.round).join(" "), "|", passed.map(Math.round).join(" "));
      assert.ok(difference > least, `${key}: ${opaque}; ${passed}`);
    }
  },
  async "rods without a radius are as thick in Blender as in the browser"() {
    if (!blender) return console.log("skipped: there is no Blender: apt-get install blender");
    done("run", "round.yaml", "-q", "-o", "thread", "--set", "objects.rod.rod=null", "objects.rod.energies=[]", "objects.rod.motion=[fixed]");
    const places = Array.from({ length: 400 }, (_, i) => [0.5, (i + 0.5) / 400]);
    const thickness = async (by) => {
      done("render", "thread", "-o", "thread.png", "--with", by, "--set", "size=[60, 400]", "camera={from: [0, 0, 2], to: [0, 0, -4], angle: 2 deg}", "time=false", "at=0 s", "background='#0000ff'",
        "objects={grain: {hide: true}, rod: {colour: '#ff0000'}}", by === "blender" ? "samples=8" : "lights=4");
      return (await looked("thread.png", places)).pixels.filter(([r, , b]) => r > b).length;
    };
    const [one, other] = [await thickness("browser"), await thickness("blender")];
    assert.ok(one > 20 && Math.abs(one - other) <= 0.1 * one + 2, `${one} and ${other} pixels`);
  },
  async "invalid settings are refused"() {
    refused(/section: only Blender draws it/, "render", "out", "--set", "section={through: [0, 0, 0], normal: [1, 0, 0]}");
    refused(/normal: must not be zero/, "render", "out", "--with", "blender", "--set", "section={through: [0, 0, 0], normal: [0, 0, 0]}");
    refused(/samples: only Blender takes them; give --with blender/, "render", "out", "--set", "samples=4");
    refused(/objects\.cube: transmission, translucency, subdivide and offset are drawn by Blender alone/, "render", "out", "--set", "objects.cube.transmission=1");
    refused(/setup\.jpg: names of pictures end in \.png/, "check", "scene.yaml", "--picture", "setup.jpg");
    refused(/picture\.jpg: names of pictures end in \.png, names of films in \.mp4 or \.gif/, "render", "out", "-o", "picture.jpg");
    refused(/no run has an object 'cubo'; there are plate, cube/, "render", "out", "--set", "objects={cubo: {hide: true}}");
    for (const by of blender ? ["browser", "blender"] : ["browser"]) refused(/all objects are hidden/, "render", "out", "--with", by, "--set", "objects={'*': {hide: true}}");
    // Before a browser is looked for.
    const unknown = spawnSync(tack, ["render", "out", "--set", "field={name: stress}"], { encoding: "utf8", cwd: folder, env: { ...process.env, PATH: "/nowhere" } });
    assert.equal(unknown.status, 2);
    assert.match(unknown.stderr, /field: 'out' has no 'stress'; its frames have displacement \(output\.fields\)/);
    const late = spawnSync(tack, ["render", "out", "-o", "late.mp4", "--set", "from=10"], { encoding: "utf8", cwd: folder, env: { ...process.env, PATH: "/nowhere" } });
    assert.equal(late.status, 2);
    assert.match(late.stderr, /no frame is between 10 and 0\.2 s \(from, to\): the frames of the run go from 0 to 0\.2 s/);
    refused(/unknown key 'colour' in/, "render", "out", "--set", "colour=red");
    refused(/there is no such folder/, "render", "nowhere");
  },
};

let failures = 0;
try {
  failures = await runTests(tests, browser);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
process.exit(failures > 0 ? 1 : 0);
