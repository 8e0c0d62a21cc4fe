#include "framework/shapes/length_unit.hpp"

#include <fmt/format.h>

#include "framework/config/units.hpp"
#include "geometry/errors.hpp"

namespace tack {

namespace {

double metres(const std::string& unit) { return to_si("1 " + unit, units::length); }

}  // namespace

std::string LengthUnits::problem() const {
  for (const std::string* unit : {&from, &to}) {
    try {
      if (unit->find_first_of("0123456789") != std::string::npos || !(metres(*unit) > 0)) throw InputError("");
    } catch (const InputError&) {
      return fmt::format("expects a unit of length, as m, mm, um or inch, got '{}'", *unit);
    }
  }
  return "";
}

double LengthUnits::factor() const { return metres(from) / metres(to); }

std::string scaled_note(const Mesh& scaled, double factor, const std::string& unit) {
  const Vec3 size = bounding_box(scaled).sizes();
  return fmt::format("scaled by {:.6g}: now {:.4g} x {:.4g} x {:.4g} {}", factor, size.x(), size.y(), size.z(), unit);
}

}  // namespace tack
