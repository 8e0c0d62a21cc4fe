// A scene before it is run: what is doubtful of it, its bodies, where they start and how they are moved.
import { objectButton, withObjects } from "./about.js";
import { h, lazyDetails, plainTable, section } from "./dom.js";
import { format, scaledNumber } from "./format.js";
import { viewSection } from "./view.js";

export function previewSections({ error, warnings, notes, bodies, duration }, run) {
  return [doubts(error, warnings, notes, run.scene), viewSection([run], { title: "How it starts" }), bodyTable(bodies), expected(run.scene, duration),
    section("scene", "The scene", lazyDetails("As it is written", () => h("pre", { tabindex: 0 }, run.scene.text)))];
}

function doubts(error, warnings, notes, scene) {
  const list = (lines) => h("ul", {}, lines.map((line) => h("li", {}, withObjects(line, scene))));
  return section("warnings", "What is doubtful",
    error && h("div", { class: "notice bad", role: "note" }, h("p", {}, "It cannot be run: ", withObjects(error, scene))),
    warnings.length > 0 ? h("div", { class: "notice warnings" }, list(warnings)) : !error && h("p", { class: "note" }, "Nothing. `tack check` looks at derivatives as well."),
    notes.length > 0 && h("div", { class: "told-of-it" }, list(notes)));
}

function bodyTable(bodies) {
  const rows = bodies.map((body) => [objectButton(body.name), format(body.vertices), elementsOf(body), body.held, body.extent.map((x) => format(x, 3)).join(" × "),
    body.contact === null ? "–" : scaledNumber(body.contact, "m"), body.adhesion === null ? "–" : scaledNumber(body.adhesion, "m")]);
  return section("bodies", "Its bodies", plainTable(["object", "vertices", "elements", "held", "extent [m]", "contact begins at", "adhesion reaches"], rows, "Bodies"),
    bodies.some((body) => body.contact !== null) && h("p", { class: "note" },
      "Contact begins where two surfaces are this near each other; the box 'contact distance' beside the picture shows half of it around each."));
}

function elementsOf({ tets, triangles, edges, points }) {
  return [[tets, "tets"], [triangles, "triangles"], [edges, "edges"], [points, "points"]].filter(([count]) => count > 0).map(([count, name]) => `${format(count)} ${name}`).join(", ") || "–";
}

function expected(scene, duration) {
  const names = (scene.expect ?? []).map(({ name }) => h("li", {}, name));
  return section("expectations", "What its run is to show", h("p", { class: "note" }, `It lasts ${format(duration, 4)} s.`),
    names.length > 0 ? h("ul", {}, names) : h("p", { class: "note" }, "The scene says nothing of it."));
}
