// Looks of objects by name: each key is that of the most specific pattern that fits.

// Returns true if a pattern fits a name; "chip*" stands for all that begin so.
export const matches = (pattern, name) => (pattern.endsWith("*") ? name.startsWith(pattern.slice(0, -1)) : pattern === name);

// Returns the patterns so that each replaces keys of those before it: those that end in "*" by their length, then whole names. The view has them in this order
// (framework/report/render_view.cpp), but an object of JavaScript begins with keys that are whole numbers, such as the name "1".
export function fromGeneralToSpecific(patterns) {
  const rank = (pattern) => (pattern.endsWith("*") ? pattern.length : Infinity);
  return [...patterns].sort((a, b) => (rank(a) === rank(b) ? 0 : rank(a) - rank(b)));
}

// Returns the function that gives an object's name its look. looks: {pattern: look}.
export function looksOf(looks) {
  const patterns = fromGeneralToSpecific(Object.keys(looks));
  return (name) => Object.assign({}, ...patterns.filter((pattern) => matches(pattern, name)).map((pattern) => looks[pattern]));
}
