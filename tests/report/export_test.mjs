// Exports that other programs read: glTF in a browser by three.js, USD by the parser of three.js.
//   node export_test.mjs TACK MODULES PAGE SOURCE     ends with code 77 and a message if a requirement is missing
import assert from "node:assert/strict";
import { spawnSync } from "node:child_process";
import { cpSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { needBrowser, runTests } from "./browser.mjs";

const [tack, modules, pageFile, source] = process.argv.slice(2);
const start = needBrowser(modules, pageFile, "three.js");
const esbuild = createRequire(join(resolve(modules), "package.json"))("esbuild");
const tolerance = 3e-7; // m: single precision of coordinates up to 3 m

const folder = mkdtempSync(join(tmpdir(), "tack_export_test_"));
const done = (...words) => {
  const result = spawnSync(tack, words, { encoding: "utf8", cwd: folder });
  assert.equal(result.status, 0, `${words.join(" ")}: ${result.stderr}${result.stdout}`);
  return result.stdout;
};
for (const file of ["scene.yaml", "quads.obj", "quads.mtl"]) cpSync(join(source, "tests/blender", file), join(folder, file));
done("run", "scene.yaml", "-q", "-o", "run");
for (const format of ["obj", "usd", "gltf"]) done("export", "run", "--to", format);
const names = ["floor", "sheet", "a_ball", "rod", "grains"], samples = 11;

// Positions of an object in a sample, by the .obj files, which C++ tests hold against the frames.
const read = new Map();
function expected(name, sample) {
  const file = join(folder, `run/export/obj/${name}_${String(sample).padStart(6, "0")}.obj`);
  if (!read.has(file)) read.set(file, readFileSync(file, "utf8").split("\n").filter((l) => l.startsWith("v ")).map((l) => l.split(" ").slice(1).map(Number)));
  return read.get(file);
}
const apart = (a, b) => Math.max(...a.map((c, i) => Math.abs(c - b[i])));
function agree(what, positions, wanted) {
  assert.equal(positions.length, wanted.length, `${what}: vertices`);
  const worst = Math.max(...positions.map((p, i) => apart(p, wanted[i])));
  assert.ok(worst < tolerance, `${what}: off by ${worst} m`);
}

async function bundled(code) {
  const made = await esbuild.build({ stdin: { contents: code, resolveDir: resolve(modules) }, nodePaths: [join(resolve(modules), "node_modules")], bundle: true, write: false,
    format: "iife", target: "es2022", logLevel: "warning" });
  return made.outputFiles[0].text;
}

const viewer = `
  import * as THREE from "three";
  import { GLTFLoader } from "three/examples/jsm/loaders/GLTFLoader.js";
  import { USDAParser } from "three/examples/jsm/loaders/usd/USDAParser.js";
  window.open_gltf = async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const gltf = await new GLTFLoader().parseAsync(bytes.buffer, "");
    const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
    renderer.setSize(640, 480);
    document.body.append(renderer.domElement);
    const scene = new THREE.Scene(), camera = new THREE.PerspectiveCamera(45, 4 / 3, 0.01, 100);
    scene.background = new THREE.Color("white");
    camera.position.set(1.5, 1.5, 4.5);
    camera.lookAt(0.3, 0.2, 0);
    scene.add(gltf.scene, new THREE.HemisphereLight("white", "grey", 3));
    const mixer = new THREE.AnimationMixer(gltf.scene);
    const clip = gltf.animations[0];
    mixer.clipAction(clip).setLoop(THREE.LoopOnce).play().clampWhenFinished = true;
    window.at = (time) => {
      mixer.setTime(time);
      gltf.scene.updateMatrixWorld(true);
      renderer.render(scene, camera);
      const objects = {};
      gltf.scene.traverse((thing) => {
        if (!thing.geometry) return;
        const place = new THREE.Vector3(), uv = thing.geometry.attributes.uv, object = { kind: thing.type, materials: [thing.material.name], colour: thing.material.color.toArray(), positions: [], uvs: [] };
        for (let i = 0; i < thing.geometry.attributes.position.count; ++i) {
          // Lines and points have no getVertexPosition.
          THREE.Mesh.prototype.getVertexPosition.call(thing, i, place);
          object.positions.push(thing.localToWorld(place).toArray());
          if (uv) object.uvs.push([uv.getX(i), uv.getY(i)]);
        }
        object.triangles = thing.geometry.index.count / 3;
        (objects[thing.parent.children.length > 1 && thing.parent.name && thing.parent.name !== "mixed" ? thing.parent.name : thing.name] ??= []).push(object);
      });
      return objects;
    };
    return { duration: clip.duration, tracks: clip.tracks.length, up: gltf.scene.children[0].name };
  };
  window.parse_usd = (text) => new USDAParser().parseText(text);
`;

const browser = await start();
const said = [];
async function page() {
  const one = await browser.newPage();
  one.on("console", (message) => /GPU stall due to ReadPixels/.test(message.text()) || said.push(message.text()));
  one.on("pageerror", (error) => said.push(error.stack));
  await one.setContent("<!doctype html><title>export</title><body></body>");
  await one.addScriptTag({ content: await bundled(viewer) });
  return one;
}

const tests = {
  async "glTF: three.js plays the run, with positions of each sample and between them"() {
    const tab = await page();
    const about = await tab.evaluate((data) => window.open_gltf(data), readFileSync(join(folder, "run/export/mixed.glb")).toString("base64"));
    assert.ok(Math.abs(about.duration - 0.1) < 1e-6, `duration ${about.duration}`);
    for (const time of [0, 0.04, 0.045, 0.1]) {
      const objects = await tab.evaluate((t) => window.at(t), time);
      assert.deepEqual(Object.keys(objects).sort(), [...names].sort());
      const sample = Math.floor(time * 100 + 1e-6), rest = time * 100 - sample;
      const wanted = (name) => (rest < 1e-3 ? expected(name, sample) : expected(name, sample).map((p, v) => p.map((c, i) => c + rest * (expected(name, sample + 1)[v][i] - c))));
      for (const name of names) {
        const parts = objects[name];
        if (name !== "sheet") agree(`${name} at ${time} s`, parts[0].positions, wanted(name));
        else
          for (const part of parts)
            part.positions.forEach((p, i) => {
              const [u, v] = part.uvs[i]; // glTF counts v from the top
              assert.ok(apart(p, wanted(name)[Math.round(2 * u) + 3 * Math.round(1 - v)]) < tolerance, `sheet at ${time} s: ${p} has texture coordinates ${u}, ${v}`);
            });
      }
      assert.deepEqual(objects.sheet.map((part) => part.materials[0]), ["red", "plain"]);
      assert.deepEqual(objects.sheet[0].colour.map((c) => Math.round(c * 1e4) / 1e4), [0.8, 0.1, 0.05]);
      assert.deepEqual(names.map((name) => objects[name][0].kind), ["Mesh", "Mesh", "Mesh", "LineSegments", "Points"]);
      if (process.env.TACK_PICTURES) writeFileSync(join(process.env.TACK_PICTURES, `gltf_${time}.png`), await tab.locator("canvas").screenshot());
      const colours = await tab.evaluate(() => {
        const canvas = document.querySelector("canvas"), gl = canvas.getContext("webgl2"), data = new Uint8Array(4 * 640 * 480);
        gl.readPixels(0, 0, 640, 480, gl.RGBA, gl.UNSIGNED_BYTE, data);
        let drawn = 0;
        for (let i = 0; i < data.length; i += 4) if (data[i] + data[i + 1] + data[i + 2] < 700) ++drawn;
        return drawn / (640 * 480);
      });
      assert.ok(colours > 0.1 && colours < 0.9, `${colours} of the picture are drawn`);
    }
    await tab.close();
  },

  async "glTF: fewer frames, another speed, and what it refuses"() {
    const out = done("export", "run", "--to", "gltf", "frames=3", "speed=0.1", "-o", "few.glb");
    assert.match(out, /3 of 11 samples are written/);
    const tab = await page();
    const about = await tab.evaluate((data) => window.open_gltf(data), readFileSync(join(folder, "few.glb")).toString("base64"));
    assert.ok(Math.abs(about.duration - 1) < 1e-6, `duration ${about.duration}`);
    agree("the ball in the middle", (await tab.evaluate(() => window.at(0.5))).a_ball[0].positions, expected("a_ball", 5));
    await tab.close();
    const refused = spawnSync(tack, ["export", "run", "--to", "gltf", "-o", "few.gltf"], { encoding: "utf8", cwd: folder });
    assert.equal(refused.status, 2);
    assert.match(refused.stderr, /end in \.glb/);
  },

  async "USD: another parser reads every sample"() {
    const tab = await page();
    const tree = await tab.evaluate((text) => window.parse_usd(text), readFileSync(join(folder, "run/export/mixed.usda"), "utf8"));
    const root = tree['def Xform "mixed"'];
    const numbers = (text) => JSON.parse(text.replaceAll("(", "[").replaceAll(")", "]").replace(/,\s*$/, ""));
    for (const [type, name] of [["Mesh", "sheet"], ["Mesh", "a_ball"], ["BasisCurves", "rod"], ["Points", "grains"]]) {
      const points = root[`def ${type} "${name}"`]["point3f[] points.timeSamples"];
      assert.deepEqual(Object.keys(points).map(Number).sort((a, b) => a - b), [...Array(samples).keys()], `${name}: times`);
      for (const sample of [0, 4, 10]) agree(`${name} in sample ${sample}`, numbers(points[sample]), expected(name, sample));
    }
    agree("the floor", numbers(root['def Mesh "floor"']["point3f[] points"]), expected("floor", 0));
    assert.deepEqual(numbers(root['def Mesh "sheet"']["int[] faceVertexCounts"]), [4, 4]);
    await tab.close();
  },
};
const failures = await runTests(tests, browser);
await browser.close();
rmSync(folder, { recursive: true });
if (said.length) console.log(`FAIL  the console stays silent\n${said.join("\n")}`);
process.exit(failures || said.length ? 1 : 0);
