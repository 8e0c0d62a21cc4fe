#include <fmt/format.h>

#include "energies/shell/dihedral_term.hpp"
#include "energies/shell/sheet_geometry.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/strain_energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class DihedralBending : public Energy, public StrainEnergy {
 public:
  enum class Rest { flat, mesh };

  void fields(Fields& f) override {
    Energy::fields(f);
    f.optional_number("young", young_, units::pressure, "Young's modulus: D = E thickness^3 / (12 (1 - nu^2))").positive();
    f.number("poisson", poisson_, units::none, "nu: ratio of the transverse (anticlastic) curvature to the bending curvature").range(0, 0.4999);
    f.optional_number("stiffness", stiffness_, units::energy, "D: moment per width and curvature, instead of Young's modulus").positive();
    f.choice("rest", rest_, {{"flat", Rest::flat, "flat, for any mesh"},
                             {"mesh", Rest::mesh, "the shape of the mesh"}},
             "moment-free shape");
    f.optional_number("yield_moment", yield_moment_, units::force, "moment per length at which a sheet curved about one axis begins to keep its curvature; elastic unless given").positive();
    f.number("hardening", hardening_, units::energy, "growth of the yield moment per plastic curvature [N m]; 0: perfect plasticity").nonnegative();
    f.check("hardening", [this]() -> std::string { return hardening_ == 0 || yield_moment_ ? "" : "needs a yield_moment"; });
    f.check("young", [this]() -> std::string {
      return young_.has_value() != stiffness_.has_value() ? "" : "and stiffness: give one of the two";
    });
  }

  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    require_sheet(body, rest, type());
    return std::make_unique<DihedralTerm>(std::string(type()), body, rest, bending_stiffness(body), poisson_, rest_ == Rest::mesh,
                                          yield_moment_ ? std::optional(PlasticBending{*yield_moment_, hardening_}) : std::nullopt);
  }
  std::unique_ptr<Term> make_scaled(const Body& body, const VecX& rest, double scale) const override {
    require_sheet(body, rest, type());
    if (yield_moment_)
      throw InputError(fmt::format("object '{}': branches of maxwell_bending relax beside elastic bending, and its hinge_bending has a yield_moment of {:.6g} N; leave out `yield_moment`, or "
                                   "the branches", body.name, *yield_moment_));
    return std::make_unique<DihedralTerm>(std::string(type()), body, rest, scale * bending_stiffness(body), poisson_, rest_ == Rest::mesh);
  }
  std::string_view branch() const override { return "maxwell_bending"; }
  std::optional<double> young() const override { return young_; }
  double bending_stiffness(const Body& body) const override {
    const double t = body.thickness;
    return stiffness_ ? *stiffness_ : *young_ * t * t * t / (12 * (1 - poisson_ * poisson_));
  }

 private:
  std::optional<double> young_, stiffness_;  // Pa, N m
  double poisson_ = 0.3;
  Rest rest_ = Rest::flat;
  std::optional<double> yield_moment_;  // N
  double hardening_ = 0;                // N m
};

TACK_REGISTER(Energy, DihedralBending, "hinge_bending",
              "Plate bending of a sheet at the edges between its triangles. Without mass: combine it with a membrane.",
              "Grinspun et al. 2003, Discrete Shells; Comodi 1989 for the moments of hinges");

}  // namespace
}  // namespace tack
