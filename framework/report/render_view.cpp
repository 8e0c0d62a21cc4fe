#include "framework/report/render_view.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

#include "geometry/errors.hpp"

namespace tack {
namespace {

using Json = nlohmann::ordered_json;

// Light of both renderers, for which a white surface that faces the sun is just white (docs/log/pictures.md).
constexpr double sun_irradiance = 1.7;
constexpr double zenith_radiance = 0.6, horizon_radiance = 0.25;  // of the sky; the former straight above
constexpr double sun_disc = 12;                                      // degrees, for soft shadows

constexpr double round_off = 1e-9;        // of times, relative
constexpr double picture_count_max = 1e5;  // of a film

double degrees(double radians) { return radians * 180 / std::numbers::pi; }

template <class T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}
Json or_null(const std::optional<Vec3>& v) { return v ? Json{v->x(), v->y(), v->z()} : Json(nullptr); }

void optional_flag(Fields& f, const char* key, RenderLook::Flag& flag, const char* doc) {
  Field& field = f.flag(key, flag.value, doc);
  field.read = [read = field.read, &flag](const Value& v, const Field& own, Reader& reader) {
    read(v, own, reader);
    flag.given = true;
  };
  field.write = [write = field.write, &flag] { return flag.given ? write() : Value(); };
}

}  // namespace

void RenderLook::fields(Fields& f) {
  f.text("colour", colour, "CSS colour: `#0072B2`, `tomato`; its own colour, as in reports, unless given");
  f.optional_number("roughness", roughness, units::none, "0: glossy, 1: matt; 0.7 unless given").range(0, 1);
  f.optional_number("metalness", metalness, units::none, "1: metallic reflection; 0 unless given").range(0, 1);
  f.optional_number("opacity", opacity, units::none, "0: transparent, 1: opaque; 1 unless given").range(0, 1);
  f.optional_number("smooth", smooth, units::angle, "angle between triangles below which they are shaded as one smooth surface; 0: flat shading; 40 degrees unless given").range(0, std::numbers::pi);
  optional_flag(f, "lines", lines, "draw the edges of the mesh");
  optional_flag(f, "hide", hide, "do not draw it");
  f.optional_number("transmission", transmission, units::none, "fraction of light that passes as through glass (Blender)").range(0, 1);
  f.optional_number("translucency", translucency, units::none, "fraction of light that is scattered below the surface, as in wax and gels (Blender)").range(0, 1);
  f.optional_integer("subdivide", subdivide, "levels of Catmull-Clark subdivision, which rounds coarse meshes (Blender)").at_least(0).at_most(4);
  f.optional_number("offset", offset, units::length, "distance by which closed surfaces are drawn outside of where they are, which hides gaps between touching bodies; sheets are drawn twice as thick as it (Blender)").nonnegative();
}

void RenderGround::fields(Fields& f) {
  f.optional_number("at", at, units::length, "height of the ground; below everything that is shown unless given");
  f.text("colour", colour, "CSS colour; only the shadows on it are drawn unless given");
}

void RenderSection::fields(Fields& f) {
  f.vector("through", through, units::length, "a point of the plane, in the scene").required();
  f.vector("normal", normal, units::none, "its normal, towards what is not drawn").required();
  f.check("normal", [this]() -> std::string { return normal.norm() > 0 ? "" : "must not be zero"; });
}

void RenderLight::fields(Fields& f) {
  f.number("sun", sun, units::none, "factor of the light that comes from behind the camera, and casts the shadow that one sees").at_least(0);
  f.number("sky", sky, units::none, "factor of the light from all around, brightest from above; also what glossy and metallic surfaces mirror").at_least(0);
}

void RenderField::fields(Fields& f) {
  f.text("name", name, "field of frames that colours the surfaces (`output.fields`)").required();
  f.numbers("range", limits, units::none, "smallest and largest value of the colour scale, in SI; those of the runs unless given");
  f.flag("log", log, "logarithmic colour scale");
  f.choice("map", map, {{"automatic", "automatic", "`red_blue` if values have both signs, else `viridis`"}, {"viridis", "viridis", "perceptually uniform, also for the colour-blind"}, {"magma", "magma", "perceptually uniform, from black"}, {"cividis", "cividis", "blue to yellow"},
                        {"red_blue", "red_blue", "diverging, zero in the middle"}},
           "colour map");
  f.check("range", [this]() -> std::string {
    if (limits.empty()) return "";
    return limits.size() == 2 && limits[0] < limits[1] ? "" : "needs two numbers, the second above the first";
  });
}

