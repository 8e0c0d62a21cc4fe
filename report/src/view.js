// The section with the 3D view: its controls, the colour scale, playing and pictures.
import { button, checkbox, freshId, h, labelled, section, select } from "./dom.js";
import { ColourScale, centred, mapOf } from "./colour_scale.js";
import { format, scaled } from "./format.js";
import { Frames } from "./frames.js";
import { Stage } from "./stage.js";
import { onThemeChange, style, surfaceColours } from "./theme.js";
import { wholeNumbers } from "./unpack.js";

const listed = 24; // number of objects before their list scrolls

const mostFrames = 400;           // of a live run
const marked = [0.9, 0.12, 0.02]; // linear colour of highlighted vertices
const faded = [0.32, 0.32, 0.32]; // linear colour of all others

const views = new WeakMap();

// newest: the view starts at the last frame.
export function viewSection(runs, { title = "Motion", newest = false } = {}) {
  const shown = runs.filter((run) => run.frames);
  if (shown.length === 0) return section("view", title, h("p", { class: "note" }, "There are no frames to show."));
  const view = new View(shown, newest);
  const element = section("view", title, view.element);
  views.set(element, view);
  return element;
}

// Returns the view of a section made by viewSection(); undefined if the section has no frames.
export const viewOf = (element) => views.get(element);

class View {
  constructor(runs, newest) {
    this.runs = runs;
    this.cache = new Map();
    this.colours = Stage.objectColours();
    this.frame = newest ? Infinity : 0;
    this.field = null; // objects
    this.range = "run";
    this.log = false;
    this.wantedMap = "automatic";
    this.mark = null; // highlighted: {object} or {vertices: a set}
    this.cutAxis = null;
    this.build();
    this.start();
  }

  build() {
    this.canvas = h("canvas", { tabindex: 0, role: "application", "aria-roledescription": "3D view", "aria-label": "3D view", "aria-describedby": "view-keys" });
    this.overlay = h("canvas", { class: "overlay", "aria-hidden": "true" });
    this.screen = h("div", { class: "screen" }, this.canvas, this.overlay);
    this.slider = h("input", { type: "range", min: 0, max: 0, value: 0, step: 1, class: "frames", oninput: () => this.go(Number(this.slider.value)) });
    this.caption = h("output", { class: "time", for: (this.slider.id = freshId("frame")) });
    this.playButton = button("Play", () => this.play(!this.playing), { class: "play" });
    this.rate = select([["0.25", "¼ ×"], ["0.5", "½ ×"], ["1", "1 ×"], ["2", "2 ×"], ["4", "4 ×"]], "1", () => {});
    this.fieldSelect = h("select", { onchange: () => this.setField(this.fieldSelect.value) });
    this.rangeSelect = select([["run", "whole run"], ["frame", "this frame"], ["most", "without top 1 %"]], "run", (value) => {
      this.range = value;
      this.colour();
    });
    this.logBox = checkbox("logarithmic", false, (on) => {
      this.log = on;
      this.colour();
    });
    this.mapSelect = select([["automatic", "by sign"], ["viridis", "viridis"], ["magma", "magma"], ["cividis", "cividis"], ["red_blue", "red – blue"]], "automatic", (map) => {
      this.wantedMap = map;
      this.colour();
    });
    this.markSelect = h("select", { onchange: () => this.highlight(this.markSelect.value) });
    this.shellBox = checkbox("contact distance", false, (on) => this.stage.setShells(on));
    this.shellBox.hidden = true;
    this.scaleBar = h("div", { class: "scale-bar" });
    this.scaleTicks = h("div", { class: "scale-ticks" });
    this.scaleTitle = h("div", { class: "scale-title" });
    this.scale = h("div", { class: "scale", role: "img", hidden: true }, this.scaleTitle, this.scaleBar, this.scaleTicks);
    this.cutSelect = select([["", "none"], ["0", "across x"], ["1", "across y"], ["2", "across z"]], "", () => this.cut());
    this.cutSlider = h("input", { type: "range", min: 0, max: 1, step: 0.005, value: 0.5, oninput: () => this.cut() });
    this.cutFlip = checkbox("other side", false, () => this.cut());
    this.objects = h("div", { class: "objects" });
    this.keys = h("p", { class: "note", id: "view-keys" },
      "Drag to orbit, right-drag to move, wheel to zoom. Keys: arrows orbit, + and − zoom, page up and down change the frame, space plays, 0 resets.");
    const runSelect = this.runs.length > 1 && labelled("Run", select(this.runs.map((run, i) => [String(i), run.label]), "0", (i) => this.showRun(this.runs[Number(i)])));
    this.element = h("div", { class: "view" },
      h("div", { class: "stage" }, this.screen, this.scale,
        h("div", { class: "transport" }, this.playButton, labelled("Frame", this.slider, { class: "field grow" }), this.caption, labelled("Speed", this.rate))),
      h("div", { class: "controls" },
        runSelect,
        labelled("Colour", this.fieldSelect),
        h("div", { class: "of-field" }, labelled("Scale", this.rangeSelect), labelled("Colours", this.mapSelect), this.logBox),
        labelled("Highlight", this.markSelect),
        labelled("Cut", this.cutSelect),
        h("div", { class: "of-cut" }, labelled("Position of the cut", this.cutSlider), this.cutFlip),
        labelled("View from", (this.lookSelect = select([["corner", "corner"], ["x", "x"], ["y", "y"], ["z", "z"]], "corner", (from) => this.stage.look(from)))),
        h("div", { class: "bar" }, button("Fit frame", () => this.fit(this.frame)), button("Fit run", () => this.fit(null))),
        checkbox("mesh lines", false, (on) => this.stage?.setLines(on)),
        this.shellBox,
        button("Save picture", () => this.save()),
        (this.copyButton = button("Copy camera", () => this.copyCamera())),
        h("fieldset", {}, h("legend", {}, "Objects"), this.objects)),
      this.keys);
    this.canvas.addEventListener("keydown", (event) => this.key(event));
    // Buttons elsewhere on the page focus an object.
    document.addEventListener("tack-object", (event) => this.showObject(event.detail));
  }

