// From numbers to colours: viridis, which is even to the eye, in black and white, and to the colour-blind.
import { interpolateViridis } from "d3-scale-chromatic";
import { Color, SRGBColorSpace } from "three";

const steps = 256;
const table = new Float32Array(3 * steps); // linear, as the renderer wants it
for (let i = 0; i < steps; ++i) new Color().setStyle(interpolateViridis(i / (steps - 1)), SRGBColorSpace).toArray(table, 3 * i);
const none = new Color().setStyle("#9a9a9a", SRGBColorSpace).toArray();

export class ColourScale {
  constructor(low, high, log) {
    this.log = log && high > 0;
    this.high = high;
    this.low = this.log ? Math.max(low, high * 1e-6) : low;
  }

  // 0 to 1, and NaN.
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

  // Writes three numbers at `at`.
  write(number, out, at) {
    const part = this.part(number);
    if (Number.isNaN(part)) {
      out.set(none, at);
      return;
    }
    const i = 3 * Math.round(part * (steps - 1));
    out[at] = table[i];
    out[at + 1] = table[i + 1];
    out[at + 2] = table[i + 2];
  }
}

export const cssGradient = `linear-gradient(to right, ${Array.from({ length: 17 }, (_, i) => interpolateViridis(i / 16)).join(", ")})`;
export const cssColour = interpolateViridis;
