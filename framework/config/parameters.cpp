#include "framework/config/parameters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <vector>

#include "framework/config/formula.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/number_text.hpp"
#include "framework/config/units.hpp"
#include "framework/config/written_number.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool begins_name(char c) { return std::isalpha(static_cast<unsigned char>(c)) || c == '_'; }
bool in_name(char c) { return begins_name(c) || std::isdigit(static_cast<unsigned char>(c)); }

size_t end_of_name(const std::string& text, size_t at) {
  while (at < text.size() && in_name(text[at])) ++at;
  return at;
}

// Returns the position after the number at `at`.
size_t end_of_number(const std::string& text, size_t at) {
  return at + number_text(std::string_view(text).substr(at)).length;
}

bool begins_number(const std::string& text, size_t at) {
  const auto digit = [&](size_t i) { return i < text.size() && std::isdigit(static_cast<unsigned char>(text[i])); };
  return digit(at) || (text[at] == '.' && digit(at + 1));
}

// A token of an expression: a name, a number with its unit, or another character.
struct Token {
  enum Kind { name, number, other } kind;
  std::string text;  // a number without its unit
  std::string unit = "";
};

// Returns the end of the unit after a number: "mm", "m/s^2", "kg m^-1 s^-2", "%". A known name
// after a slash ends the unit, because it is a divisor: "4 mm / width".
template <class Known>
size_t end_of_unit(const std::string& text, size_t at, const Known& known) {
  size_t start = at;
  while (start < text.size() && text[start] == ' ') ++start;
  if (start == text.size()) return at;
  if (text[start] == '%') return start + 1;
  const auto word = [&](size_t from) {
    size_t end = from;
    while (end < text.size() && (std::isalpha(static_cast<unsigned char>(text[end])) || static_cast<unsigned char>(text[end]) >= 0x80)) ++end;
    return end;
  };
  size_t end = word(start);
  if (end == start || (end < text.size() && text[end] == '(')) return at;
  const auto exponent = [&] {
    size_t from = end + (end < text.size() && text[end] == '^');
    if (from < text.size() && text[from] == '-') ++from;
    size_t to = from;
    while (to < text.size() && std::isdigit(static_cast<unsigned char>(text[to]))) ++to;
    if (to > from) end = to;
  };
  exponent();
  // A word after a point or space belongs to the unit, because no expression has a name there. A
  // word after a slash belongs to the unit unless it is a parameter.
  for (;;) {
    size_t from = end;
    while (from < text.size() && text[from] == ' ') ++from;
    const bool divides = from < text.size() && text[from] == '/';
    if (divides || (from < text.size() && text[from] == '.')) ++from;
    else if (from == end) return end;
    while (from < text.size() && text[from] == ' ') ++from;
    const size_t next = word(from);
    if (next == from || (divides && known(text.substr(from, end_of_name(text, from) - from))) || (next < text.size() && text[next] == '(')) return end;
    end = next;
    exponent();
  }
}

template <class Known>
std::vector<Token> tokens_of(const std::string& text, const Known& known) {
  std::vector<Token> tokens;
  for (size_t at = 0; at < text.size();) {
    if (begins_name(text[at])) {
      const size_t end = end_of_name(text, at);
      tokens.push_back({Token::name, text.substr(at, end - at)});
      at = end;
    } else if (begins_number(text, at)) {
      const size_t end = end_of_number(text, at), unit = end_of_unit(text, end, known);
      size_t start = end;
      while (start < unit && text[start] == ' ') ++start;
      tokens.push_back({Token::number, text.substr(at, end - at), text.substr(start, unit - start)});
      at = unit;
    } else {
      tokens.push_back({Token::other, std::string(1, text[at++])});
    }
  }
  return tokens;
}

// Returns the exponent of a base unit in a formula, from the ratio of its values when that unit is
// scaled.
std::optional<int> exponent_of(const Formula& formula, const std::vector<double>& values, const std::vector<int>& exponents) {
  const double before = formula(values);
  std::optional<int> found;
  for (const double larger : {2.0, 3.0}) {
    std::vector<double> scaled = values;
    for (size_t i = 0; i < values.size(); ++i) scaled[i] /= std::pow(larger, exponents[i]);
    const double e = -std::log(formula(scaled) / before) / std::log(larger), whole = std::round(e);
    if (!(std::abs(e - whole) < 1e-6) || (found && *found != static_cast<int>(whole))) return std::nullopt;
    found = static_cast<int>(whole);
  }
  return found;
}

