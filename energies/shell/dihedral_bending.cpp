#include "energies/shell/dihedral_term.hpp"
#include "energies/shell/sheet_geometry.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/strain_energy.hpp"

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
    f.check("young", [this]() -> std::string {
      return young_.has_value() != stiffness_.has_value() ? "" : "and stiffness: give one of the two";
    });
  }

  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override { return make_scaled(body, rest, 1); }
  std::unique_ptr<Term> make_scaled(const Body& body, const VecX& rest, double scale) const override {
    require_sheet(body, rest, type());
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
};

TACK_REGISTER(Energy, DihedralBending, "hinge_bending",
              "Plate bending of a sheet at the edges between its triangles. Without mass: combine it with a membrane.",
              "Grinspun et al. 2003, Discrete Shells; Comodi 1989 for the moments of hinges");

}  // namespace
}  // namespace tack
