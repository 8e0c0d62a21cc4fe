// Creates elements. Texts are always text nodes, so that no text of a scene is parsed as HTML.

export function h(tag, attributes = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else element.setAttribute(name, value === true ? "" : value);
  }
  element.append(...children.flat(Infinity).filter((child) => child !== null && child !== undefined && child !== false));
  return element;
}

let count = 0;
export const freshId = (stem) => `${stem}-${++count}`;

// Returns a control with a label.
export function labelled(text, control, attributes = {}) {
  control.id ||= freshId("control");
  return h("span", { class: "field", ...attributes }, h("label", { for: control.id }, text), control);
}

export function select(options, chosen, change) {
  const control = h("select", { onchange: () => change(control.value) },
    options.map(([value, text]) => h("option", { value, selected: value === chosen }, text)));
  return control;
}

export function checkbox(text, checked, change) {
  const control = h("input", { type: "checkbox", checked, onchange: () => change(control.checked) });
  return h("label", { class: "check" }, control, text);
}

export const button = (text, press, attributes = {}) => h("button", { type: "button", onclick: press, ...attributes }, text);

export function section(id, title, ...children) {
  return h("section", { id, "aria-labelledby": `${id}-title` }, h("h2", { id: `${id}-title` }, title), ...children);
}

// Returns a plain table. Cells may be elements.
export function plainTable(head, rows, caption, attributes = {}) {
  const cell = (content, c) => h(c === 0 ? "th" : "td", c === 0 ? { scope: "row" } : { class: typeof content === "number" ? "number" : null },
    typeof content === "number" ? String(content) : content);
  return h("div", { class: "scroll", tabindex: 0, role: "region", "aria-label": caption },
    h("table", attributes, h("caption", { class: "hidden" }, caption),
      head && h("thead", {}, h("tr", {}, head.map((text) => h("th", { scope: "col" }, text)))),
      h("tbody", {}, rows.map((row) => h("tr", {}, row.map(cell))))));
}

// Returns an element <details> whose content is made when it is opened for the first time.
export function lazyDetails(summary, make) {
  const details = h("details", {
    ontoggle: () => { if (details.open && details.childElementCount === 1) details.append(make()); },
  }, h("summary", {}, summary));
  return details;
}
