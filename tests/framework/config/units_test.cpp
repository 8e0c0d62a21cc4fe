#include "framework/config/units.hpp"

#include <catch2/catch.hpp>
#include <thread>
#include <vector>

#include "geometry/errors.hpp"
#include "tests/framework/config/toy.hpp"

using namespace tack;
using toy::message_of;

namespace {

std::string error_of(const std::string& text, const Unit& unit) {
  return message_of([&] { to_si(text, unit); });
}

}  // namespace

TEST_CASE("numbers without a unit are SI, bit for bit") {
  CHECK(to_si("1e3", units::pressure) == 1000);
  CHECK(to_si(" -0.1 ", units::length) == -0.1);
  CHECK(to_si("+2.5", units::none) == 2.5);
  CHECK(to_si("1e+20", units::none) == 1e20);
}

TEST_CASE("units are converted to SI") {
  CHECK(to_si("5 MPa", units::pressure) == 5e6);
  CHECK(to_si("0.1 mm", units::length) == Approx(1e-4).epsilon(1e-15));
  CHECK(to_si("0.1mm", units::length) == to_si("0.1 mm", units::length));
  CHECK(to_si("30 deg", units::angle) == Approx(0.5235987755982988).epsilon(1e-15));
  CHECK(to_si("9.81 m/s^2", units::acceleration) == 9.81);
  CHECK(to_si("9.81 m s-2", units::acceleration) == 9.81);
  CHECK(to_si("1.2 g/cm^3", units::density) == Approx(1200).epsilon(1e-14));
  CHECK(to_si("10 %", units::none) == Approx(0.1).epsilon(1e-15));
  CHECK(to_si("5%", units::none) == Approx(0.05).epsilon(1e-15));
  CHECK(to_si("60 rpm", units::angular_velocity) == Approx(6.283185307179586).epsilon(1e-14));
  CHECK(to_si("2 1/s", units::frequency) == 2);
  CHECK(to_si("3 mJ/m^2", units::work_of_adhesion) == Approx(3e-3).epsilon(1e-14));
  CHECK(to_si("1e3 N/m^2", units::pressure) == 1000);
  CHECK(to_si("2 mJ s/m^2", units::surface_viscosity) == Approx(2e-3).epsilon(1e-14));
  CHECK(to_si("2 Pa s m", units::surface_viscosity) == 2);
  CHECK(to_si("0.5 1/(kPa s)", units::fluidity) == Approx(5e-4).epsilon(1e-14));
}

TEST_CASE("a wrong dimension is named") {
  CHECK(error_of("5 mm", units::pressure) ==
        "expects a pressure (Pa), got '5 mm', which is a length");
  CHECK(error_of("5 kPa", units::acceleration) ==
        "expects an acceleration (m/s^2), got '5 kPa', which is a pressure");
  CHECK(error_of("30 deg", units::length) ==
        "expects a length (m), got '30 deg', which is an angle");
  CHECK(error_of("3 %", units::length) == "expects a length (m), got '3 %', which is a number");
  CHECK(error_of("5 mm", units::none) == "expects a number, got '5 mm', which is a length");
  CHECK(error_of("3 Pa s", units::surface_viscosity) == "expects a viscosity of a surface (J s/m^2), got '3 Pa s', which is a viscosity");
  CHECK(error_of("3 J s/m^2", units::fluidity) == "expects a rate per pressure (1/(Pa s)), got '3 J s/m^2', which is a viscosity of a surface");
  // The reciprocal of a unit is another dimension.
  CHECK(error_of("10 Hz", units::time) == "expects a time (s), got '10 Hz', which is a frequency");
  CHECK(error_of("3 m^7", units::time) ==
        "expects a time (s), got '3 m^7', which is a quantity of another dimension");
}

TEST_CASE("texts that are no number with a unit are refused") {
  CHECK(error_of("", units::length) == "expects a length (m), got ''");
  CHECK(error_of("mm", units::length) == "expects a length (m), got 'mm'");
  CHECK(error_of("1.0abc", units::none) ==
        "expects a number, got '1.0abc'; 'abc' is no known unit");
  CHECK(error_of("5 mpa", units::pressure) ==
        "expects a pressure (Pa), got '5 mpa'; 'mpa' is no known unit; did you mean 'MPa'?");
  CHECK(error_of("nan", units::none) == "expects a number, got 'nan', which is not finite");
  CHECK(error_of("-inf", units::none) == "expects a number, got '-inf', which is not finite");
  CHECK(error_of("1e999", units::none) == "expects a number, got '1e999', which is out of range");
  CHECK(error_of("1e308 km", units::length) ==
        "expects a length (m), got '1e308 km', which is out of range");
  for (const char* junk :
       {"5 m 3", "5 3 m", "5 m; x", "5 m,", "1 2", "5 s since 2000-01-01", "+-3", "++3", "5 m + 3",
        "5 (2) m", "5 m.2", "5 m @ 3", "0x10", "1_000", "5 m (", "5 -m", "5 /s"}) {
    INFO(junk);
    CHECK(error_of(junk, units::length) != "");
  }
}

TEST_CASE("units are converted in many threads at once") {
  std::vector<double> results(8);
  std::vector<std::thread> threads;
  for (double& result : results) {
    threads.emplace_back([&result] {
      for (int i = 0; i < 200; ++i) result += to_si("5 MPa", units::pressure);
    });
  }
  for (std::thread& t : threads) t.join();
  CHECK(results == std::vector<double>(8, 1e9));
}

TEST_CASE("the SI unit of a unit is the one that parameters of its kind have", "[units]") {
  for (const auto& [unit, si] : std::vector<std::pair<std::string, std::string>>{
           {"mN", "N"}, {"N/mm^2", "Pa"}, {"kPa", "Pa"}, {"Pa", "Pa"}, {"J/m^2", "J/m^2"}, {"N m", "N m"}, {"mm", "m"}, {"deg", "rad"},
           {"ms", "s"}, {"g/cm^3", "kg/m^3"}}) {
    INFO(unit);
    CHECK(si_unit(unit) == si);
    CHECK(to_si("1 " + si, units::any) == 1);
  }
  CHECK(si_unit("%") == "1");
  CHECK(to_si("1 " + si_unit("mN s"), units::any) == 1);
  CHECK_THROWS_AS(si_unit("mmm"), InputError);
}
