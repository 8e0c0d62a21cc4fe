// Source of an object's mesh: a built-in shape, a file, or a mesh derived from them.
#pragma once

#include "framework/config/registry.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

class ShapeSource : public Component {
 public:
  static constexpr const char* kind_name = "shape";
  static constexpr const char* kind_doc =
      "The mesh of an object: a built-in shape, a file, or a mesh derived from them.";
  virtual Mesh make() const = 0;  // throws InputError
  // Returns true if the mesh is worth caching (mesh_cache.hpp).
  virtual bool costly() const { return false; }
  // Returns true if the mesh depends on files or libraries beside the parameters.
  virtual bool reads_files() const { return false; }
  // Returns remarks on the mesh, one line each.
  virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace tack
