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

// Appearance of an object.
struct RenderLook {
  std::string colour;  // CSS; empty: the object's own
  double roughness = 0.7, metalness = 0, opacity = 1;
  double smooth = 0.6981317007977318;  // rad: sharper edges are not smoothed
  bool lines = false, hide = false;
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
  std::string background = "#ffffff";
  bool time = true, scale_bar = true;
  std::vector<std::string> labels;
  std::map<std::string, RenderLook> objects;  // by name; "chip*" matches names with that beginning
  std::optional<RenderField> field;
  RenderCamera camera;
  void fields(Fields& f);
};

// Returns the view for report/render.mjs. lights: used unless the view gives a number.
nlohmann::ordered_json json_of(const RenderView& view, int lights);

}  // namespace tack