  start() {
    try {
      this.stage = new Stage(this.canvas, () => this.drawOverlay());
    } catch {
      this.screen.replaceWith(h("p", { class: "notice" }, "This browser has no WebGL, so that there is no 3D view. The rest of the page is complete."));
      return;
    }
    const background = () => this.stage.setBackground(style("--stage"));
    background();
    onThemeChange(background);
    new ResizeObserver(() => this.resize()).observe(this.screen);
    // Printing uses the last drawn picture.
    addEventListener("beforeprint", () => this.stage.render());
    this.shown = this.showRun(this.runs[0]);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.screen;
    if (width === 0) return;
    this.stage.resize(width, height);
    this.overlay.width = width * devicePixelRatio;
    this.overlay.height = height * devicePixelRatio;
    this.drawOverlay();
  }

  async showRun(run) {
    this.play(false);
    if (!this.cache.has(run)) this.cache.set(run, Frames.of(run.frames, run.scene));
    this.run = run;
    const frames = await this.cache.get(run);
    if (this.run !== run) return;
    this.frames = frames;
    this.resize();
    this.stage.show(frames, run.scene?.up ?? [0, 1, 0]);
    this.slider.max = frames.count - 1;
    this.slider.disabled = this.playButton.disabled = frames.count < 2;
    const before = this.field?.name;
    this.fieldSelect.replaceChildren(h("option", { value: "" }, "object"), ...frames.fields.map((f, i) => h("option", { value: String(i) }, f.label)));
    const same = frames.fields.findIndex((f) => f.name === before);
    this.fieldSelect.value = same < 0 ? "" : String(same);
    this.listObjects();
    await this.listMarks();
    this.shellBox.hidden = !frames.objects.some((object) => object.reach > 0);
    this.frame = Math.min(this.frame, frames.count - 1);
    this.canvas.setAttribute("aria-label", `3D view of ${run.label}: ${frames.objects.length} objects, ${frames.triangleCount} triangles, ${frames.edgeCount} edges, ${frames.points.length} points`);
    this.cut();
    await this.setField(this.fieldSelect.value);
    this.element.dataset.ready = "true";
  }

