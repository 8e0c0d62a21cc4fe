// What a picture or a film of runs shows, and from where: a file of `tack render --view`.
#pragma once

#include <array>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

// How an object looks.
struct RenderLook {
  std::string colour;  // of CSS; empty: its own
  double roughness = 0.7, metalness = 0, opacity = 1;
  double smooth = 0.6981317007977318;  // rad: edges that are sharper stay sharp
  bool lines = false, hide = false;
  void fields(Fields& f);
};

struct RenderField {
  std::string name;
  std::vector<double> limits;  // none, or two
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
  std::map<std::string, RenderLook> objects;  // by name; "chip*" for all that begin so
  std::optional<RenderField> field;
  RenderCamera camera;
  void fields(Fields& f);
};

// As report/render.mjs reads it; lights: unless the view says how many.
nlohmann::ordered_json json_of(const RenderView& view, int lights);

}  // namespace tack
