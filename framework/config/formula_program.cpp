#include "framework/config/formula_program.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <numbers>
#include <optional>
#include <string_view>

#include "framework/config/formula.hpp"
#include "framework/config/number_text.hpp"

namespace tack {

// Recursive descent, in the order of precedence of Formula: sums, products, signs, powers (from the right).
class FormulaProgram::Parser {
 public:
  Parser(const std::string& text, const std::vector<std::string>& variables, const std::map<std::string, double>& constants)
      : text_(text), variables_(variables), constants_(constants) {}

  void parse_into(FormulaProgram& program) {
    sum();
    skip();
    if (at_ < text_.size()) refuse(fmt::format("'{}' (position {}) is not among its operations", text_.substr(at_, 1), at_));
    program.operations_ = std::move(out_);
    program.constants_ = std::move(used_);
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InputError(fmt::format("formula '{}': {}; it may have + - * / ^, parentheses, exp, ln, sqrt, abs, sin, cos, tanh, min and max of two", text_, why));
  }
  void skip() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_]))) ++at_;
  }
  bool takes(char c) {
    skip();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }
  void emit(Operation o, int change) {
    depth_ += change;
    if (depth_ > depth_max) refuse("it is nested too deeply");
    out_.push_back(o);
  }
  // Replaces the operations from `from` on by a number if they have no variable.
  std::optional<double> constant(size_t from) const {
    if (std::any_of(out_.begin() + static_cast<std::ptrdiff_t>(from), out_.end(), [](const Operation& o) { return o.code == Code::variable; })) return std::nullopt;
    return number_of(from);
  }
  double number_of(size_t from) const;

  void sum() {
    product();
    for (;;) {
      if (takes('+')) product(), emit({Code::add}, -1);
      else if (takes('-')) product(), emit({Code::subtract}, -1);
      else return;
    }
  }
  void product() {
    sign();
    for (;;) {
      if (takes('*')) sign(), emit({Code::multiply}, -1);
      else if (takes('/')) sign(), emit({Code::divide}, -1);
      else return;
    }
  }
  void sign() {
    if (takes('-')) return sign(), emit({Code::negate}, 0);
    if (takes('+')) return sign();
    to_power();
  }
  void to_power() {
    operand();
    if (!takes('^')) return;
    const size_t from = out_.size();
    if (takes('-')) to_power(), emit({Code::negate}, 0);
    else takes('+'), to_power();
    if (const auto exponent = constant(from)) {
      out_.resize(from);
      emit({Code::power, -1, *exponent}, -1);
    } else {
      emit({Code::general_power}, -1);
    }
  }
  void operand() {
    if (takes('(')) return sum(), close();
    skip();
    if (at_ >= text_.size()) refuse("it ends too early");
    if (std::isdigit(static_cast<unsigned char>(text_[at_])) || text_[at_] == '.') {
      const auto [number, length] = number_text(std::string_view(text_).substr(at_));
      at_ += std::max<size_t>(length, 1);
      return emit({Code::number, -1, number}, 1);
    }
    const size_t begin = at_;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_')) ++at_;
    const std::string name = text_.substr(begin, at_ - begin);
    if (name.empty()) refuse(fmt::format("'{}' (position {}) is not among its operations", text_.substr(at_, 1), at_));
    if (takes('(')) return function(name);
    if (const auto found = std::find(variables_.begin(), variables_.end(), name); found != variables_.end())
      return emit({Code::variable, static_cast<int>(found - variables_.begin())}, 1);
    if (const auto found = constants_.find(name); found != constants_.end()) return used_.insert(name), emit({Code::number, -1, found->second}, 1);
    if (name == "pi") return emit({Code::number, -1, std::numbers::pi}, 1);
    refuse(fmt::format("'{}' is unknown", name));
  }
  void function(const std::string& name) {
    static const std::map<std::string, Code> of_one = {{"exp", Code::exp}, {"ln", Code::log}, {"log", Code::log}, {"sqrt", Code::sqrt}, {"abs", Code::abs},
                                                       {"sin", Code::sin}, {"cos", Code::cos}, {"tanh", Code::tanh}};
    static const std::map<std::string, Code> of_two = {{"min", Code::min}, {"max", Code::max}};
    sum();
    if (const auto found = of_one.find(name); found != of_one.end()) return close(), emit({found->second}, 0);
    const auto found = of_two.find(name);
    if (found == of_two.end()) refuse(fmt::format("the function '{}' has no derivatives here", name));
    if (!takes(',')) refuse(fmt::format("'{}' takes two arguments", name));
    sum();
    close();
    emit({found->second}, -1);
  }
  void close() {
    if (!takes(')')) refuse(fmt::format("')' is missing at position {}", at_));
  }

  const std::string& text_;
  const std::vector<std::string>& variables_;
  const std::map<std::string, double>& constants_;
  std::vector<Operation> out_;
  std::set<std::string> used_;  // constants
  size_t at_ = 0;
  int depth_ = 0;
};

namespace {

// Plain numbers as the programs of exponents need them.
struct Number {
  double v = 0;
  Number() = default;
  explicit Number(double value) : v(value) {}
  friend Number operator+(Number a, Number b) { return Number(a.v + b.v); }
  friend Number operator-(Number a, Number b) { return Number(a.v - b.v); }
  friend Number operator*(Number a, Number b) { return Number(a.v * b.v); }
  friend Number operator/(Number a, Number b) { return Number(a.v / b.v); }
  friend Number exp(Number a) { return Number(std::exp(a.v)); }
  friend Number log(Number a) { return Number(std::log(a.v)); }
  friend Number sqrt(Number a) { return Number(std::sqrt(a.v)); }
  friend Number abs(Number a) { return Number(std::abs(a.v)); }
  friend Number sin(Number a) { return Number(std::sin(a.v)); }
  friend Number cos(Number a) { return Number(std::cos(a.v)); }
  friend Number tanh(Number a) { return Number(std::tanh(a.v)); }
  friend Number min(Number a, Number b) { return Number(std::min(a.v, b.v)); }
  friend Number max(Number a, Number b) { return Number(std::max(a.v, b.v)); }
  friend Number power(Number a, double b) { return Number(std::pow(a.v, b)); }
};

}  // namespace

double FormulaProgram::Parser::number_of(size_t from) const {
  FormulaProgram program("0", {}, {});
  program.operations_.assign(out_.begin() + static_cast<std::ptrdiff_t>(from), out_.end());
  return program(static_cast<const Number*>(nullptr)).v;
}

FormulaProgram::FormulaProgram(const std::string& text, const std::vector<std::string>& variables, const std::map<std::string, double>& constants) {
  std::vector<std::string> names = variables;
  for (const auto& [name, value] : constants) names.push_back(name);
  static_cast<void>(Formula(text, names));  // its errors name positions
  Parser(text, variables, constants).parse_into(*this);
}

bool FormulaProgram::uses(int variable) const {
  return std::any_of(operations_.begin(), operations_.end(), [&](const Operation& o) { return o.code == Code::variable && o.variable == variable; });
}

}  // namespace tack