  // Lists what can be highlighted: objects, and selections of a preview.
  async listMarks() {
    const { run, frames } = this;
    this.marks = new Map(frames.objects.map((object, i) => [`object ${i}`, { text: object.name, object: i }]));
    for (const [i, one] of (run.selections ?? []).entries())
      this.marks.set(`selection ${i}`, { text: `${one.name} (${one.count})`, vertices: new Set(await wholeNumbers(one.block)) });
    const options = (kind) => [...this.marks].filter(([value]) => value.startsWith(kind)).map(([value, { text }]) => h("option", { value }, text));
    const groups = [["Selections", options("selection")], ["Objects", options("object")]].filter(([, list]) => list.length > 0);
    this.mark = null;
    this.markSelect.replaceChildren(h("option", { value: "" }, "nothing"), ...groups.map(([label, list]) => h("optgroup", { label }, list)));
  }

  highlight(value) {
    this.mark = this.marks.get(value) ?? null;
    this.markSelect.value = this.mark ? value : "";
    this.element.dataset.mark = this.mark ? this.mark.text : "";
    this.drawFrame();
  }

  // Highlights an object and moves the camera to it; a second call undoes both.
  showObject(name) {
    const i = this.frames?.objects.findIndex((object) => object.name === name) ?? -1;
    if (i < 0) return;
    const value = this.markSelect.value === `object ${i}` ? "" : `object ${i}`;
    this.highlight(value);
    if (value === "") this.fit(this.frame);
    else {
      this.stage.fitBox(this.frames.box([this.frame], this.frames.verticesOf(i)), this.frames.box([this.frame]));
      this.stage.look(this.lookSelect.value);
    }
    this.element.scrollIntoView({ block: "nearest" });
  }

  // Appends frames to the shown run. A view of the last frame moves to the new last frame.
  async append(data) {
    await this.shown;
    const { frames } = this;
    if (!frames) return; // no WebGL
    await frames.append(data);
    const last = this.frame >= frames.count - data.times.length - 1;
    const { time } = frames.list[this.frame];
    this.stage.grow(data.times.map((_, i) => frames.count - 1 - i));
    if (frames.count > mostFrames) frames.thin();
    if (this.field) this.values = await frames.values(this.field);
    this.slider.max = frames.count - 1;
    this.slider.disabled = this.playButton.disabled = frames.count < 2;
    this.frame = last ? frames.count - 1 : Math.max(0, frames.list.findLastIndex((one) => one.time <= time));
    this.colour();
  }

  listObjects() {
    const { objects } = this.frames;
    this.objects.classList.toggle("long", objects.length > listed);
    const boxes = objects.map((object, i) => checkbox("", true, (on) => {
      if (on) this.stage.hidden.delete(i);
      else this.stage.hidden.add(i);
      this.drawFrame();
    }));
    boxes.forEach((box, i) => box.append(h("span", { class: "dot", style: `background:${surfaceColours[i % surfaceColours.length]}` }), objects[i].name));
    const all = (on) => () => {
      objects.forEach((_, i) => (on ? this.stage.hidden.delete(i) : this.stage.hidden.add(i)));
      boxes.forEach((box) => (box.querySelector("input").checked = on));
      this.drawFrame();
    };
    this.objects.replaceChildren(...(objects.length > 3 ? [h("div", { class: "all" }, button("all", all(true)), button("none", all(false)))] : []), ...boxes);
  }

  async setField(value) {
    const field = value === "" ? null : this.frames.fields[Number(value)];
    this.field = field;
    this.values = field ? await this.frames.values(field) : null;
    if (this.field !== field) return;
    this.element.dataset.field = field ? field.name : "";
    this.colour();
  }

  limits() {
    const { field, values } = this;
    if (this.range === "run") return [field.lowest, field.highest];
    const all = [];
    const frames = this.range === "frame" ? [values[this.frame]] : values;
    const total = frames.length * frames[0].codes.length;
    const stride = Math.max(1, Math.floor(total / 200000));
    let k = 0;
    for (const { codes, number } of frames) for (const code of codes) if (code > 0 && (k++ % stride === 0 || this.range === "frame")) all.push(number(code));
    if (all.length === 0) return [0, 0];
    all.sort((a, b) => a - b);
    const top = this.range === "frame" ? all.length - 1 : Math.floor(0.99 * (all.length - 1));
    return [all[0], all[top]];
  }

