// An elastic rod that stretches, bends and twists.
#include <fmt/format.h>

#include <algorithm>

#include "energies/rod/edges.hpp"
#include "energies/rod/rod_term.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/rolling_energy.hpp"
#include "framework/scene/strain_energy.hpp"

namespace tack {
namespace {

class ElasticRod : public RollingEnergy, public StrainEnergy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("young", young_, units::pressure, "Young's modulus E").required().positive();
    f.number("poisson", poisson_, units::none, "Poisson's ratio, from which the shear modulus follows: G = E / (2 (1 + nu))").range(-0.99, 0.5);
    f.optional_number("shear", shear_, units::pressure, "shear modulus G, instead of the one that poisson gives").positive();
    f.number("density", density_, units::density, "mass per rest volume").positive();
    f.choice("rest", straight_,
             {{"mesh", false, "the shape of the mesh"},
              {"straight", true, "straight between joints (vertices where more than two edges meet); joints keep the shape of the mesh"}},
             "stress-free shape");
    f.vector("curvature", curvature_, units::curvature,
             "added to the rest curvature, in the frame of the section: bending towards `normal`, and perpendicular to it");
    f.number("twist", twist_, units::curvature, "added to the rest twist: angle per length");
    rolling_field(f);
  }
  bool twists() const override { return true; }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override { return make_scaled(body, rest, 1); }
  std::unique_ptr<Term> make_scaled(const Body& body, const VecX& rest, double scale) const override {
    const RodSection& section = section_of(body, type());
    const double young = scale * young_, shear = scale * shear_.value_or(young_ / (2 * (1 + poisson_)));
    const RodMaterial material{young * section.area(), {young * section.moment_across(), young * section.moment_along(), shear * section.torsion_constant()}};
    return std::make_unique<RodTerm>(std::string(type()), fmt::format("{}/energies/{}/", body.name, body.energy), material,
                                     RodRest{straight_, curvature_, twist_}, body.edges, body.rod, rest);
  }
  std::string_view branch() const override { return "maxwell_rod"; }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override {
    add_edge_mass(body, rest, density_, mass);
    for (const Edge& e : body.edges)
      mass(body.rod->twists()[body.rod->find(e)]) += density_ * body.section->area() * edge_length(e, rest);
  }
  std::optional<double> young() const override { return young_; }
  double bending_stiffness(const Body& body) const override {
    const RodSection& section = section_of(body, type());
    return young_ * std::min(section.moment_across(), section.moment_along()) / section.contact_width();
  }

 private:
  double young_ = 1e9;  // Pa
  double poisson_ = 0.3;
  std::optional<double> shear_;  // Pa
  double density_ = 1000;        // kg/m^3
  bool straight_ = false;
  Vec2 curvature_ = Vec2::Zero();  // 1/m
  double twist_ = 0;               // 1/m
};

TACK_REGISTER(Energy, ElasticRod, "elastic_rod", "Edges with a section (`rod`) that stretch, bend and twist.",
              "Bergou, Wardetzky, Robinson, Audoly, Grinspun 2008, Discrete Elastic Rods; Bergou, Audoly, Vouga, Wardetzky, Grinspun "
              "2010, Discrete Viscous Threads");

}  // namespace
}  // namespace tack
