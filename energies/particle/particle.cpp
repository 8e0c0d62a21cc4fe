// Points with the mass of a sphere. They move, and turn only if they roll (framework/setup/spins.hpp).
#include <fmt/format.h>

#include <numbers>

#include "framework/config/field.hpp"
#include "framework/scene/rolling_energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class Particle : public RollingEnergy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("density", density_, units::density, "mass per volume of the sphere").positive();
    f.optional_number("mass", mass_, units::mass, "mass of each sphere, instead of density").positive();
    rolling_field(f);
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX&) const override {
    if (body.points.empty())
      throw InputError(fmt::format("object '{}': the energy {} needs explicit points, and its shape has none; use a shape or mesh of "
                                   "points", body.name, type()));
    if (body.radius == 0)
      throw InputError(fmt::format("object '{}': the energy {} needs the radius of the points; give `particle: {{radius: ...}}`", body.name, type()));
    return nullptr;
  }
  void add_mass(const Body& body, const VecX&, VecX& mass) const override {
    const double sphere = density_ * 4 / 3 * std::numbers::pi * body.radius * body.radius * body.radius;
    for (const int v : body.points) mass(v) += mass_.value_or(sphere);
  }

 private:
  double density_ = 1000;       // kg/m^3
  std::optional<double> mass_;  // kg
};

TACK_REGISTER(Energy, Particle, "particle", "Spheres: points with a radius (`particle`), with mass and without stiffness; they rotate only with "
                                            "`rolling`.", "");

}  // namespace
}  // namespace tack