void RenderCamera::fields(Fields& f) {
  f.optional_vector("from", from, units::length, "position of the camera in the scene; set by `look`, `turn`, `lift` and `zoom` unless given");
  f.optional_vector("to", to, units::length, "target of the camera; the centre of the objects chosen by `fit` unless given");
  f.choice("look", look, {{"corner", "corner", "from the front, above a corner"}, {"x", "x", "along x"}, {"y", "y", "along y"}, {"z", "z", "along z"}}, "direction of view");
  f.number("turn", turn, units::angle, "rotation from that direction about the vertical");
  f.number("lift", lift, units::angle, "elevation above that direction");
  f.number("zoom", zoom, units::none, "magnification relative to the view of all objects that are not hidden").positive();
  f.number("angle", angle, units::angle, "vertical angle of view").above(0).below(3);
  f.choice("fit", fit, {{"run", "run", "all of the run"}, {"first", "first", "the first frame"}, {"last", "last", "the last frame"}, {"frame", "frame", "each frame: the camera follows"}},
           "frames whose objects must be in view");
}

void RenderView::fields(Fields& f) {
  f.vector("size", size, "size of the picture in pixels").at_least(16).at_most(8192);
  f.number("fps", fps, units::none, "frames per second of films").positive();
  f.optional_number("speed", speed, units::none, "simulated time per second of films; unless given, each frame of the run is one picture").positive();
  f.optional_number("at", at, units::time, "time of a picture; the end unless given");
  f.optional_number("from", from, units::time, "start time of films");
  f.optional_number("to", to, units::time, "end time of films");
  f.optional_integer("lights", lights, "lights whose drawings are averaged into a picture: more give smoother shadows and take longer; 48 unless "
                                       "given, 8 for films").at_least(1).at_most(1000);
  f.optional_integer("samples", samples, "light paths per pixel (Blender): more give less noise and take longer; 128 unless given, 32 for films").at_least(1).at_most(100000);
  f.text("background", background, "CSS colour of the background, or `transparent` (pictures)");
  f.number("exposure", exposure, units::none, "factor of the light").positive();
  f.choice("tone", tone, {{"none", "none", "colours as they are, bright ones cut off"}, {"filmic", "filmic", "bright colours are compressed, as film does"}}, "tone mapping");
  f.object("light", light, "factors of sun and sky: `light: {sun: 0}` for shadows without a direction, `light: {sky: 0.5}` for darker ones");
  f.optional_object("ground", ground, "a plane below the objects that receives their shadows; `ground: {}` for the shadows alone");
  f.optional_object("section", section, "a plane that objects are cut by; what lies beyond it is not drawn (Blender)");
  f.flag("time", time, "write the time into a corner");
  f.flag("scale_bar", scale_bar, "draw the colour scale of the field");
  f.texts("labels", labels, "titles above the runs; names of the folders unless given, if there are several");
  f.map("objects", objects, "appearance of objects, by name; `chip*` matches all names with that beginning");
  f.optional_object("field", field, "field that colours the surfaces; object colours unless given");
  f.object("camera", camera, "position and direction of the camera");
}

namespace {

// Returns the names of the looks so that each replaces keys of those before it: patterns by their length, then whole names.
std::vector<std::string> from_general_to_specific(const std::map<std::string, RenderLook>& looks) {
  std::vector<std::string> names;
  for (const auto& [name, look] : looks) names.push_back(name);
  const auto rank = [](const std::string& name) { return std::pair(!name.ends_with('*'), name.ends_with('*') ? name.size() : 0); };
  std::stable_sort(names.begin(), names.end(), [&](const std::string& a, const std::string& b) { return rank(a) < rank(b); });
  return names;
}

}  // namespace

