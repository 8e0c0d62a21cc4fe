// What frames can hold besides positions, times and the number of each cell's object: `output.fields` names it, and only what is
// named is computed.
#pragma once

#include <string>
#include <vector>

#include "framework/output/vtu.hpp"

namespace tack {

struct State;
struct World;

struct FrameFieldInfo {
  std::string name, unit, doc;
  bool of_elements;  // else of vertices
  int components = 1;  // of elements
};

// All there are, those that terms publish (core/published_field.hpp) behind the others; a scene may be without what publishes them.
std::vector<FrameFieldInfo> frame_fields();

// The fields of vertices among `names`, at an accepted state, for the vertices of `geometry`. Those of elements: element_fields.hpp.
std::vector<PointField> vertex_fields(const std::vector<std::string>& names, const World& world, const State& state,
                                      const FrameGeometry& geometry);

}  // namespace tack
