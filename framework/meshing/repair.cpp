#include "geometry/meshing/repair.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Repair : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return repair(mesh, options_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.optional_number("merge", options_.merge, units::length,
                      "vertices that close become one; unless given, as close as single precision rounds coordinates of that size (STL)").nonnegative();
    f.choice("holes", options_.holes,
             {{"of_solids", Holes::of_solids, "are filled where they are at most a tenth of the area of the part, which is taken for a solid; of others, sheets, they stay"},
              {"fill", Holes::fill, "are filled; a sheet that its own filling would lie on is refused"},
              {"keep", Holes::keep, "stay"}},
             "what becomes of them");
  }

 private:
  RepairOptions options_;
};
TACK_REGISTER(MeshOperation, Repair, "repair",
              "A broken surface made manifold, and closed with normals outwards if it is a solid's, or refused with the numbers of what is broken.", "");

}  // namespace
}  // namespace tack
