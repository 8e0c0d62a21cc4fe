// Cross-section of the edges of an object, with its constants of beam theory.
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"

namespace tack {

// A circle, or a rectangle. The height of a rectangle lies along `normal`, projected across the
// edge, its width across both.
struct RodSection {
  double radius = 0;             // m; 0: a rectangle
  double width = 0, height = 0;  // m
  Vec3 normal = Vec3::Zero();    // of a rectangle

  bool circular() const { return radius > 0; }
  double contact_width() const {
    return circular() ? 2 * radius : width;
  }                              // that another surface sees [m]
  double area() const;           // A [m^2]
  double moment_across() const;  // I1 [m^4]: about the width, of bending towards `normal`
  double moment_along() const;   // I2 [m^4]: about the height, of bending across it
  // Returns J [m^4]; for a rectangle by its series (Timoshenko and Goodier, section 109)
  double torsion_constant() const;
  // Returns the radius of gyration: all mass there has the polar moment I1 + I2 [m].
  double radius_of_gyration() const;
};

// `rod:` of an object.
struct RodConfig {
  std::optional<double> radius, width, height;  // m
  std::optional<Vec3> normal;
  void fields(Fields& f);
  RodSection section() const;
};

// `particle:` of an object.
struct ParticleConfig {
  double radius = 0;  // m
  void fields(Fields& f);
};

}  // namespace tack
