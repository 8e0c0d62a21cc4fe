// Numbers and units for readers.

const superscript = (n) => String(n).replace(/./g, (c) => (c === "-" ? "⁻" : "⁰¹²³⁴⁵⁶⁷⁸⁹"[c]));

// Formats a number with at most `digits` significant digits; very large and small numbers with a power of ten.
export function format(number, digits = 4) {
  if (number === null || number === undefined) return "–";
  if (!Number.isFinite(number)) return Number.isNaN(number) ? "–" : number > 0 ? "∞" : "−∞";
  if (Number.isInteger(number) && Math.abs(number) < 1e7) return String(number).replace("-", "−");
  const size = Math.abs(number);
  if (size !== 0 && (size < 1e-3 || size >= 1e7)) {
    const [mantissa, exponent] = number.toExponential(digits - 1).split("e");
    return `${mantissa.replace(/\.?0+$/, "")} × 10${superscript(Number(exponent))}`.replace("-", "−");
  }
  const fixed = size >= 10 ** digits ? number.toFixed(0) : number.toPrecision(digits);
  return (fixed.includes(".") ? fixed.replace(/\.?0+$/, "") : fixed).replace("-", "−");
}

export const withUnit = (number, unit) => (unit && unit !== "1" ? `${format(number)} ${unit}` : format(number));

const prefixes = { "-12": "p", "-9": "n", "-6": "µ", "-3": "m", 0: "", 3: "k", 6: "M", 9: "G", 12: "T" };
const takesPrefix = new Set(["m", "s", "N", "Pa", "J", "W", "m/s", "N m", "Hz", "J/m^2", "N/m"]);

// Returns {factor, unit} for an axis with numbers up to `largest`, so that its ticks have few digits.
export function scaled(largest, unit) {
  const plain = { factor: 1, unit: unit === "1" ? "" : pretty(unit ?? "") };
  if (!(largest > 0) || !Number.isFinite(largest)) return plain;
  const exponent = 3 * Math.floor(Math.log10(largest * 1.0001) / 3);
  if (exponent === 0 || (largest >= 0.1 && largest < 1) || (exponent === 3 && (unit === "s" || !takesPrefix.has(unit)))) return plain;
  const factor = 10 ** -exponent;
  if (takesPrefix.has(unit) && prefixes[exponent] !== undefined && !(unit === "s" && exponent > 0))
    return { factor, unit: pretty(prefixes[exponent] + unit) };
  return { factor, unit: `10${superscript(exponent)}${plain.unit ? ` ${plain.unit}` : ""}` };
}

// Returns "5 kPa"; the plain number without a unit.
export function scaledNumber(number, unit) {
  if (!unit || unit === "1") return format(number);
  const { factor, unit: text } = scaled(Math.abs(number), unit);
  return `${format(Number((number * factor).toPrecision(12)))} ${text}`;
}

// Returns an object without prototype: its keys are user-defined names, such as `__proto__`.
export const byName = (...tables) => Object.assign(Object.create(null), ...tables);

export const pretty = (unit) => unit.replace(/\^(-?\d)/g, (_, n) => superscript(n));
export const axisTitle = (name, unit) => (unit ? `${name} [${unit}]` : name);
export const words = (name) => name.replaceAll("_", " ");

export function powerOfTen(number) {
  const exponent = Math.round(Math.log10(number));
  return Math.abs(number / 10 ** exponent - 1) < 1e-6 ? `10${superscript(exponent)}` : "";
}

export function duration(seconds) {
  if (!Number.isFinite(seconds)) return "–";
  if (seconds < 120) return `${format(seconds, 3)} s`;
  if (seconds < 7200) return `${format(seconds / 60, 3)} min`;
  return `${format(seconds / 3600, 3)} h`;
}

const quantities = { m: "length", "m/s": "velocity", N: "force", "N m": "moment", J: "energy", Pa: "pressure", W: "power", rad: "angle", 1: "value" };
export const quantityOf = (unit) => quantities[unit] ?? "value";