// Builds the formula of an expression, in which numbers with units have become variables. Messages
// show the expression as it is written.
Formula formula_of(const std::string& expression, const std::string& text, const std::vector<std::string>& variables) {
  try {
    return Formula(text, variables);
  } catch (const InputError& error) {
    std::string message = error.what();
    if (const size_t at = message.find("'" + text + "'"); at != message.npos) message.replace(at + 1, text.size(), expression);
    if (message.find("_number_") != message.npos) message.resize(std::min(message.find("; variables: "), message.size()));
    throw InputError(message);
  }
}

std::string text_of(double si, const std::map<std::string, int>& dimension) {
  std::string text = Value::number(si).text;
  for (const auto& [base, exponent] : dimension)
    if (exponent != 0) text += fmt::format(" {}{}", base, exponent == 1 ? "" : fmt::format("^{}", exponent));
  return text;
}

}  // namespace

struct Parameters::Written : std::map<std::string, const Value*> {};

bool Parameters::named_in(const std::string& text) const {
  if (numbers_.empty()) return false;
  const auto known = [this](const std::string& name) { return numbers_.contains(name); };
  const std::vector<Token> tokens = tokens_of(text, known);
  try {  // numbers with units stay numbers
    to_si(text, units::any);
    return false;
  } catch (const InputError&) {
  }
  return std::any_of(tokens.begin(), tokens.end(), [&](const Token& token) { return token.kind == Token::name && known(token.text); });
}

Parameters::Number Parameters::number_of(const std::string& expression) const {
  // A number with its unit stays one, whatever the names of parameters.
  if (const std::optional<WrittenNumber> written = written_number(expression)) return {written->si, base_dimension(written->unit)};
  const auto known = [this](const std::string& name) { return numbers_.contains(name); };
  std::string text;
  std::vector<std::string> variables;
  std::vector<double> values;
  std::vector<std::map<std::string, int>> dimensions;
  const auto add = [&](const std::string& name, const Number& number) {
    text += name;
    if (std::find(variables.begin(), variables.end(), name) != variables.end()) return;
    variables.push_back(name);
    values.push_back(number.si);
    dimensions.push_back(number.dimension);
  };
  for (const Token& token : tokens_of(expression, known)) {
    if (token.kind == Token::name && known(token.text)) add(token.text, numbers_.at(token.text));
    else if (token.kind == Token::number && !token.unit.empty())
      add(fmt::format("_number_{}", variables.size()), {to_si(token.text + " " + token.unit, units::any), base_dimension(token.unit)});
    else if (token.kind == Token::name && !Formula::knows(token.text))
      throw InputError(fmt::format("'{}' is no parameter{}", token.text, suggestion(token.text, names(), "parameters")));
    else text += token.text;
  }
  const Formula formula = formula_of(expression, text, variables);
  Number number{formula(values), {}};
  if (!std::isfinite(number.si)) throw InputError(fmt::format("'{}' is {}", expression, number.si));

  // The dimension does not depend on the numbers; other numbers show it where these give zero.
  if (number.si == 0)
    for (size_t i = 0; i < values.size(); ++i) values[i] = (values[i] == 0 ? 1 : values[i]) * (1.3 + 0.17 * static_cast<double>(i));
  for (const auto& dimension : dimensions)
    for (const auto& [base, exponent] : dimension) number.dimension[base] = 0;
  for (auto& [base, exponent] : number.dimension) {
    std::vector<int> exponents;
    for (const auto& dimension : dimensions) {
      const auto there = dimension.find(base);
      exponents.push_back(there == dimension.end() ? 0 : there->second);
    }
    const std::optional<int> found = exponent_of(formula, values, exponents);
    if (!found)
      throw InputError(fmt::format("'{}' has no unit: what it adds, compares or takes functions of has different ones in {}; numbers in it need their units, as in `width + 2 mm`",
                                   expression, base));
    exponent = *found;
  }
  return number;
}

