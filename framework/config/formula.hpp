// A formula of named variables, as text: "0.1 * sin(2 * pi * t)". Operators and functions are those
// of muParser (https://beltoforion.de/en/muparser/features.php), and the constant pi.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace tack {

class Formula {
 public:
  // Throws InputError with the position in the text and the error there, but without a source
  // location. Errors are a syntax error, an assignment (`=` in place of `==`), a comma outside of a
  // function's arguments, a number above 1e150.
  Formula(const std::string& text, const std::vector<std::string>& variables);
  // Whether a name is that of a function or a constant of all formulas.
  static bool knows(const std::string& name);
  ~Formula();
  Formula(Formula&&) noexcept;
  Formula& operator=(Formula&&) noexcept;

  // One value per variable, in their order. Not for several threads at once.
  double operator()(std::span<const double> values) const;

 private:
  struct Parser;
  std::unique_ptr<Parser> parser_;
};

}  // namespace tack
