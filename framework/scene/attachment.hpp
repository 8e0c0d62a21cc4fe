// `attach:` of an object: vertices that depend on another object, as if they were points of its
// mesh.
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"

namespace tack {

struct World;
struct SceneConfig;

struct AttachConfig {
  std::unique_ptr<Selection> select = Registry<Selection>::make("all");
  std::string to;
  std::optional<double> within;  // m
  std::optional<double> until;   // s
  void fields(Fields& f);
};

// Adds the attachments of object `index` to the constraints of the world. A vertex depends on the
// tetrahedron of the other object that contains it or has the nearest face; without tetrahedra, on
// the triangle that it lies on; or on the frame of an affine body. Throws InputError if a vertex is
// too far away, prescribed by a motion, or attached to an object that depends on it. Where surfaces
// touch, the two objects have no contact (World::attached).
void add_attachments(const SceneConfig& scene, int index, World& world);

}  // namespace tack
