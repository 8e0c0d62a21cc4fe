// The page of `tack render`: draws frames of runs for a view, one at a time, called by render.mjs.
import { Color, SRGBColorSpace } from "three";
import { ColourScale, centred, mapOf } from "./colour_scale.js";
import { format, scaled } from "./format.js";
import { Frames } from "./frames.js";
import { looksOf, matches } from "./looks.js";
import { Studio } from "./studio.js";
import { surfaceColours } from "./theme.js";

const font = (pixels, bold) => `${bold ? "600 " : ""}${pixels}px "DejaVu Sans", "Liberation Sans", Arial, sans-serif`;
const dark = (css) => {
  if (css === "transparent") return false;
  const c = new Color().setStyle(css, SRGBColorSpace);
  return 0.3 * c.r + 0.6 * c.g + 0.1 * c.b < 0.3;
};

class Film {
  async open(view) {
    const data = JSON.parse(document.getElementById("data").textContent);
    this.view = view;
    this.labels = view.labels.length > 0 ? view.labels : data.runs.length > 1 ? data.runs.map((run) => run.label) : [];
    this.runs = [];
    for (const run of data.runs) {
      if (!run.frames) throw new Error(`${run.label} has no frames; let its scene write some (output.frames)`);
      const frames = await Frames.of(run.frames, run.scene);
      this.runs.push({ frames, up: run.scene?.up ?? [0, 1, 0], label: run.label });
    }
    for (const name of Object.keys(view.objects))
      if (!this.runs.some((run) => run.frames.objects.some((object) => matches(name, object.name))))
        throw new Error(`objects: no run has an object '${name}'; there are ${this.runs[0].frames.objects.map((o) => o.name).slice(0, 12).join(", ")}`);
    const looks = looksOf(view.objects);
    if (this.runs.some((run) => run.frames.objects.every((object) => looks(object.name).hide))) throw new Error("all objects are hidden");
    this.studio = new Studio(...view.size, view);
    for (const run of this.runs) run.set = this.studio.set(run.frames, run.up, looks, surfaceColours, view.ground);
    if (view.field) await this.openField(view.field);
    this.out = document.createElement("canvas");
    [this.out.width, this.out.height] = view.size;
    const last = Math.max(...this.runs.map((run) => run.frames.times.at(-1)));
    return { times: this.runs[0].frames.times, last, written: this.runs.map((run) => run.frames.written), kept: this.runs.map((run) => run.frames.count) };
  }

  async openField({ name, range, log, map }) {
    let [low, high] = [Infinity, -Infinity];
    for (const run of this.runs) {
      const field = run.frames.fields.find((one) => one.name === name || one.label === name);
      if (!field) throw new Error(`field: '${run.label}' has no '${name}'; its frames have ${run.frames.fields.map((f) => f.name).join(", ") || "none"} (output.fields)`);
      run.field = field;
      run.values = await run.frames.values(field);
      low = Math.min(low, field.lowest);
      high = Math.max(high, field.highest);
    }
    const chosen = mapOf(map, ...(range ?? [low, high]), log);
    this.scale = new ColourScale(...(range ?? centred(chosen, [low, high])), log, chosen);
  }

  // Draws the nearest frames of all runs to a time [s]. Returns a PNG in base64.
  draw(time) {
    const { view, studio, runs } = this;
    const [width, height] = view.size;
    const wide = Math.floor(width / runs.length);
    const views = runs.map((run, i) => {
      const { times } = run.frames;
      const number = times.reduce((best, t, k) => (Math.abs(t - time) < Math.abs(times[best] - time) ? k : best), 0);
      let colourOf = null;
      if (run.field) {
        const { codes, number: of } = run.values[number];
        colourOf = (element, vertex) => {
          const value = of(codes[run.field.ofVertices ? vertex : element]);
          if (Number.isNaN(value)) return null;
          const rgb = [0, 0, 0];
          this.scale.write(value, rgb, 0);
          return rgb;
        };
      }
      run.set.setFrame(number, colourOf);
      const box = view.camera.fit === "run" ? (run.box ??= run.set.box()) : run.set.box([view.camera.fit === "frame" ? number : view.camera.fit === "first" ? 0 : run.frames.count - 1]);
      run.set.focus(box.low, box.high);
      const space = [i * wide, 0, wide, height];
      return { number, set: run.set, camera: run.set.camera(view.camera, box, wide / height), box: space };
    });
    studio.draw(views);
    this.compose(runs[0].frames.times[views[0].number], wide);
    return this.out.toDataURL("image/png").slice("data:image/png;base64,".length);
  }

  // Writes the time of the frame of the first run, labels and the colour scale.
  compose(time, wide) {
    const { view, out } = this;
    const ctx = out.getContext("2d");
    const unit = out.height / 720;
    ctx.clearRect(0, 0, out.width, out.height);
    ctx.drawImage(this.studio.canvas, 0, 0);
    ctx.fillStyle = ctx.strokeStyle = dark(view.background) ? "#f2f2f2" : "#1a1a1a";
    ctx.textBaseline = "top";
    ctx.font = font(22 * unit, true);
    this.labels.forEach((label, i) => ctx.fillText(label, i * wide + 24 * unit, 22 * unit));
    if (view.time) {
      ctx.font = font(20 * unit);
      ctx.textAlign = "right";
      ctx.fillText(`t = ${format(time, 4)} s`, out.width - 24 * unit, 22 * unit);
      ctx.textAlign = "left";
    }
    if (view.field && view.scale_bar) this.bar(ctx, unit);
  }

  bar(ctx, unit) {
    const { width, height } = this.out;
    const { low, high } = this.scale;
    const field = this.runs[0].field;
    const { factor, unit: text } = scaled(Math.max(Math.abs(low), Math.abs(high)), field.unit);
    const [long, thick] = [260 * unit, 14 * unit];
    const [x, y] = [width - long - 32 * unit, height - 52 * unit];
    for (let i = 0; i < long; ++i) {
      const ink = ctx.fillStyle;
      ctx.fillStyle = this.scale.css(i / long);
      ctx.fillRect(x + i, y, 1.5, thick);
      ctx.fillStyle = ink;
    }
    ctx.font = font(16 * unit);
    ctx.textAlign = "center";
    ctx.fillText(text ? `${field.label} [${text}]` : field.label, x + long / 2, y - 24 * unit);
    ctx.font = font(14 * unit);
    for (const part of [0, 0.5, 1]) ctx.fillText(format(this.scale.number(part) * factor, 3), x + part * long, y + thick + 5 * unit);
    ctx.textAlign = "left";
  }
}

window.film = new Film();
document.documentElement.dataset.ready = "true";
