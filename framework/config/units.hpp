// Numbers with units. A parameter has one SI unit. A scene file may use any unit of the same
// dimension ("5 MPa", "1.2 g/cm^3", "30 deg", "10 %"); a number without unit is SI.
#pragma once

#include <map>
#include <string>
#include <string_view>

namespace tack {

struct Unit {
  std::string_view si;        // "Pa"; "1" for plain numbers
  std::string_view quantity;  // "pressure", for messages

  bool plain() const { return si == "1"; }
};

namespace units {

inline constexpr Unit none{"1", "number"};
inline constexpr Unit angle{"rad", "angle"};
inline constexpr Unit length{"m", "length"};
inline constexpr Unit area{"m^2", "area"};
inline constexpr Unit volume{"m^3", "volume"};
inline constexpr Unit curvature{"1/m", "curvature"};
inline constexpr Unit time{"s", "time"};
inline constexpr Unit frequency{"Hz", "frequency"};
inline constexpr Unit rate{"1/s", "rate"};
inline constexpr Unit angular_velocity{"rad/s", "angular velocity"};
inline constexpr Unit velocity{"m/s", "velocity"};
inline constexpr Unit acceleration{"m/s^2", "acceleration"};
inline constexpr Unit mass{"kg", "mass"};
inline constexpr Unit density{"kg/m^3", "density"};
inline constexpr Unit area_density{"kg/m^2", "mass per area"};
inline constexpr Unit line_density{"kg/m", "mass per length"};
inline constexpr Unit force{"N", "force"};
inline constexpr Unit stiffness{"N/m", "stiffness"};
inline constexpr Unit work_of_adhesion{"J/m^2", "work of adhesion"};
inline constexpr Unit pressure{"Pa", "pressure"};
inline constexpr Unit traction_stiffness{"Pa/m", "traction per length"};
inline constexpr Unit energy{"J", "energy"};
inline constexpr Unit moment{"N m", "moment"};
inline constexpr Unit viscosity{"Pa s", "viscosity"};
inline constexpr Unit surface_viscosity{"J s/m^2", "viscosity of a surface"};
inline constexpr Unit fluidity{"1/(Pa s)", "rate per pressure"};
inline constexpr Unit power{"W", "power"};
// Accepts any unit and converts to the SI unit of its dimension, for numbers whose dimension is
// checked later.
inline constexpr Unit any{"", "number with its unit"};

}  // namespace units

// Returns the SI value of "5 MPa". Throws InputError, without a source location, for a text that is
// no finite number, an unknown unit or a wrong dimension: "expects a pressure (Pa), got '5 mm',
// which is a length". Thread-safe.
double to_si(std::string_view text, const Unit& unit);

// Returns the SI unit of a product: "N m"; with a plain number, the other unit.
std::string product_unit(const Unit& a, const Unit& b);

// Returns the SI unit of the same dimension as parameters have it: "N" for "mN", "Pa" for "N/mm^2".
// Throws as to_si does.
std::string si_unit(const std::string& unit);

// Returns the exponents of the base units: {m: 1, s: -2} for "mm/s^2"; radians have none. Throws as
// to_si does.
std::map<std::string, int> base_dimension(const std::string& unit);

std::string unit_noun(const Unit& unit);         // "pressure (Pa)"
std::string unit_noun_plural(const Unit& unit);  // "pressures (Pa)"

}  // namespace tack
