#include "framework/body/rod_section.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tack {

using std::numbers::pi;

double RodSection::area() const { return circular() ? pi * radius * radius : width * height; }

double RodSection::moment_across() const {
  return circular() ? pi * std::pow(radius, 4) / 4 : width * std::pow(height, 3) / 12;
}

double RodSection::moment_along() const {
  return circular() ? pi * std::pow(radius, 4) / 4 : height * std::pow(width, 3) / 12;
}

double RodSection::torsion_constant() const {
  if (circular()) return pi * std::pow(radius, 4) / 2;
  const auto [short_side, long_side] = std::minmax(width, height);
  const double ratio = short_side / long_side;
  double sum = 0;
  for (int n = 1; n < 40; n += 2) sum += std::tanh(n * pi / (2 * ratio)) / std::pow(n, 5);
  return long_side * std::pow(short_side, 3) * (1.0 / 3 - 64 / std::pow(pi, 5) * ratio * sum);
}

double RodSection::radius_of_gyration() const { return std::sqrt((moment_across() + moment_along()) / area()); }

void RodConfig::fields(Fields& f) {
  f.optional_number("radius", radius, units::length, "radius of a circular cross-section; or give width, height and normal").positive();
  f.optional_number("width", width, units::length, "width of a rectangular cross-section, perpendicular to normal and edge").positive();
  f.optional_number("height", height, units::length, "height of a rectangular cross-section, along the component of normal perpendicular to the edge")
      .positive();
  f.optional_vector("normal", normal, units::none, "direction of the height of a rectangular cross-section");
  f.check("radius", [this]() -> std::string {
    const bool rectangle = width && height && normal, any = width || height || normal;
    return radius.has_value() != any && any == rectangle ? "" : "give either radius, or width, height and normal";
  });
  f.check("normal", [this]() -> std::string { return !normal || normal->norm() > 0 ? "" : "must not be zero"; });
  const auto computable = [this](bool circle) -> std::string {
    if (circle ? !radius : !(width && height && normal)) return "";
    const RodSection s = section();
    const bool normal_numbers = std::isnormal(s.area()) && std::isnormal(s.moment_across() + s.moment_along() + s.torsion_constant()) && std::isnormal(s.radius_of_gyration());
    return normal_numbers ? "" : "the moments of the cross-section go with the fourth power of its size, which is no number here";
  };
  f.check("radius", [=] { return computable(true); });
  f.check("width", [=] { return computable(false); });
}

RodSection RodConfig::section() const {
  if (radius) return {*radius};
  return {0, *width, *height, normal->normalized()};
}

void ParticleConfig::fields(Fields& f) {
  f.number("radius", radius, units::length, "radius of the sphere around each point").required().positive();
}

}  // namespace tack
