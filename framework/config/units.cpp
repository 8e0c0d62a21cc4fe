#include "framework/config/units.hpp"

#include <fmt/format.h>
#include <udunits2.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>

#include "framework/config/thermal_units.hpp"
#include "framework/config/words.hpp"
#include "geometry/errors.hpp"
#include "geometry/own_library.hpp"
#include "geometry/plain_numbers.hpp"

namespace tack {
namespace {

struct FreeUnit {
  void operator()(ut_unit* u) const { ut_free(u); }
};
struct FreeConverter {
  void operator()(cv_converter* c) const { cv_free(c); }
};
struct FreeSystem {
  void operator()(ut_system* s) const { ut_free_system(s); }
};
using UnitPtr = std::unique_ptr<ut_unit, FreeUnit>;
using ConverterPtr = std::unique_ptr<cv_converter, FreeConverter>;
using SystemPtr = std::unique_ptr<ut_system, FreeSystem>;

// Nouns for wrongly used units; the first of equal dimensions counts.
constexpr std::array named_dimensions{units::length,
                                      units::area,
                                      units::volume,
                                      units::curvature,
                                      units::time,
                                      units::frequency,
                                      units::velocity,
                                      units::acceleration,
                                      units::mass,
                                      units::density,
                                      units::force,
                                      units::pressure,
                                      units::energy,
                                      units::viscosity,
                                      units::surface_viscosity,
                                      units::fluidity,
                                      units::power,
                                      units::area_density,
                                      units::line_density,
                                      units::stiffness,
                                      units::traction_stiffness,
                                      units::temperature,
                                      units::molar_energy};

// Lock of the units library, whose parser has global state and reads numbers by the locale. Every
// call below holds one.
class UnitsLock {
 public:
  UnitsLock() : lock_(mutex()) {}

 private:
  static std::mutex& mutex() {
    static std::mutex mutex;
    return mutex;
  }
  std::scoped_lock<std::mutex> lock_;
  PlainNumbers plain_;
};

// Returns the path of the unit database of this installation, or "" if the library finds another:
// that of the environment variable, or of the system.
std::string own_database() {
  std::error_code none;
  const std::string path = shared_file("udunits/udunits2.xml").string();
  return !std::getenv("UDUNITS2_XML_PATH") && std::filesystem::exists(path, none) ? path : "";
}

ut_system* unit_system() {
  static const SystemPtr system = [] {
    ut_set_error_message_handler(ut_ignore);
    const std::string database = own_database();
    SystemPtr s(ut_read_xml(database.empty() ? nullptr : database.c_str()));
    if (!s) {
      throw InputError(
          "the unit database udunits2.xml cannot be read; install libudunits2-data, "
          "set UDUNITS2_XML_PATH, or write plain SI numbers");
    }
    const UnitPtr degree(ut_get_unit_by_name(s.get(), "arc_degree"));  // the database lacks "deg"
    ut_map_name_to_unit("deg", UT_UTF8, degree.get());
    return s;
  }();
  return system.get();
}

UnitPtr parse_unit(std::string_view text) {
  return UnitPtr(ut_parse(unit_system(), std::string(text).c_str(), UT_UTF8));
}

// Returns true if the quotient is dimensionless. The library's own test would also accept
// reciprocals (s and Hz).
bool same_dimension(ut_unit* a, ut_unit* b) {
  const UnitPtr quotient(ut_divide(a, b));
  return quotient && ut_is_dimensionless(quotient.get());
}

std::string dimension_name(ut_unit* unit) {
  const UnitPtr one = parse_unit("1");
  if (same_dimension(unit, one.get())) {
    std::array<char, 64> definition{};
    ut_format(unit, definition.data(), definition.size() - 1, UT_DEFINITION);
    const bool is_angle = std::string_view(definition.data()).find("rad") != std::string_view::npos;
    return is_angle ? "angle" : "number";
  }
  for (const Unit& known : named_dimensions) {
    const UnitPtr known_unit = parse_unit(known.si);
    if (same_dimension(unit, known_unit.get())) return std::string(known.quantity);
  }
  return "quantity of another dimension";
}

// Returns true if digits occur only in exponents ("m^2", "m2", "s-1", "s^-1") or in the numerator
// of "1/s". The library would also read factors ("3 m"), offsets and dates.
bool only_exponents(std::string_view unit) {
  if (unit.substr(0, 2) == "1/") unit.remove_prefix(2);
  char before = ' ';  // the last character that is neither a digit nor a minus
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const unsigned char c = static_cast<unsigned char>(unit[i]);
    const bool letter = std::isalpha(c) || c >= 0x80 || c == '%';
    const bool number = std::isdigit(c) || c == '-';
    if (number && !(std::isalpha(static_cast<unsigned char>(before)) || before == '^'))
      return false;
    if (!letter && !number && std::string_view(" /^*.()").find(unit[i]) == std::string_view::npos) {
      return false;
    }
    if (!number) before = unit[i];
  }
  return true;
}

[[noreturn]] void fail(std::string_view text, const Unit& unit, std::string_view why) {
  throw InputError(fmt::format("expects {}, got '{}'{}", with_article(unit_noun(unit)), text, why));
}

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.front()))) s.remove_prefix(1);
  while (!s.empty() && std::isspace(static_cast<unsigned char>(s.back()))) s.remove_suffix(1);
  return s;
}

