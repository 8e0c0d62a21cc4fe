// A scene before it is run: warnings, the initial state, bodies and expectations.
import { objectButton, withObjects } from "./about.js";
import { h, lazyDetails, plainTable, section } from "./dom.js";
import { format, scaledNumber } from "./format.js";
import { viewSection } from "./view.js";

export function previewSections({ error, warnings, notes, bodies, duration }, run) {
  return [warningSection(error, warnings, notes, run.scene), viewSection([run], { title: "Initial state" }), bodyTable(bodies), expected(run.scene, duration),
    section("scene", "Scene", lazyDetails("Scene file", () => h("pre", { tabindex: 0 }, run.scene.text)))];
}

function warningSection(error, warnings, notes, scene) {
  const list = (lines) => h("ul", {}, lines.map((line) => h("li", {}, withObjects(line, scene))));
  return section("warnings", "Warnings",
    error && h("div", { class: "notice bad", role: "note" }, h("p", {}, "The scene cannot be run: ", withObjects(error, scene))),
    warnings.length > 0 ? h("div", { class: "notice warnings" }, list(warnings)) : !error && h("p", { class: "note" }, "None. `tack check` also checks derivatives."),
    notes.length > 0 && h("div", { class: "remarks" }, list(notes)));
}

function bodyTable(bodies) {
  const rows = bodies.map((body) => [objectButton(body.name), format(body.vertices), elementsOf(body), body.held, body.extent.map((x) => format(x, 3)).join(" × "),
    body.contact === null ? "–" : scaledNumber(body.contact, "m"), body.adhesion === null ? "–" : scaledNumber(body.adhesion, "m")]);
  return section("bodies", "Bodies", plainTable(["object", "vertices", "elements", "fixed", "extent [m]", "contact range", "adhesion range"], rows, "Bodies"),
    bodies.some((body) => body.contact !== null) && h("p", { class: "note" },
      "Contact begins at gaps below the contact range. The checkbox 'contact distance' beside the picture shows half of the range around each surface."));
}

function elementsOf({ tets, triangles, edges, points }) {
  return [[tets, "tets"], [triangles, "triangles"], [edges, "edges"], [points, "points"]].filter(([count]) => count > 0).map(([count, name]) => `${format(count)} ${name}`).join(", ") || "–";
}

function expected(scene, duration) {
  const names = (scene.expect ?? []).map(({ name }) => h("li", {}, name));
  return section("expectations", "Expectations", h("p", { class: "note" }, `Duration of the run: ${format(duration, 4)} s.`),
    names.length > 0 ? h("ul", {}, names) : h("p", { class: "note" }, "The scene has no expectations."));
}
