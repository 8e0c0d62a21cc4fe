// Colours: those of the page by its style sheet, those of data by Okabe and Ito's palette, which the colour-blind can tell
// apart; dashes tell lines apart once more.

const onLight = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#8A6D00", "#56B4E9", "#000000", "#E69F00"];
const onDark = ["#56B4E9", "#E69F00", "#2BC79A", "#E39BC4", "#F0E442", "#7FA8FF", "#F2F2F2", "#FF8A50"];
const dashes = [[], [7, 4], [2, 3], [9, 3, 2, 3], [12, 4], [4, 2, 1, 2, 1, 2], [1, 2], [14, 3, 4, 3]];

const dark = matchMedia("(prefers-color-scheme: dark)");
export const isDark = () => dark.matches && document.documentElement.dataset.theme !== "light";

// Beyond the palette, the same ones paler.
export function colour(i) {
  const palette = isDark() ? onDark : onLight;
  const one = palette[i % palette.length];
  if (i < palette.length) return one;
  const towards = isDark() ? 0 : 255;
  const part = (at) => Math.round(0.55 * parseInt(one.slice(at, at + 2), 16) + 0.45 * towards).toString(16).padStart(2, "0");
  return `#${part(1)}${part(3)}${part(5)}`;
}
// The same in both modes: surfaces are lit.
export const surfaceColours = ["#0072B2", "#E69F00", "#009E73", "#CC79A7", "#56B4E9", "#D55E00", "#F0E442", "#999999"];
export const dash = (i) => dashes[i % dashes.length];
export const style = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();

// What a part of the page has begun ends with it, where it is replaced by a newer one: [what make() makes, a function that ends it].
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
// Paper is light.
addEventListener("beforeprint", () => {
  document.documentElement.dataset.theme = "light";
  redrawAll();
});
addEventListener("afterprint", () => {
  delete document.documentElement.dataset.theme;
  redrawAll();
});
