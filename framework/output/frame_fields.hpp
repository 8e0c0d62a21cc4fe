// Fields that frames can contain besides positions, times and the object index of cells. Only
// fields named in `output.fields` are computed.
#pragma once

#include <string>
#include <vector>

#include "framework/output/vtu.hpp"

namespace tack {

struct State;
struct World;

struct FrameFieldInfo {
  std::string name, unit, doc;
  bool of_elements;    // per element; false: per vertex
  int components = 1;  // components of fields of elements
};

// Returns all fields; those that terms publish (core/published_field.hpp) come last, also if the
// scene has no such term.
std::vector<FrameFieldInfo> frame_fields();

// Returns those of `names` that are fields of vertices, at an accepted state, for the vertices of
// `geometry`. element_fields.hpp returns those of elements.
std::vector<PointField> vertex_fields(const std::vector<std::string>& names, const World& world,
                                      const State& state, const FrameGeometry& geometry);

}  // namespace tack
