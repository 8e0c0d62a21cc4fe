#include "framework/report/render_view.hpp"

#include <numbers>

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
Json or_null(const std::optional<Vec3>& v) { return v ? Json{v->x(), v->y(), v->z()} : Json(nullptr); }

}  // namespace

void RenderLook::fields(Fields& f) {
  f.text("colour", colour, "of CSS: `#0072B2`, `tomato`; unless given, its own, as in reports");
  f.number("roughness", roughness, units::none, "0 shines, 1 is dull").range(0, 1);
  f.number("metalness", metalness, units::none, "1: as metals shine").range(0, 1);
  f.number("opacity", opacity, units::none, "what is not seen through").range(0, 1);
  f.number("smooth", smooth, units::angle, "triangles that meet at less than this look like one surface; 0: every one by itself").range(0, std::numbers::pi);
  f.flag("lines", lines, "edges of the mesh");
  f.flag("hide", hide, "is not drawn");
}

void RenderField::fields(Fields& f) {
  f.text("name", name, "what colours: a field of frames (`output.fields`)").required();
  f.numbers("range", limits, units::none, "from and to, in SI; unless given, the least and the largest of the runs");
  f.flag("log", log, "a logarithmic scale");
  f.choice("map", map, {{"automatic", "automatic", "`red_blue` of what has both signs, else `viridis`"}, {"viridis", "viridis", "even to the eye, also of the colour-blind"}, {"magma", "magma", "from black"}, {"cividis", "cividis", "blue to yellow"},
                        {"red_blue", "red_blue", "of what has a sign: its middle is zero"}},
           "colours");
  f.check("range", [this]() -> std::string {
    if (limits.empty()) return "";
    return limits.size() == 2 && limits[0] < limits[1] ? "" : "needs two numbers, the second above the first";
  });
}

void RenderCamera::fields(Fields& f) {
  f.optional_vector("from", from, units::length, "where it stands; unless given, as `look`, `turn`, `lift` and `zoom` say");
  f.optional_vector("to", to, units::length, "what it looks at; unless given, the middle of what `fit` says");
  f.choice("look", look, {{"corner", "corner", "from before and above"}, {"x", "x", "along x"}, {"y", "y", "along y"}, {"z", "z", "along z"}}, "from where");
  f.number("turn", turn, units::angle, "from there about the vertical");
  f.number("lift", lift, units::angle, "and upwards");
  f.number("zoom", zoom, units::none, "how much nearer than where all of it is seen").positive();
  f.number("angle", angle, units::angle, "of view, from below to above").above(0).below(3);
  f.choice("fit", fit, {{"run", "run", "all of the run"}, {"first", "first", "the first frame"}, {"last", "last", "the last frame"}, {"frame", "frame", "each frame: the camera follows"}},
           "what has to be seen, of the objects that are drawn");
}

void RenderView::fields(Fields& f) {
  f.vector("size", size, "of the picture, in pixels").at_least(16).at_most(8192);
  f.number("fps", fps, units::none, "pictures a second, of films").positive();
  f.optional_number("speed", speed, units::none, "simulated seconds a second, of films; unless given, each frame of the run is a picture").positive();
  f.optional_number("at", at, units::time, "when, of pictures; unless given, at the end");
  f.optional_number("from", from, units::time, "of films: where they begin");
  f.optional_number("to", to, units::time, "of films: where they end");
  f.optional_integer("lights", lights, "drawings with a light each, of which a picture is the mean: more are smoother, and take longer; unless given 48, of films 8").at_least(1).at_most(1000);
  f.text("background", background, "a colour of CSS");
  f.flag("time", time, "the time is written into a corner");
  f.flag("scale_bar", scale_bar, "colours of a field are explained");
  f.texts("labels", labels, "above each run; unless given, names of folders where there are several");
  f.map("objects", objects, "how objects look, by name; `chip*` are all that begin so");
  f.optional_object("field", field, "what colours surfaces; unless given, objects have colours");
  f.object("camera", camera, "from where");
}

Json json_of(const RenderView& v, int lights) {
  Json objects = Json::object();
  for (const auto& [name, look] : v.objects) {
    Json one = {{"roughness", look.roughness}, {"metalness", look.metalness}, {"opacity", look.opacity}, {"smooth", degrees(look.smooth)}, {"lines", look.lines}, {"hide", look.hide}};
    if (!look.colour.empty()) one["colour"] = look.colour;
    objects[name] = one;
  }
  Json field = nullptr;
  if (v.field)
    field = {{"name", v.field->name}, {"range", v.field->limits.empty() ? Json(nullptr) : Json(v.field->limits)}, {"log", v.field->log}, {"map", v.field->map}};
  const RenderCamera& c = v.camera;
  return {{"size", v.size}, {"fps", v.fps}, {"speed", or_null(v.speed)}, {"at", or_null(v.at)}, {"from", or_null(v.from)}, {"to", or_null(v.to)},
          {"lights", v.lights.value_or(lights)}, {"background", v.background}, {"time", v.time}, {"scale_bar", v.scale_bar}, {"labels", v.labels}, {"objects", objects}, {"field", field},
          {"camera", {{"from", or_null(c.from)}, {"to", or_null(c.to)}, {"look", c.look}, {"turn", degrees(c.turn)}, {"lift", degrees(c.lift)}, {"zoom", c.zoom}, {"angle", degrees(c.angle)}, {"fit", c.fit}}}};
}

}  // namespace tack
