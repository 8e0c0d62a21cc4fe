// A formula of named variables: "0.1 * sin(2 * pi * t)". Operators, functions and the constant pi
// are those of muParser (https://beltoforion.de/en/muparser/features.php).
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tack {

class Formula {
 public:
  // Throws InputError with the position in the text, without a source location, for a syntax error,
  // an assignment (`=` in place of `==`), a comma outside of a function's arguments, and a number
  // above 1e150.
  Formula(const std::string& text, const std::vector<std::string>& variables);
  // Returns true for the name of a function or constant of all formulas.
  static bool knows(const std::string& name);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  // Evaluates the formula. values: one per variable, in their order. Not thread-safe.
  double operator()(std::span<const double> values) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace tack