  colour() {
    this.element.classList.toggle("with-field", this.field !== null);
    this.map = this.field ? this.scaleOf(this.field) : null;
    this.drawScale();
    this.drawFrame();
  }

  // Chooses the colour map by the values of the whole run, so that it does not change between frames.
  scaleOf(field) {
    const map = mapOf(this.wantedMap, field.lowest, field.highest, this.log);
    return new ColourScale(...centred(map, this.limits()), this.log, map);
  }

  drawScale() {
    this.scale.hidden = !this.field;
    if (!this.field) return;
    const { map, field } = this;
    const { factor, unit } = scaled(Math.max(Math.abs(map.low), Math.abs(map.high)), field.unit);
    const number = (part) => format(map.number(part) * factor, 3);
    this.scaleText = unit ? `${field.label} [${unit}]` : field.label;
    this.scaleTitle.textContent = this.scaleText;
    this.ticks = [0, 0.25, 0.5, 0.75, 1].map((part) => [part, number(part)]);
    this.scaleTicks.replaceChildren(...this.ticks.map(([, text]) => h("span", {}, text)));
    this.scaleBar.style.background = map.gradient();
    this.element.dataset.map = map.map;
    const [from, to] = map.diverging ? ["blue", "white is zero, red"] : ["dark", "light"];
    this.scale.setAttribute("aria-label", `Colours of ${this.scaleText}: ${from} is ${number(0)}, ${to} is ${number(1)}; grey has no number`);
  }

  drawFrame() {
    const { frames, map, values, field, colours } = this;
    let colourOf;
    if (!map) colourOf = (element, vertex, out, at) => out.set(colours[frames.object[element] % colours.length], at);
    else {
      const { codes, number } = values[this.frame];
      colourOf = field.ofVertices
        ? (element, vertex, out, at) => map.write(number(codes[vertex]), out, at)
        : (element, vertex, out, at) => map.write(number(codes[element]), out, at);
    }
    this.stage.setFrame(this.frame, this.withMark(colourOf));
    const { time } = frames.list[this.frame];
    this.slider.value = this.frame;
    this.caption.textContent = `t = ${format(time, 4)} s`;
    this.slider.setAttribute("aria-valuetext", `frame ${this.frame + 1} of ${frames.count}, ${format(time, 4)} seconds`);
  }

  // Returns the colours with all but the highlighted elements faded.
  withMark(colourOf) {
    const { mark, frames } = this;
    if (!mark) return colourOf;
    if (mark.vertices) return (element, vertex, out, at) => out.set(mark.vertices.has(vertex) ? marked : faded, at);
    return (element, vertex, out, at) => (frames.object[element] === mark.object ? colourOf(element, vertex, out, at) : out.set(faded, at));
  }

  go(frame) {
    this.frame = Math.min(this.frames.count - 1, Math.max(0, frame));
    if (this.range === "frame" && this.field) this.colour();
    else this.drawFrame();
  }

