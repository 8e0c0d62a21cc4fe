// The energy `hgo_fibres`: fibres that stiffen a solid or a sheet.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "energies/hyperelastic/fibre_term.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// A family of fibres: along one direction, or helices about an axis.
struct FibreFamily {
  std::optional<Vec3> direction, axis;
  Vec3 through = Vec3::Zero();  // m
  double angle = 0;             // rad

  void fields(Fields& f) {
    f.optional_vector("direction", direction, units::none, "direction of the fibres at rest, in the scene; projected onto each triangle of a sheet");
    f.optional_vector("axis", axis, units::none, "instead of direction: the axis that the fibres wind about, as in a tube");
    f.vector("through", through, units::length, "a point of the axis");
    f.number("angle", angle, units::angle, "of helices about the axis: 0 around it, 90 deg along it").range(-1.5707963267948967, 1.5707963267948967);
    f.check("direction", [this]() -> std::string {
      if (direction.has_value() == axis.has_value()) return "and axis: give one of the two";
      return (direction ? *direction : *axis).norm() > 0 ? "" : "or axis must not be zero";
    });
  }
  // Returns the direction at a position at rest; not of unit length, zero on the axis.
  Vec3 at(const Vec3& x) const {
    if (direction) return direction->normalized();
    const Vec3 a = axis->normalized(), around = a.cross(x - through);
    return around.norm() > 0 ? Vec3(std::cos(angle) * around.normalized() + std::sin(angle) * a) : Vec3::Zero();
  }
};

class HgoFibres : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("k1", law_.k1, units::pressure, "stiffness of a family at small strains").required().positive();
    f.number("k2", law_.k2, units::none, "stiffening: the energy grows as exp(k2 E^2)").required().positive();
    f.number("kappa", law_.kappa, units::none, "dispersion: 0 for fibres of one direction; isotropic at 1/3 in solids and 1/2 in sheets").range(0, 0.5);
    f.list("families", families_, "families of fibres with these constants, each with a direction").required().nonempty();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    if (body.tets.empty()) {
      require_sheet(body, rest, type());
      return make(body, FibreTriangles(body, rest), "triangle");
    }
    if (law_.kappa > 1.0 / 3) throw InputError(fmt::format("object '{}': the dispersion kappa of {} is {:g}, and 1/3 is isotropic in a solid; lower it", body.name, type(), law_.kappa));
    if (body.elements == Elements::composite) return make(body, FibreComposites(body, rest), "composite tet");
    return make(body, FibreTets(body, rest), "tet");
  }
  bool takes_elements() const override { return true; }

 private:
  template <class Kind>
  std::unique_ptr<Term> make(const Body& body, Kind elements, const char* what) const {
    constexpr int dim = Kind::dim;
    std::vector<std::vector<PackMatrix<dim>>> directions;
    const int count = elements.count(), packs = (count + pack_width - 1) / pack_width;
    for (const FibreFamily& family : families_) {
      std::vector<PackMatrix<dim>>& all = directions.emplace_back(packs);
      for (int i = 0; i < packs * pack_width; ++i) {
        const int element = std::min(i, count - 1);
        const Eigen::Matrix<double, dim, 1> d = elements.along(element, family.at(elements.centre(element)));
        if (!(d.norm() > 1e-6))
          throw InputError(fmt::format("object '{}': the fibres of {} have no direction in {} {}, which lies on the axis or across them; give another direction, or select the part that they are in",
                                       body.name, type(), what, element));
        set_lane<dim, 1>(all[i / pack_width], i % pack_width, Eigen::Matrix<double, dim, 1>(d.normalized()));
      }
    }
    return std::make_unique<FibreTerm<Kind>>(std::string(type()), law_, std::move(elements), std::move(directions));
  }

  FibreLaw law_;
  std::vector<FibreFamily> families_ = {FibreFamily{Vec3::UnitX(), {}}};
};

TACK_REGISTER(Energy, HgoFibres, "hgo_fibres",
              "Families of dispersed fibres that stiffen a solid or a sheet in tension alone, beside another energy. Without mass.",
              "Holzapfel, Gasser, Ogden 2000; Gasser, Ogden, Holzapfel 2006; Nolan et al. 2014");

}  // namespace
}  // namespace tack
