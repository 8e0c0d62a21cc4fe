// A step from one mesh to another, by name: in a scene's shape of type `processed`, and of `tack mesh NAME`.
// One that is new is a file beside this one: fields, apply, and its registration.
#pragma once

#include "framework/config/field.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

class MeshOperation : public Component {
 public:
  static constexpr const char* kind_name = "mesh_operation";
  static constexpr const char* kind_doc =
      "A step of a processed shape, and an operation of `tack mesh NAME` on a file. Groups of the mesh are dropped.";

  void fields(Fields& f) final;

  // What apply needs from elsewhere: called before it, by the program itself.
  virtual void prepare() {}
  // Runs in a process of its own: foreign libraries may crash, loop or take all memory. Hence no parallel loops in it,
  // and nothing that it keeps is kept. Throws InputError, beginning with `name`, which says what the mesh is.
  virtual Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const = 0;

  double time_limit() const { return time_limit_; }  // s

 protected:
  virtual void parameters(Fields&) {}

 private:
  double time_limit_ = 120;  // s
};

// Prepares and applies it, within its time limit. Throws the InputError that it throws, or one that says how it ended.
// Notes are added: what it did, the time it took, and the quality of the mesh.
Mesh run_operation(MeshOperation& operation, const Mesh& mesh, const std::string& name, Notes& notes);

}  // namespace tack
