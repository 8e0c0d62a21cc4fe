#include "framework/config/schema_numbers.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <regex>

#include "geometry/errors.hpp"

using namespace tack;

namespace {

bool program_accepts(const std::string& text, const Unit& unit) {
  try {
    to_si(text, unit);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

TEST_CASE("the schema accepts the same spellings of common units as the program") {
  const std::regex known(known_unit_pattern());
  const std::vector<std::string> written{"%",     "rad",     "30 deg", "mm",      "um",    "in",    "mm^2",   "m2",      "cm^3",    "ms",   "min", "h",
                                         "s^-1",  "s-1",     "1/s",    "1/mm",    "g",     "t",     "kN",     "mN",      "MPa",     "bar",  "psi", "mJ",
                                         "kW",    "Hz",      "m/s",    "mm / s",  "cm/s^2", "m s-2", "km/h",   "g/cm^3",  "kg/m2",   "kg/m", "N/m", "N m",
                                         "N.m",   "N*m",     "J/m^2",  "N/mm^2",  "Pa s",  "Pa/m",  "mPa*s",  "deg/s",   "rad/min", "J/s",  "m^2/s", "mm/m"};
  for (const Unit& unit : {units::none, units::angle, units::length, units::area, units::volume, units::curvature, units::time, units::frequency,
                           units::angular_velocity, units::velocity, units::acceleration, units::mass, units::density, units::area_density,
                           units::line_density, units::force, units::stiffness, units::work_of_adhesion, units::pressure, units::traction_stiffness,
                           units::energy, units::moment, units::viscosity, units::power}) {
    const std::regex right(unit_pattern(unit));
    for (const std::string& unit_text : written) {
      const std::string text = std::isdigit(static_cast<unsigned char>(unit_text[0])) && unit_text[1] != '/' ? unit_text : "-2.5e3 " + unit_text;
      INFO(text << " as " << unit.quantity);
      CHECK(std::regex_search(text, known));
      CHECK(std::regex_search(text, right) == program_accepts(text, unit));
    }
  }
  for (const char* other : {"5", "5 kg m-1 s-2", "5 furlong", "5 N m/rad"}) CHECK_FALSE(std::regex_search(other, known));
}