  play(on) {
    this.playing = on;
    this.playButton.textContent = on ? "Pause" : "Play";
    if (!on) return;
    if (this.frame === this.frames.count - 1) this.go(0);
    let last = performance.now();
    let due = 0;
    const base = Math.min(30, Math.max(4, this.frames.count / 8));
    const tick = (now) => {
      if (!this.playing) return;
      due += ((now - last) / 1000) * base * Number(this.rate.value);
      last = now;
      if (due >= 1) {
        const next = this.frame + Math.floor(due);
        due %= 1;
        this.go(next);
        if (next >= this.frames.count - 1) return this.play(false);
      }
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  cut() {
    this.cutAxis = this.cutSelect.value === "" ? null : Number(this.cutSelect.value);
    this.element.classList.toggle("with-cut", this.cutAxis !== null);
    this.stage.cut(this.cutAxis, Number(this.cutSlider.value), this.cutFlip.querySelector("input").checked);
  }

  fit(frame) {
    this.stage.fit(frame);
    this.stage.look(this.lookSelect.value);
  }

  key(event) {
    if (!this.frames || event.ctrlKey || event.metaKey || event.altKey) return;
    const step = 0.1;
    const keys = {
      ArrowLeft: () => this.stage.orbit(-step, 0), ArrowRight: () => this.stage.orbit(step, 0),
      ArrowUp: () => this.stage.orbit(0, -step), ArrowDown: () => this.stage.orbit(0, step),
      "+": () => this.stage.orbit(0, 0, 0.9), "=": () => this.stage.orbit(0, 0, 0.9), "-": () => this.stage.orbit(0, 0, 1.1),
      PageDown: () => this.go(this.frame + 1), PageUp: () => this.go(this.frame - 1), " ": () => this.play(!this.playing),
      0: () => this.stage.look("corner"),
    };
    if (!keys[event.key]) return;
    event.preventDefault();
    keys[event.key]();
  }

  // Draws the directions of the axes into a corner.
  drawOverlay(ctx = this.overlay.getContext("2d"), height = this.overlay.height, clear = true) {
    if (clear) ctx.clearRect(0, 0, this.overlay.width, this.overlay.height);
    if (!this.frames) return;
    const unit = devicePixelRatio;
    const [x0, y0] = [38 * unit, height - 38 * unit];
    ctx.save();
    ctx.lineWidth = 1.5 * unit;
    ctx.font = `${11 * unit}px system-ui, sans-serif`;
    ctx.textAlign = "center";
    ctx.textBaseline = "middle";
    ctx.strokeStyle = ctx.fillStyle = style("--quiet");
    this.stage.triad().forEach((axis, i) => {
      ctx.beginPath();
      ctx.moveTo(x0, y0);
      ctx.lineTo(x0 + 20 * unit * axis.x, y0 - 20 * unit * axis.y);
      ctx.stroke();
      if (Math.hypot(axis.x, axis.y) > 0.2) ctx.fillText("xyz"[i], x0 + 28 * unit * axis.x, y0 - 28 * unit * axis.y);
    });
    ctx.restore();
  }

  // Returns the picture with time, axes and colour scale.
  picture() {
    this.stage.render();
    const { width, height } = this.canvas;
    const unit = width / this.screen.clientWidth;
    const below = Math.round((this.field ? 64 : 30) * unit);
    const out = h("canvas", { width, height: height + below });
    const ctx = out.getContext("2d");
    ctx.fillStyle = style("--page");
    ctx.fillRect(0, 0, width, height + below);
    ctx.drawImage(this.canvas, 0, 0);
    ctx.drawImage(this.overlay, 0, 0, width, height);
    ctx.fillStyle = style("--ink");
    ctx.font = `${13 * unit}px system-ui, sans-serif`;
    ctx.textBaseline = "middle";
    const line = height + 16 * unit;
    ctx.fillText(`${this.run.label}, ${this.caption.textContent}`, 12 * unit, line);
    if (this.field) {
      const [left, wide] = [width / 2, width / 2 - 30 * unit];
      ctx.textAlign = "center";
      ctx.fillText(this.scaleText, left + wide / 2, line);
      for (let i = 0; i < 64; ++i) {
        ctx.fillStyle = this.map.css(i / 63);
        ctx.fillRect(left + (wide * i) / 64, line + 12 * unit, wide / 64 + 1, 10 * unit);
      }
      ctx.fillStyle = style("--ink");
      ctx.font = `${11 * unit}px system-ui, sans-serif`;
      for (const [part, text] of this.ticks) ctx.fillText(text, left + part * wide, line + 34 * unit);
    }
    return out;
  }

  // Copies the camera as a line for `tack render --view`.
  async copyCamera() {
    const { from, to, angle } = this.stage.view();
    const numbers = (list) => `[${list.map((x) => Number(x.toPrecision(5))).join(", ")}]`;
    const text = `camera: {from: ${numbers(from)}, to: ${numbers(to)}, angle: ${Number(angle.toPrecision(4))}}`;
    let said = "Copied";
    try {
      await navigator.clipboard.writeText(text);
    } catch {
      said = text; // the page may not write to the clipboard
    }
    this.copyButton.textContent = said;
    setTimeout(() => (this.copyButton.textContent = "Copy camera"), said === text ? 20000 : 1500);
  }

  save() {
    const name = `${this.run.label}_${String(this.frame).padStart(4, "0")}`.replace(/[^\w.-]+/g, "_");
    this.picture().toBlob((blob) => {
      const link = h("a", { href: URL.createObjectURL(blob), download: `${name}.png` });
      link.click();
      setTimeout(() => URL.revokeObjectURL(link.href), 10000);
    });
  }
}
