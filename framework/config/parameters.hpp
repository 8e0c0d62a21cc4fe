// Numbers of a scene with names of its own: `parameters: {width: 20 mm, speed: 4 mm/s}`. Wherever the scene has a number, it may have an expression of
// them ("2 * width", "width / speed + 0.1 s"), and formulas know them as variables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/value.hpp"

namespace tack {

class Parameters {
 public:
  // None.
  Parameters() = default;
  // Those of the map under `parameters` of a file; each may be an expression of others. Throws InputError with the place: no map, a name that formulas
  // could not have, an expression that cannot be evaluated, some that need each other.
  static Parameters of(const Value& root);

  bool empty() const { return numbers_.empty(); }
  // Whether one of their names stands in it.
  bool named_in(const std::string& text) const;
  // What an expression is, as a number in SI with its unit: "0.04 m". Throws InputError, without a place, for what has no dimension (a length and a time
  // added), or is no finite number.
  std::string evaluated(const std::string& expression) const;
  // Another number of the same dimension as a parameter, in SI, as a file would have it: "0.03 m".
  std::string like(const std::string& name, double si) const;
  // A formula with numbers, in SI, in the place of their names, but not of those that the formula has of its own. Throws InputError, without a place, for one
  // that is a variable of the formula as well.
  std::string inserted(const std::string& formula, const std::vector<std::string>& variables, const Value* own) const;

 private:
  struct Number {
    double si = 0;
    std::map<std::string, int> dimension;  // base_dimension
  };
  struct Written;
  std::vector<std::string> names() const;
  void settle(const Written& written, const std::string& name, std::vector<std::string>& open);
  Number number_of(const std::string& expression) const;

  std::map<std::string, Number> numbers_;
};

}  // namespace tack
