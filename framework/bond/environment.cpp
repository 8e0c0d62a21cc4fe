#include "framework/bond/environment.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "framework/config/thermal_units.hpp"
#include "geometry/errors.hpp"

namespace tack {

void Environment::fields(Fields& f) {
  f.schedule("temperature", temperature_, units::temperature, "temperature of everything that depends on it").positive();
  f.text("profile", profile_, "formula of the time t [s], the position at rest x, y, z [m] and the parameters: temperature that is added [K]").formula({"t", "x", "y", "z"});
  f.quantities("parameters", parameters_, "parameters of the profile, with their units");
  f.check("profile", [this] { return compile(); });
}

std::string Environment::compile() {
  compiled_.reset();
  if (profile_.empty()) return parameters_.empty() ? "" : "is not given, and `parameters` are for it: add it, or take them away";
  std::vector<std::string> variables{"t", "x", "y", "z"};
  for (const auto& [name, value] : parameters_) {
    if (name == "pi" || std::find(variables.begin(), variables.end(), name) != variables.end()) return fmt::format("the parameter '{}' is something else in formulas already; take another name", name);
    variables.push_back(name);
  }
  try {
    compiled_.emplace(profile_, variables);
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

double Environment::temperature(double time, const Vec3& rest_position) const {
  double kelvin = temperature_.at(time);
  if (compiled_) {
    std::vector<double> values{time, rest_position.x(), rest_position.y(), rest_position.z()};
    for (const auto& [name, value] : parameters_) values.push_back(value);
    kelvin += (*compiled_)(values);
  }
  if (kelvin > 0 && kelvin < 1e6) return kelvin;
  throw SimulationError(fmt::format("the temperature is {:.6g} K at t = {:.6g} s, ({:.6g}, {:.6g}, {:.6g}) m at rest: environment.temperature and profile have to add up to one above zero", kelvin, time,
                                    rest_position.x(), rest_position.y(), rest_position.z()));
}

}  // namespace tack
