// Where an object's mesh comes from: a built-in shape, a file, or what is made of them.
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
  virtual bool costly() const { return false; }  // to be kept once it is made (mesh_cache.hpp)
  // Returns whether files define the mesh, beside the parameters.
  virtual bool reads_files() const { return false; }
  // Returns remarks on the mesh, one line each.
  virtual std::vector<std::string> notes() const { return {}; }
};

}  // namespace tack