Json json_of(const RenderView& v, const RenderQuality& quality) {
  Json objects = Json::object();
  for (const std::string& name : from_general_to_specific(v.objects)) {
    const RenderLook& look = v.objects.at(name);
    // Keys that are not given do not replace those of another pattern.
    Json one = Json::object();
    const auto give = [&one](const char* key, const auto& value) { if (value) one[key] = *value; };
    if (!look.colour.empty()) one["colour"] = look.colour;
    give("roughness", look.roughness);
    give("metalness", look.metalness);
    give("opacity", look.opacity);
    if (look.smooth) one["smooth"] = degrees(*look.smooth);
    give("transmission", look.transmission);
    give("translucency", look.translucency);
    give("subdivide", look.subdivide);
    give("offset", look.offset);
    if (look.lines.given) one["lines"] = look.lines.value;
    if (look.hide.given) one["hide"] = look.hide.value;
    objects[name] = one;
  }
  Json field = nullptr;
  if (v.field)
    field = {{"name", v.field->name}, {"range", v.field->limits.empty() ? Json(nullptr) : Json(v.field->limits)}, {"log", v.field->log}, {"map", v.field->map}};
  Json ground = nullptr;
  if (v.ground) ground = {{"at", or_null(v.ground->at)}, {"colour", v.ground->colour.empty() ? Json(nullptr) : Json(v.ground->colour)}};
  Json section = nullptr;
  if (v.section) section = {{"through", or_null(std::optional(v.section->through))}, {"normal", or_null(std::optional<Vec3>(v.section->normal.normalized()))}};
  const Json light = {{"sun", v.light.sun * sun_irradiance}, {"zenith", v.light.sky * zenith_radiance}, {"horizon", v.light.sky * horizon_radiance}, {"sun_angle", sun_disc}};
  const RenderCamera& c = v.camera;
  return {{"size", v.size}, {"fps", v.fps}, {"speed", or_null(v.speed)}, {"at", or_null(v.at)}, {"from", or_null(v.from)}, {"to", or_null(v.to)},
          {"lights", v.lights.value_or(quality.lights)}, {"samples", v.samples.value_or(quality.samples)}, {"background", v.background}, {"exposure", v.exposure}, {"tone", v.tone}, {"light", light}, {"ground", ground}, {"section", section}, {"time", v.time}, {"scale_bar", v.scale_bar}, {"labels", v.labels}, {"objects", objects}, {"field", field},
          {"camera", {{"from", or_null(c.from)}, {"to", or_null(c.to)}, {"look", c.look}, {"turn", degrees(c.turn)}, {"lift", degrees(c.lift)}, {"zoom", c.zoom}, {"angle", degrees(c.angle)}, {"fit", c.fit}}}};
}

std::vector<double> film_times(const RenderView& view, const std::vector<double>& frames) {
  const double first = frames.front(), last = frames.back();
  const double from = view.from.value_or(first), to = view.to.value_or(last), slack = round_off * std::max(std::abs(first), std::abs(last));
  std::vector<double> times;
  if (!view.speed) {
    std::copy_if(frames.begin(), frames.end(), std::back_inserter(times), [&](double t) { return t >= from - slack && t <= to + slack; });
  } else if (from <= to + slack && from <= last + slack && to >= first - slack) {
    const double count = std::max(2.0, std::round((to - from) / *view.speed * view.fps) + 1);
    if (count > picture_count_max)
      throw InputError(fmt::format("speed: {:g} makes a film of {:.6g} pictures, and {:.6g} are the most; raise it, or draw a shorter time (from, to)", *view.speed, count, picture_count_max));
    for (int i = 0; i < static_cast<int>(count); ++i) times.push_back(from + (to - from) * i / (count - 1));
  }
  if (times.empty())
    throw InputError(fmt::format("no frame is between {:g} and {:g} s (from, to): the frames of the run go from {:g} to {:g} s; choose other times, or have the run write more frames (output.frame_interval)",
                                 from, to, first, last));
  return times;
}

void check_built_in(const RenderView& view) {
  constexpr const char* remedy = "give --with blender, or leave it out";
  if (view.samples) throw InputError(fmt::format("samples: only Blender takes them; {}", remedy));
  for (const auto& [name, look] : view.objects)
    if (look.transmission || look.translucency || look.subdivide || look.offset)
      throw InputError(fmt::format("objects.{}: transmission, translucency, subdivide and offset are drawn by Blender alone; {}", name, remedy));
  if (view.section) throw InputError(fmt::format("section: only Blender draws it; {}", remedy));
}

void check_blender(const RenderView& view) {
  const auto refuse = [](const std::string& key) { throw InputError(key + " is not drawn by Blender; leave it out, or leave --with blender out"); };
  if (view.field) refuse("field");
  if (view.lights) refuse("lights (of Blender: samples)");
  for (const auto& [name, look] : view.objects)
    if (look.lines.given && look.lines.value) refuse(fmt::format("objects.{}.lines", name));
}

}  // namespace tack
