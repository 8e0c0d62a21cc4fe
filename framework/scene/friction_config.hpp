// Tangential settings of a scene's contact section.
#pragma once

#include <optional>

#include "framework/config/field.hpp"

namespace tack {

struct FrictionConfig {
  double mu = 0;
  double eps_v = 1e-3;                   // m/s
  std::optional<double> mu_static;       // mu unless given
  std::optional<double> stribeck_speed;  // m/s; ten times eps_v unless given
  double largest() const { return mu_static.value_or(mu); }
  void fields(Fields& f);
};

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
