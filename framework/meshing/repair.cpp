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
                      "distance within which vertices are merged; unless given, the single-precision rounding of the coordinates (STL)").nonnegative();
    f.choice("holes", options_.holes,
             {{"of_solids", Holes::of_solids, "fill holes of at most a tenth of the area of their component, which then counts as a solid; other "
                                              "components are sheets and keep their holes"},
              {"fill", Holes::fill, "fill all holes; a sheet that would coincide with its own filling is refused"},
              {"keep", Holes::keep, "keep all holes"}},
             "treatment of holes");
  }

 private:
  RepairOptions options_;
};
TACK_REGISTER(MeshOperation, Repair, "repair",
              "A surface made manifold, and closed with outward normals if it bounds a solid; refused with counts of the defects if that fails.", "");

}  // namespace
}  // namespace tack
