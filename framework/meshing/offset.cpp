#include "geometry/meshing/offset.hpp"

#include "framework/meshing/mesh_operation.hpp"

namespace tack {
namespace {

class Offset : public MeshOperation {
 public:
  Mesh apply(const Mesh& mesh, const std::string& name, Notes& notes) const override { return offset(mesh, options_, name, notes); }

 protected:
  void parameters(Fields& f) override {
    f.number("distance", options_.distance, units::length, "outwards if positive, inwards if negative").required();
    f.number("edge_length", options_.edge_length, units::length, "approximate edge length of the new surface").required().positive();
    f.optional_number("deviation", options_.deviation, units::length,
                      "largest deviation of the new surface from that distance; a twentieth of its edge length unless given").positive();
    f.check("distance", [this] { return options_.distance != 0 ? "" : "is zero: leave the step out"; });
  }

 private:
  OffsetOptions options_;
};
TACK_REGISTER(MeshOperation, Offset, "offset", "The surface at a distance from a solid.",
              "Boissonnat and Oudot, Provably good sampling and meshing of surfaces, 2005");

}  // namespace
}  // namespace tack
