#include "framework/config/shape.hpp"

#include <fmt/format.h>

#include "framework/config/field.hpp"
#include "framework/config/registry.hpp"
#include "framework/config/words.hpp"

namespace tack {
namespace {

std::string names_of(const std::vector<Shape::Option>& options) {
  std::string text;
  for (const Shape::Option& o : options) text += (text.empty() ? "" : ", ") + o.name;
  return text;
}

std::string plural_of(const Shape& s) {
  const bool number = s.form == Shape::Form::number;
  return number ? unit_noun_plural(s.unit) : plural(s.noun());
}

}  // namespace

std::string Shape::noun() const {
  switch (form) {
    case Form::number:
      return unit_noun(unit);
    case Form::integer:
      return "whole number";
    case Form::flag:
      return "true or false";
    case Form::text:
      return "text";
    case Form::path:
      return "file path";
    case Form::choice:
      return "one of " + names_of(options);
    case Form::schedule:
      return fmt::format("{} or list of [time (s), {}]", unit_noun(unit), unit.quantity);
    case Form::list: {
      const std::string length = count < 0 ? "" : fmt::format("{} ", count);
      return fmt::format("list of {}{}", length, plural_of(*entry));
    }
    case Form::map:
      return "map of names to " + plural_of(*entry);
    case Form::object:
      return "map";
    case Form::component:
      return kind->name();
    case Form::any:
      return "value";
  }
  return "";
}

std::string Shape::expectation() const {
  if (form == Form::flag || form == Form::choice) return noun();
  const std::string how = form == Form::component ? " (its name, or a map with 'type')" : "";
  return with_article(noun()) + how;
}

Shape simple_shape(Shape::Form form, Unit unit) {
  Shape s;
  s.form = form;
  s.unit = unit;
  return s;
}

Shape list_shape(Shape entry, int count) {
  Shape s = simple_shape(Shape::Form::list, entry.unit);
  s.count = count;
  s.entry = std::make_shared<const Shape>(std::move(entry));
  return s;
}

bool Bounds::contains(double value) const {
  const bool above = !low || (low_open ? value > *low : value >= *low);
  const bool below = !high || (high_open ? value < *high : value <= *high);
  return above && below;
}

std::string Bounds::text() const {
  if (low == 0.0 && !high) return low_open ? "positive" : "not negative";
  if (low && high && !low_open && !high_open) return fmt::format("in [{}, {}]", *low, *high);
  std::string text;
  if (low) text = fmt::format("{} {}", low_open ? "above" : "at least", *low);
  if (low && high) text += " and ";
  if (high) text += fmt::format("{} {}", high_open ? "below" : "at most", *high);
  return text;
}

}  // namespace tack
