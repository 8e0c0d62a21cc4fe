// `attach:` of an object: vertices that follow another one, as if they were points of its mesh.
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

// Adds what object `index` attaches to the world's bindings. A vertex follows the tet of the other object that it is
// in, or that has the closest face; the triangle that it lies on, of one without tets; or the frame of an affine body.
// Throws InputError if one is too far away, held by a script, or attached to what follows it in turn.
// Where surfaces touch, the two objects are in no contact (World::attached).
void add_attachments(const SceneConfig& scene, int index, World& world);

}  // namespace tack
