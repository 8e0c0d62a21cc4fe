#include "framework/config/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstring>
#include <numbers>

#include "framework/config/number_text.hpp"
#include "geometry/errors.hpp"

namespace tack {

namespace {

// Larger numbers have no finite square.
constexpr double largest_number = 1e150;

[[noreturn]] void refuse(const std::string& text, const std::vector<std::string>& variables, const std::string& why) {
  throw InputError(fmt::format("formula '{}': {}; variables: {}", text, why, fmt::join(variables, ", ")));
}

// Checks muParser's numbers: digits with a point and an exponent, except within names ("log10").
void check_numbers(const std::string& text, const std::vector<std::string>& variables) {
  const auto in_name = [](unsigned char c) { return std::isalpha(c) || c == '_'; };
  const auto digit = [](unsigned char c) { return std::isdigit(c) != 0; };
  for (size_t i = 0; i < text.size(); ++i) {
    if (in_name(text[i])) {
      while (i + 1 < text.size() && (in_name(text[i + 1]) || digit(text[i + 1]))) ++i;
    } else if (digit(text[i]) || text[i] == '.') {
      const auto [number, length] = number_text(std::string_view(text).substr(i));
      if (!(std::abs(number) <= largest_number))
        refuse(text, variables, fmt::format("{} is too large, at most {:g} may stand there (position {})",
                                            text.substr(i, length), largest_number, i));
      i += std::max<size_t>(length, 1) - 1;
    }
  }
}

// Checks for `=`, with which muParser assigns: "x = 1" would change x and always hold. Comparisons
// are ==, !=, <= and >=.
void check_assignments(const std::string& text, const std::vector<std::string>& variables) {
  for (size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '=') continue;
    const bool compares = (i > 0 && std::strchr("=!<>", text[i - 1])) || (i + 1 < text.size() && text[i + 1] == '=');
    if (!compares) refuse(text, variables, fmt::format("`=` would assign a value (position {}); did you mean `==`?", i));
  }
}

}  // namespace

struct Formula::Parser {
  mu::Parser parser;
  std::vector<double> values;  // muParser reads variables at their addresses
};

Formula::Formula(const std::string& text, const std::vector<std::string>& variables)
    : parser_(std::make_unique<Parser>()) {
  parser_->values.resize(variables.size());
  check_numbers(text, variables);
  check_assignments(text, variables);
  try {
    parser_->parser.DefineConst("pi", std::numbers::pi);
    for (size_t i = 0; i < variables.size(); ++i)
      parser_->parser.DefineVar(variables[i], &parser_->values[i]);
    parser_->parser.SetExpr(text);
    parser_->parser.Eval();  // parses
  } catch (const mu::Parser::exception_type& e) {
    refuse(text, variables, fmt::format("{} (position {})", e.GetMsg(), e.GetPos()));
  }
  // muParser would use the last result
  if (const int results = parser_->parser.GetNumResults(); results > 1)
    refuse(text, variables, fmt::format("a comma makes {} formulas of it; write numbers with a point, as 0.02", results));
}
bool Formula::knows(const std::string& name) {
  static const mu::Parser parser;
  return name == "pi" || parser.GetFunDef().contains(name) || parser.GetConst().contains(name);
}

Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::operator()(std::span<const double> values) const {
  std::copy(values.begin(), values.end(), parser_->values.begin());
  try {
    return parser_->parser.Eval();
  } catch (const mu::Parser::exception_type& e) {
    throw SimulationError(fmt::format("formula '{}': {}", parser_->parser.GetExpr(), e.GetMsg()));
  }
}

}  // namespace tack
