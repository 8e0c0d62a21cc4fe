// Contents and camera of a picture or film of runs: a file of `tack render --view`.
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

// Appearance of an object. What is not given stays as other patterns of its name have it.
struct RenderLook {
  std::string colour;  // CSS; empty: not given
  std::optional<double> roughness, metalness, opacity;
  std::optional<double> smooth;  // rad: sharper edges are not smoothed
  // A flag that tells false from not given.
  struct Flag {
    bool value = false, given = false;
  };
  Flag lines, hide;
  // Only drawn by Blender.
  std::optional<double> transmission, translucency;
  std::optional<int> subdivide;  // levels of Catmull-Clark subdivision
  std::optional<double> offset;  // m, by which surfaces are drawn outside of where they are
  void fields(Fields& f);
};

// A plane below the objects, which receives their shadows.
struct RenderGround {
  std::optional<double> at;  // m, height; below everything that is shown unless given
  std::string colour;        // CSS; empty: only shadows are drawn
  void fields(Fields& f);
};

// A plane that objects are cut by.
struct RenderSection {
  Vec3 through = Vec3::Zero();  // m
  Vec3 normal = Vec3::UnitX();  // towards what is not drawn
  void fields(Fields& f);
};

// Factors of the two lights of a picture.
struct RenderLight {
  double sun = 1, sky = 1;
  void fields(Fields& f);
};

struct RenderField {
  std::string name;
  std::vector<double> limits;  // none or two
  bool log = false;
  std::string map = "automatic";
  void fields(Fields& f);
};

struct RenderCamera {
  std::optional<Vec3> from, to;  // m
  std::string look = "corner", fit = "run";
  double turn = 0, lift = 0, angle = 0.5585053606381855;  // rad
  double zoom = 1;
  void fields(Fields& f);
};

struct RenderView {
  std::array<int, 2> size = {1280, 720};
  double fps = 30;
  std::optional<double> speed, at, from, to;  // at, from, to: s
  std::optional<int> lights;
  std::optional<int> samples;          // paths per pixel, of Blender
  std::string background = "#ffffff";  // CSS, or "transparent"
  double exposure = 1;                 // factor of the light before `tone`
  RenderLight light;
  std::string tone = "none";  // or "filmic"
  std::optional<RenderGround> ground;
  std::optional<RenderSection> section;  // only drawn by Blender
  bool time = true, scale_bar = true;
  std::vector<std::string> labels;
  std::map<std::string, RenderLook> objects;  // by name; "chip*" matches names with that beginning
  std::optional<RenderField> field;
  RenderCamera camera;
  void fields(Fields& f);
};

// Defaults that differ between pictures and films.
struct RenderQuality {
  int lights, samples;
};

// Returns the view for report/render.mjs and report/blender.py. Numbers of `quality` are used
// unless the view gives its own.
nlohmann::ordered_json json_of(const RenderView& view, const RenderQuality& quality);

// Returns the times [s] of a film's pictures: those of all frames between `from` and `to`, or
// evenly spaced ones for a film with a `speed`. frames: times of the frames, ascending, at least
// one. Throws InputError if there are none.
std::vector<double> film_times(const RenderView& view, const std::vector<double>& frames);

// Throw InputError for a key of the view that this renderer does not draw.
void check_built_in(const RenderView& view);
void check_blender(const RenderView& view);

}  // namespace tack
