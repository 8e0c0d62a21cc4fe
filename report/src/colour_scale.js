// From numbers to colours. Viridis is even to the eye, in black and white, and to the colour-blind; what has both signs is blue below zero, red above
// it, and white at zero.
import { interpolateCividis, interpolateMagma, interpolateRdBu, interpolateViridis } from "d3-scale-chromatic";
import { Color, SRGBColorSpace } from "three";

const interpolators = { viridis: interpolateViridis, magma: interpolateMagma, cividis: interpolateCividis, red_blue: (t) => interpolateRdBu(1 - t) };
const steps = 512;
const tables = new Map(); // linear colours, as the renderer wants them
const none = new Color().setStyle("#9a9a9a", SRGBColorSpace).toArray();

function tableOf(map) {
  if (!tables.has(map)) {
    const table = new Float32Array(3 * steps);
    for (let i = 0; i < steps; ++i) new Color().setStyle(interpolators[map](i / (steps - 1)), SRGBColorSpace).toArray(table, 3 * i);
    tables.set(map, table);
  }
  return tables.get(map);
}

const least = 0.01; // of the larger side: less of the other sign is round-off

// Which colours suit numbers from `low` to `high`, if that is left to us.
export function mapOf(wanted, low, high, log = false) {
  if (wanted !== "automatic") return wanted;
  return !log && -low > least * high && high > least * -low ? "red_blue" : "viridis";
}

// As far below zero as above it.
export function centred(map, [low, high]) {
  if (map !== "red_blue") return [low, high];
  const most = Math.max(Math.abs(low), Math.abs(high));
  return [-most, most];
}

export class ColourScale {
  constructor(low, high, log, map = "viridis") {
    this.map = map;
    this.diverging = map === "red_blue";
    this.log = log && high > 0 && !this.diverging;
    this.high = high;
    this.low = this.log ? Math.max(low, high * 1e-6) : low;
    this.table = tableOf(map);
  }

  // Of the scale, 0 to 1, and NaN.
  part(number) {
    if (Number.isNaN(number)) return NaN;
    if (!(this.high > this.low)) return 0;
    const part = this.log
      ? Math.log(Math.max(number, this.low) / this.low) / Math.log(this.high / this.low)
      : (number - this.low) / (this.high - this.low);
    return Math.min(1, Math.max(0, part));
  }

  number(part) {
    return this.log ? this.low * (this.high / this.low) ** part : this.low + part * (this.high - this.low);
  }

  // Of the colours, 0 to 1: zero has the middle one where they are of both signs.
  tone(number) {
    if (!this.diverging || Number.isNaN(number)) return this.part(number);
    const most = Math.max(Math.abs(this.low), Math.abs(this.high));
    return most > 0 ? Math.min(1, Math.max(0, 0.5 + (0.5 * number) / most)) : 0.5;
  }

  // Writes three numbers at `at`.
  write(number, out, at) {
    const tone = this.tone(number);
    if (Number.isNaN(tone)) {
      out.set(none, at);
      return;
    }
    const i = 3 * Math.round(tone * (steps - 1));
    out[at] = this.table[i];
    out[at + 1] = this.table[i + 1];
    out[at + 2] = this.table[i + 2];
  }

  // The colour at a part of the scale, and all of it.
  css(part) { return interpolators[this.map](this.tone(this.number(part))); }
  gradient() { return `linear-gradient(to right, ${Array.from({ length: 33 }, (_, i) => this.css(i / 32)).join(", ")})`; }
}
