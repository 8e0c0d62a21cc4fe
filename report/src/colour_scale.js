// Colour scales. Viridis is perceptually uniform, also in greyscale and for the colour-blind; fields with both signs are blue below zero, red above
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

const signMin = 0.01; // of the larger side: smaller values of the other sign count as round-off

// Returns the colour map; "automatic" is chosen by the signs of `low` and `high`.
export function mapOf(wanted, low, high, log = false) {
  if (wanted !== "automatic") return wanted;
  return !log && -low > signMin * high && high > signMin * -low ? "red_blue" : "viridis";
}

// Returns limits symmetric about zero for the diverging map.
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

  // Returns the position of a number on the scale, 0 to 1, or NaN.
  fraction(number) {
    if (Number.isNaN(number)) return NaN;
    if (!(this.high > this.low)) return 0;
    const fraction = this.log
      ? Math.log(Math.max(number, this.low) / this.low) / Math.log(this.high / this.low)
      : (number - this.low) / (this.high - this.low);
    return Math.min(1, Math.max(0, fraction));
  }

  number(fraction) {
    return this.log ? this.low * (this.high / this.low) ** fraction : this.low + fraction * (this.high - this.low);
  }

  // Returns the position of a number in the colour map, 0 to 1; zero is in the middle of a diverging map.
  tone(number) {
    if (!this.diverging || Number.isNaN(number)) return this.fraction(number);
    const most = Math.max(Math.abs(this.low), Math.abs(this.high));
    return most > 0 ? Math.min(1, Math.max(0, 0.5 + (0.5 * number) / most)) : 0.5;
  }

  // Writes the linear colour of a number into `out`, from index `at`.
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

  // Returns the CSS colour at a fraction of the scale, and the gradient of the whole scale.
  css(fraction) { return interpolators[this.map](this.tone(this.number(fraction))); }
  gradient() { return `linear-gradient(to right, ${Array.from({ length: 33 }, (_, i) => this.css(i / 32)).join(", ")})`; }
}
