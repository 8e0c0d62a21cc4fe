// Tangential settings of a scene's contact section.
#pragma once

#include <optional>

#include "framework/config/field.hpp"

namespace tack {

struct FrictionConfig {
  enum class Model { smoothed, stick };
  double mu = 0;
  Model model = Model::smoothed;
  std::optional<double> eps_v;           // m/s; 1 mm/s unless given
  std::optional<double> elastic_slip;    // m; a hundredth of the contact distance unless given
  std::optional<double> mu_static;       // mu unless given
  std::optional<double> mu_across;       // across the grain; mu unless given
  std::optional<double> stribeck_speed;  // m/s; ten times eps_v unless given
  bool sticks() const { return model == Model::stick; }
  double full_speed() const { return eps_v.value_or(1e-3); }  // eps_v [m/s]
  double slip_of_stick(double contact_distance) const {       // elastic_slip [m]
    return elastic_slip.value_or(0.01 * contact_distance);
  }
  double largest() const { return mu_static.value_or(mu); }
  void fields(Fields& f);
};

// Rules that combine the coefficients of friction of two surfaces.
enum class FrictionBlend { geometric, arithmetic, harmonic, minimum, maximum, product };
double blended(FrictionBlend blend, double first, double second);

struct TangentialAdhesionConfig {
  double mu = 1;                // mu_a
  std::optional<double> eps_a;  // m/s
  void fields(Fields& f);
};

struct LaggingConfig {
  int iterations = 1;
  std::optional<double> until;  // relative
  void fields(Fields& f);
};

}  // namespace tack
