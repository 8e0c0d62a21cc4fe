// Where an object's mesh comes from: a built-in shape or a file.
#pragma once

#include "framework/config/registry.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

class ShapeSource : public Component {
 public:
  static constexpr const char* kind_name = "shape";
  static constexpr const char* kind_doc = "The mesh of an object: a built-in shape or a file.";
  virtual Mesh make() const = 0;  // throws InputError
  virtual bool reads_files() const { return false; }  // so that the parameters alone do not make the mesh
};

}  // namespace tack
