// Colours of the page (from its style sheet) and of data (Okabe and Ito's palette for colour-blind readers). Lines also differ
// by dashes.

const onLight = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#8A6D00", "#56B4E9", "#000000", "#E69F00"];
const onDark = ["#56B4E9", "#E69F00", "#2BC79A", "#E39BC4", "#F0E442", "#7FA8FF", "#F2F2F2", "#FF8A50"];
const dashes = [[], [7, 4], [2, 3], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2, 1, 2], [1, 2], [14, 3, 4, 3]];

const dark = matchMedia("(prefers-color-scheme: dark)");
export const isDark = () => dark.matches && document.documentElement.dataset.theme !== "light";

// Beyond the palette, colours repeat in paler tones.
export function colour(i) {
  const palette = isDark() ? onDark : onLight;
  const one = palette[i % palette.length];
  if (i < palette.length) return one;
  const towards = isDark() ? 0 : 255;
  const part = (at) => Math.round(0.55 * parseInt(one.slice(at, at + 2), 16) + 0.45 * towards).toString(16).padStart(2, "0");
  return `#${part(1)}${part(3)}${part(5)}`;
}
// Colours of lit surfaces, equal in light and dark mode.
export const surfaceColours = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442", "#999999"];
export const dash = (i) => dashes[i % dashes.length];
export const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// Makes a section that may be replaced. Returns [the result of make(), a function that ends all that the section started].
let ends = null;
export function scoped(make) {
  const outer = ends;
  const own = (ends = []);
  try {
    return [make(), () => own.forEach((end) => end())];
  } finally {
    ends = outer;
  }
}
export const onEnd = (end) => ends?.push(end);

const redraws = new Set();
export function onThemeChange(redraw) {
  redraws.add(redraw);
  onEnd(() => redraws.delete(redraw));
}
const redrawAll = () => redraws.forEach((redraw) => redraw());
dark.addEventListener("change", redrawAll);
// Printing uses the light mode.
addEventListener("beforeprint", () => {
  document.documentElement.dataset.theme = "light";
  redrawAll();
});
addEventListener("afterprint", () => {
  delete document.documentElement.dataset.theme;
  redrawAll();
});
