// Scene parameters: `parameters: {width: 20 mm, speed: 4 mm/s}`. An expression of parameters may
// replace any number of the scene ("2 * width", "width / speed + 0.1 s"), and formulas have them as
// variables.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/config/value.hpp"

namespace tack {

class Parameters {
 public:
  // No parameters.
  Parameters() = default;
  // Returns the parameters of a file, from its map `parameters`. Each may be an expression of
  // others. Throws InputError with the source location if `parameters` is no map, a name is not
  // usable in formulas, an expression cannot be evaluated, or parameters depend on each other in a
  // cycle.
  static Parameters of(const Value& root);

  bool empty() const { return numbers_.empty(); }
  // Returns true if `text` contains the name of a parameter.
  bool named_in(const std::string& text) const;
  // Returns the parameters in an expression that have no unit, each once, in their order.
  std::vector<std::string> unitless_in(const std::string& expression) const;
  // Evaluates an expression to a number in SI with its unit: "0.04 m". Throws InputError, without a
  // source location, for inconsistent dimensions (a length plus a time) or a result that is not
  // finite.
  std::string evaluated(const std::string& expression) const;
  // Returns the number `si` with the unit of parameter `name`, as in a file: "0.03 m".
  std::string like(const std::string& name, double si) const;
  // Returns the formula with parameter names replaced by numbers in SI. Names in `own`, the
  // formula's own parameters, stay. Throws InputError, without a source location, for a parameter
  // that is also one of `variables`.
  std::string inserted(const std::string& formula, const std::vector<std::string>& variables,
                       const Value* own) const;

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
