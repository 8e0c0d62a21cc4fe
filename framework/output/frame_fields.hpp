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
  const char* name;
  const char* unit;
  const char* doc;
  bool of_elements;  // else of vertices
};

// All there are, those of vertices first.
const std::vector<FrameFieldInfo>& frame_fields();

// The fields of vertices among `names`, at an accepted state, for the vertices of `geometry`. Those of elements: element_fields.hpp.
std::vector<PointField> vertex_fields(const std::vector<std::string>& names, const World& world, const State& state,
                                      const FrameGeometry& geometry);

}  // namespace tack