// Returns the SI unit of the same dimension: the definition in base units without its factor.
UnitPtr coherent(ut_unit* unit) {
  std::array<char, 256> definition{};
  if (ut_format(unit, definition.data(), definition.size() - 1, UT_ASCII | UT_DEFINITION) < 0) return nullptr;
  double factor = 1;
  const char* end = definition.data() + definition.size();
  const auto [rest, status] = std::from_chars(definition.data(), end, factor);
  const std::string_view base = status == std::errc() ? trimmed(rest) : definition.data();
  return parse_unit(base.empty() ? "1" : base);
}

// Units often written with wrong capitals. Of two that differ only in capitals, the larger is
// meant.
constexpr std::array suggested_units = {"Pa", "kPa", "MPa", "GPa", "mm", "um", "nm", "cm", "km", "m", "s", "ms", "us", "min", "h", "N", "mN", "kN", "MN",
                                    "kg", "g", "mg", "J", "mJ", "kJ", "W", "Hz", "kHz", "deg", "rad", "K"};

// Returns "; did you mean 'MPa'?" for 'MPA', "; write numbers with a point" for ',1 MPa', ""
// otherwise.
std::string meant_by(std::string_view unit) {
  if (unit.size() > 1 && unit[0] == ',' && std::isdigit(static_cast<unsigned char>(unit[1]))) return "; write numbers with a point, as 0.1";
  const auto letter = [](char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; };
  const auto lower = [](std::string_view word) {
    std::string text(word);
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
  };
  std::string better;
  for (std::size_t i = 0; i < unit.size();) {
    std::size_t end = i;
    while (end < unit.size() && letter(unit[end])) ++end;
    const std::string_view word = unit.substr(i, std::max<std::size_t>(end - i, 1));
    const auto usual = std::find_if(suggested_units.begin(), suggested_units.end(), [&](const char* u) { return lower(u) == lower(word); });
    better += usual != suggested_units.end() && !parse_unit(word) ? std::string_view(*usual) : word;
    i += word.size();
  }
  return better != unit && only_exponents(better) && parse_unit(better) ? fmt::format("; did you mean '{}'?", better) : "";
}

double convert(double number, std::string_view unit_text, std::string_view text, const Unit& unit) {
  const UnitsLock lock;
  const UnitPtr from = only_exponents(unit_text) ? parse_unit(unit_text) : nullptr;
  if (!from) fail(text, unit, fmt::format("; '{}' is no known unit{}", unit_text, meant_by(unit_text)));
  const UnitPtr to = unit.si.empty() ? coherent(from.get()) : parse_unit(unit.si);
  if (!to || !same_dimension(from.get(), to.get())) {
    const bool weighed = dimension_name(from.get()) == "mass" && unit.si == units::force.si;
    fail(text, unit, ", which is " + with_article(dimension_name(from.get())) + (weighed ? "; grams and kilograms of force are gf and kgf" : ""));
  }
  const ConverterPtr converter(ut_get_converter(from.get(), to.get()));
  if (!converter) fail(text, unit, fmt::format("; '{}' cannot be converted", unit_text));
  return cv_convert_double(converter.get(), number);
}

}  // namespace

