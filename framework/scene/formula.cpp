#include "framework/scene/formula.hpp"

#include <fmt/format.h>
#include <muParser.h>

#include <algorithm>
#include <numbers>

#include "geometry/errors.hpp"

namespace tack {

struct Formula::Parser {
  mu::Parser parser;
  std::vector<double> values;  // muParser reads variables from where they stand
};

Formula::Formula(const std::string& text, const std::vector<std::string>& variables)
    : parser_(std::make_unique<Parser>()) {
  parser_->values.resize(variables.size());
  try {
    parser_->parser.DefineConst("pi", std::numbers::pi);
    for (size_t i = 0; i < variables.size(); ++i)
      parser_->parser.DefineVar(variables[i], &parser_->values[i]);
    parser_->parser.SetExpr(text);
    parser_->parser.Eval();  // parses
  } catch (const mu::Parser::exception_type& e) {
    throw InputError(fmt::format("formula '{}': {} (position {}); variables: {}", text, e.GetMsg(),
                                 e.GetPos(), fmt::join(variables, ", ")));
  }
}
Formula::~Formula() = default;
Formula::Formula(Formula&&) noexcept = default;
Formula& Formula::operator=(Formula&&) noexcept = default;

double Formula::operator()(std::span<const double> values) const {
  std::copy(values.begin(), values.end(), parser_->values.begin());
  return parser_->parser.Eval();
}

}  // namespace tack
