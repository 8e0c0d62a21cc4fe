// A named operation from mesh to mesh: of a scene's shape of type `processed`, and of `tack mesh
// NAME`. A new operation is a file beside this one with fields, apply and its registration.
#pragma once

#include "framework/config/field.hpp"
#include "geometry/mesh/mesh.hpp"
#include "geometry/meshing/notes.hpp"

namespace tack {

class MeshOperation : public Component {
 public:
  static constexpr const char* kind_name = "mesh_operation";
  static constexpr const char* kind_doc =
      "A step of a processed shape, and an operation of `tack mesh NAME` on a file. Groups of the "
      "mesh are dropped.";

  void fields(Fields& f) final;

  // Prepares for apply(), for example by making another mesh. Called before it, in the program's
  // own process.
  virtual void prepare() {}
  // Applies the operation. Runs in a child process, since external libraries may crash, loop or
  // exhaust the memory: no parallel loops, and changes of members are lost. `name`: of the mesh,
  // with which messages begin. Throws InputError.
  virtual Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const = 0;

  double time_limit() const { return time_limit_; }  // s

 protected:
  virtual void parameters(Fields&) {}

 private:
  double time_limit_ = 120;  // s
};

// Prepares and applies an operation within its time limit. Throws the InputError of the operation,
// or one that says how the child process ended. Appends to `notes`: its result, the time, and the
// quality of the mesh.
Mesh run_operation(MeshOperation& operation, const Mesh& mesh, const std::string& name,
                   Notes& notes);

}  // namespace tack