std::vector<std::string> Parameters::unitless_in(const std::string& expression) const {
  std::vector<std::string> found;
  const auto known = [this](const std::string& name) { return numbers_.contains(name); };
  for (const Token& token : tokens_of(expression, known)) {
    if (token.kind != Token::name || !known(token.text) || std::find(found.begin(), found.end(), token.text) != found.end()) continue;
    const auto& dimension = numbers_.at(token.text).dimension;
    if (std::all_of(dimension.begin(), dimension.end(), [](const auto& of_base) { return of_base.second == 0; })) found.push_back(token.text);
  }
  return found;
}

std::vector<std::string> Parameters::names() const {
  std::vector<std::string> all;
  for (const auto& [name, number] : numbers_) all.push_back(name);
  return all;
}

std::string Parameters::evaluated(const std::string& expression) const {
  const Number number = number_of(expression);
  return text_of(number.si, number.dimension);
}

std::string Parameters::like(const std::string& name, double si) const { return text_of(si, numbers_.at(name).dimension); }

std::string Parameters::inserted(const std::string& formula, const std::vector<std::string>& variables, const Value* own) const {
  const auto taken = [&](const std::string& name) { return std::find(variables.begin(), variables.end(), name) != variables.end(); };
  std::string text;
  for (size_t at = 0; at < formula.size();) {
    const bool name = begins_name(formula[at]);
    const size_t end = name ? end_of_name(formula, at) : begins_number(formula, at) ? end_of_number(formula, at) : at + 1;
    const std::string token = formula.substr(at, end - at);
    const bool ours = name && numbers_.contains(token) && !(own && own->find(token));
    if (ours && taken(token)) throw InputError(fmt::format("'{}' is a variable of this formula, and a parameter of the scene; give the parameter another name", token));
    text += ours ? "(" + Value::number(numbers_.at(token).si).text + ")" : token;
    at = end;
  }
  return text;
}

Parameters Parameters::of(const Value& root) {
  Parameters p;
  const Value* map = root.find("parameters");
  if (!map || map->is_null()) return p;
  if (!map->is_map()) throw InputError(fmt::format("{}: parameters: expects names with numbers, `width: 20 mm`, got {}", map->mark.text(), map->description()));
  Written written;
  for (const Value::Entry& e : map->entries) {
    const std::string where = e.mark.text() + ": parameters: ";
    if (e.key.empty() || !begins_name(e.key[0]) || end_of_name(e.key, 0) != e.key.size())
      throw InputError(fmt::format("{}'{}' cannot stand in an expression; names are of letters, digits and _", where, e.key));
    if (Formula::knows(e.key)) throw InputError(fmt::format("{}'{}' is a function or a constant of formulas; take another name", where, e.key));
    if (!e.value.is_scalar()) throw InputError(fmt::format("{}{}: expects a number with its unit, or an expression, got {}", where, e.key, e.value.description()));
    written[e.key] = &e.value;
  }
  std::vector<std::string> open;
  for (const Value::Entry& e : map->entries) p.settle(written, e.key, open);
  return p;
}

// Evaluates a parameter after those that it depends on. open: the chain of dependent parameters.
void Parameters::settle(const Written& written, const std::string& name, std::vector<std::string>& open) {
  if (numbers_.contains(name)) return;
  const Value& value = *written.at(name);
  const std::string where = value.mark.text() + ": parameters: " + name;
  if (const auto first = std::find(open.begin(), open.end(), name); first != open.end())
    throw InputError(fmt::format("{}: {}; give {} as a number", where, open.end() - first > 1 ? fmt::format("{} need each other", fmt::join(first, open.end(), ", ")) : "needs itself",
                                 open.end() - first > 1 ? "one of them" : "it"));
  open.push_back(name);
  const auto known = [&](const std::string& other) { return written.contains(other); };
  if (!written_number(value.text))
    for (const Token& token : tokens_of(value.text, known))
      if (token.kind == Token::name && known(token.text)) settle(written, token.text, open);
  open.pop_back();
  try {
    numbers_[name] = number_of(value.text);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", where, error.what()));
  }
}

}  // namespace tack