double to_si(std::string_view text, const Unit& unit) {
  std::string_view rest = trimmed(text);
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
  double number = 0;
  const auto [stop, status] = std::from_chars(rest.data(), rest.data() + rest.size(), number);
  if (status == std::errc::result_out_of_range) fail(text, unit, ", which is out of range");
  if (status != std::errc()) fail(text, unit, "");
  if (!std::isfinite(number)) fail(text, unit, ", which is not finite");
  const auto used = static_cast<std::size_t>(stop - rest.data());
  const std::string_view unit_text = trimmed(rest.substr(used));
  if (unit_text.empty()) return number;
  const double si = convert(number, unit_text, text, unit);
  if (!std::isfinite(si)) fail(text, unit, ", which is out of range");
  return si;
}

std::string si_unit(const std::string& unit) {
  if (to_si("1 " + unit, units::any) == 1 && to_si("0 " + unit, units::any) == 0) return unit;
  const UnitsLock lock;
  const UnitPtr given = parse_unit(unit);
  for (const Unit& known : named_dimensions) {
    const UnitPtr known_unit = parse_unit(known.si);
    if (same_dimension(given.get(), known_unit.get())) return std::string(known.si);
  }
  if (same_dimension(given.get(), parse_unit("1").get())) return std::string(dimension_name(given.get()) == "angle" ? units::angle.si : units::none.si);
  std::array<char, 256> text{};
  const UnitPtr base = coherent(given.get());
  if (!base || ut_format(base.get(), text.data(), text.size() - 1, UT_ASCII) < 0) return unit;
  return text.data();
}

std::map<std::string, int> base_dimension(const std::string& unit) {
  if (unit.empty() || unit == "1") return {};
  to_si("1 " + unit, units::any);
  const UnitsLock lock;
  const UnitPtr given = parse_unit(unit), base = coherent(given.get());
  std::array<char, 256> text{};
  if (!base || ut_format(base.get(), text.data(), text.size() - 1, UT_ASCII | UT_DEFINITION) < 0) return {};
  // "m.kg.s-2"
  std::map<std::string, int> exponents;
  std::string_view rest = text.data();
  while (!rest.empty()) {
    const std::string_view factor = rest.substr(0, rest.find('.'));
    rest.remove_prefix(std::min(factor.size() + 1, rest.size()));
    const std::size_t name = std::min(factor.find_first_of("-0123456789^"), factor.size());
    int exponent = 1;
    if (name < factor.size()) std::from_chars(factor.data() + name + (factor[name] == '^'), factor.data() + factor.size(), exponent);
    if (name > 0 && factor.substr(0, name) != "rad") exponents[std::string(factor.substr(0, name))] += exponent;
  }
  return exponents;
}

std::string product_unit(const Unit& a, const Unit& b) {
  if (a.plain()) return std::string(b.si);
  const auto factor = [](std::string_view unit) { return unit.find('/') == unit.npos ? std::string(unit) : fmt::format("({})", unit); };
  return b.plain() ? std::string(a.si) : fmt::format("{} {}", factor(a.si), factor(b.si));
}

std::string unit_noun(const Unit& unit) {
  return unit.plain() || unit.si.empty() ? std::string(unit.quantity) : fmt::format("{} ({})", unit.quantity, unit.si);
}

std::string unit_noun_plural(const Unit& unit) {
  if (unit.si.empty()) return "numbers with their units";
  return unit.plain() ? plural(unit.quantity)
                      : fmt::format("{} ({})", plural(unit.quantity), unit.si);
}

}  // namespace tack
