// Reading of numbers, texts, choices and lists into the member's type.
#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>

#include "framework/config/field.hpp"
#include "framework/config/nearest.hpp"
#include "framework/config/number_text.hpp"
#include "framework/config/reader.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns "-3 kg/m^3", whether or not the unit was written.
std::string with_unit(const std::string& text, const Unit& unit) {
  const bool bare = number_text(text).length == text.size();
  return bare && !unit.plain() ? fmt::format("{} {}", text, unit.si) : text;
}

}  // namespace

bool Reader::number(const Value& value, const Unit& unit, const Bounds& bounds,
                    std::string_view key, double& out) {
  if (!value.is_scalar()) {
    const Shape shape = simple_shape(Shape::Form::number, unit);
    error(value.mark,
          fmt::format("{}: expects {}, got {}", key, shape.expectation(), value.description()));
    return false;
  }
  double number = 0;
  try {
    number = to_si(value.text, unit);
  } catch (const InputError& e) {
    error(value.mark, fmt::format("{}: {}{}", key, e.what(), value.comment.empty() ? "" : "; it is " + value.comment));
    return false;
  }
  if (!bounds.contains(number)) {
    // An expression of scene parameters is shown as it is written, with its value in SI.
    const std::string shown = value.comment.empty() ? with_unit(value.text, unit) : fmt::format("{} ({})", value.comment, with_unit(Value::number(number).text, unit));
    error(value.mark, fmt::format("{}: {} must be {}", key, shown, bounds.text()));
    return false;
  }
  out = number;
  return true;
}

bool Reader::number(const Value& value, const Field& field, double& out) {
  return number(value, field.shape.unit, field.bounds, field.key, out);
}

bool Reader::integer(const Value& value, const Field& field, int& out) {
  int number = 0;
  const char* begin = value.text.data();
  const char* end = begin + value.text.size();
  if (end - begin > 1 && begin[0] == '+' && begin[1] != '-') ++begin;
  const auto [stop, status] = std::from_chars(begin, end, number);
  if (value.is_scalar() && status == std::errc::result_out_of_range && stop == end) {
    error(value.mark, fmt::format("{}: {} is too {}; whole numbers go from {} to {}", field.key, value.text, *begin == '-' ? "small" : "large",
                                  std::numeric_limits<int>::min(), std::numeric_limits<int>::max()));
    return false;
  }
  if (!value.is_scalar() || status != std::errc() || stop != end) {
    error(value.mark,
          fmt::format("{}: expects a whole number, got {}", field.key, value.description()));
    return false;
  }
  if (!field.bounds.contains(number)) {
    error(value.mark, fmt::format("{}: {} must be {}", field.key, number, field.bounds.text()));
    return false;
  }
  out = number;
  return true;
}

bool Reader::flag(const Value& value, const Field& field, bool& out) {
  if (!value.is_scalar() || (value.text != "true" && value.text != "false")) {
    unexpected(value, field);
    return false;
  }
  out = value.text == "true";
  return true;
}

bool Reader::text(const Value& value, const Field& field, std::string& out) {
  if (!value.is_scalar()) {
    error(value.mark, fmt::format("{}: expects a text, got {}", field.key, value.description()));
    return false;
  }
  if (field.one_line && std::any_of(value.text.begin(), value.text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; })) {
    error(value.mark, fmt::format("{}: expects a text in one line, and this one has a line break, a tab or another control character; "
                                  "take it out", field.key));
    return false;
  }
  out = value.text;
  return true;
}

std::size_t Reader::option(const Value& value, const Field& field) {
  const std::vector<Shape::Option>& options = field.shape.options;
  std::vector<std::string> names;
  for (const Shape::Option& o : options) {
    if (value.is_scalar() && value.text == o.name) return names.size();
    names.push_back(o.name);
  }
  const std::string near = value.is_scalar() ? nearest(value.text, names) : "";
  error(value.mark, fmt::format("{}: expects {}, got {}{}", field.key, field.shape.expectation(),
                                value.description(),
                                near.empty() ? "" : fmt::format("; did you mean '{}'?", near)));
  return options.size();
}

bool Reader::list(const Value& value, const Field& field) {
  const bool right_length =
      field.shape.count < 0 || value.items.size() == static_cast<std::size_t>(field.shape.count);
  if (!value.is_sequence() || !right_length) {
    unexpected(value, field);
    return false;
  }
  if (field.filled && value.items.empty()) {
    error(value.mark,
          fmt::format("{}: must not be empty; expects {}", field.key, field.shape.expectation()));
    return false;
  }
  return true;
}

void Reader::unexpected(const Value& value, const Field& field) {
  error(value.mark, fmt::format("{}: expects {}, got {}", field.key, field.shape.expectation(),
                                value.description()));
}

}  // namespace tack
