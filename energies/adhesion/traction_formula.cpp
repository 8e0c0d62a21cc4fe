#include "energies/adhesion/traction_formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "framework/config/formula.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double largest_error = 1e-3;  // relative; a larger error indicates a jump

bool in_names(char c) { return c == '_' || std::isalnum(static_cast<unsigned char>(c)); }

bool is_name(const std::string& text) {
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front())) && std::all_of(text.begin(), text.end(), in_names);
}

bool has_name(const std::string& text, const std::string& name) {
  for (size_t at = text.find(name); at != text.npos; at = text.find(name, at + 1)) {
    const bool begins = at == 0 || !in_names(text[at - 1]), ends = at + name.size() == text.size() || !in_names(text[at + name.size()]);
    if (begins && ends) return true;
  }
  return false;
}

// Between knots, an energy that jumps has a derivative.
double energy_error(const CubicCurve& curve, const std::function<double(double)>& energy) {
  constexpr int checks = 1000;
  const double end = energy(curve.last());
  double error = 0, largest = 0;
  for (int i = 0; i < checks; ++i) {
    const double d = curve.last() * i / checks, exact = energy(d) - end;
    largest = std::max(largest, std::abs(exact));
    error = std::max(error, std::abs(exact + curve.at(d).rest));
  }
  return largest > 0 ? error / largest : 0;
}

}  // namespace

void TractionFormula::fields(Fields& f) {
  f.text("traction", traction, "a formula of the gap d [m] and the parameters: the traction [Pa], positive where it pulls: `s * d / l * exp(1 - d / l)`").formula({"d"});
  f.text("energy", energy, "instead of traction: the energy per area [J/m^2], whose derivative is the traction; an added constant has no effect").formula({"d"});
  f.quantities("parameters", parameters, "parameters of the formula with values in any unit: `{s: 3 kPa, l: 0.2 mm}`; the formula has them in SI");
  f.number("range", range, units::length, "gap beyond which nothing adheres").required().positive();
  f.check("traction", [this]() -> std::string {
    if (traction.empty() != energy.empty()) return "";
    return traction.empty() ? "give the law as traction or as energy, a formula in the gap d" : "goes without energy: drop one of them";
  });
  f.check("parameters", [this] { return check_parameters(); });
  f.check("energy", [this]() -> std::string { return traction.empty() && !energy.empty() ? check_formula() : ""; });
  f.check("traction", [this]() -> std::string { return energy.empty() && !traction.empty() ? check_formula() : ""; });
}

std::vector<std::string> TractionFormula::variables() const {
  std::vector<std::string> names = {"d"};
  for (const auto& [name, quantity] : parameters)
    if (is_name(name) && name != "d") names.push_back(name);
  return names;
}

std::string TractionFormula::check_formula() const {
  try {
    static_cast<void>(Formula(text(), variables()));
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

std::string TractionFormula::check_parameters() const {
  for (const auto& [name, quantity] : parameters) {
    if (!is_name(name)) return fmt::format("'{}' cannot stand in a formula; names are of letters, digits and _", name);
    if (name == "d" || name == "pi") return fmt::format("'{}' is {} already; take another name", name, name == "d" ? "the gap" : "3.14159");
    if (!has_name(text(), name)) return fmt::format("'{}' does not occur in the formula '{}'; take it out, or mend one of them", name, text());
  }
  return "";
}

AdaptiveCurve TractionFormula::sample() const {
  const char* what = traction.empty() ? "energy" : "traction";
  const Formula formula(text(), variables());
  std::vector<double> values = {0};
  for (const std::string& name : variables())
    if (name != "d") values.push_back(parameters.at(name).si);
  const auto function = [&](double d) {
    values[0] = d;
    const double value = formula(values);
    if (!std::isfinite(value) || std::abs(value) > 1e100)
      throw InputError(fmt::format("{}: '{}' is {:.4g} at d = {:.6g} m, and has to be finite from 0 to its range; write max(d, 1e-6), say, where it divides by d",
                                   what, text(), value, d));
    return value;
  };
  AdaptiveCurve sampled = traction.empty() ? adaptive_derivative(function, 0, range) : adaptive_curve(function, 0, range);
  if (sampled.error > largest_error)
    throw InputError(fmt::format("{}: '{}' gives a traction that jumps between d = {:.6g} and {:.6g} m (or changes faster than {} knots follow), from {:.4g} to "
                                 "{:.4g} Pa; spread that over a length, as min and max do", what, text(), sampled.worst_from, sampled.worst_to,
                                 AdaptiveCurve::most_knots, sampled.curve.at(sampled.worst_from).value, sampled.curve.at(sampled.worst_to).value));
  if (traction.empty()) {
    const double error = energy_error(sampled.curve, function);
    if (error > largest_error)
      throw InputError(fmt::format("energy: '{}' jumps: the integral of its derivative is off by {:.2g}% of it; let it be continuous", text(), 100 * error));
    sampled.error = std::max(sampled.error, error);
  }
  return sampled;
}

}  // namespace tack
