// A factor over time, by points or by a formula.
#pragma once

#include <optional>
#include <vector>

#include "framework/config/formula.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {

struct Ramp {
  Schedule ramp = 1.0;
  std::string text;

  void fields(Fields& f, const std::string& key, const std::string& doc) {
    f.schedule(key, ramp, units::none, doc + ": a number or [[t, factor], ...]");
    f.text(key + "_formula", text, "additional factor, a formula of the time t [s]");
    f.check(key + "_formula", [this]() -> std::string {
      formula_.reset();
      if (text.empty()) return "";
      try {
        formula_.emplace(text, std::vector<std::string>{"t"});
        return "";
      } catch (const InputError& error) {
        return error.what();
      }
    });
  }
  std::vector<double> corners() const { return ramp.corners(); }
  double at(double t) const {
    const double by_points = ramp.at(t);
    return formula_ ? by_points * (*formula_)(std::array{t}) : by_points;
  }

 private:
  std::optional<Formula> formula_;
};

}  // namespace tack
