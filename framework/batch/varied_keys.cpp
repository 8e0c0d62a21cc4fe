#include "framework/batch/varied_keys.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>

#include "framework/config/nearest.hpp"
#include "framework/config/units.hpp"
#include "framework/config/yaml_text.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

[[noreturn]] void refuse(const SourceMark& mark, const std::string& what) { throw InputError(mark.text() + ": " + what); }

// Throws InputError for unknown keys of a map.
void refuse_unknown(const Value& map, const std::vector<std::string>& known) {
  for (const Value::Entry& e : map.entries)
    if (std::find(known.begin(), known.end(), e.key) == known.end())
      refuse(e.mark, fmt::format("unknown key '{}'{} (keys: {})", e.key, suggestion(e.key, known, "keys"), fmt::join(known, ", ")));
}

const std::vector<Value::Entry>& entries_of(const Value& keys) {
  if (!keys.is_map() || keys.entries.empty())
    refuse(keys.mark, fmt::format("keys: expects a map of keys of the experiment to what they take, got {}", keys.description()));
  return keys.entries;
}

std::string column_of(const Value::Entry& e) {
  const Value* as = e.value.find("as");
  if (!as) return e.key;
  const bool one_line = std::none_of(as->text.begin(), as->text.end(), [](unsigned char c) { return c < ' ' || c == 0x7f; });
  if (!as->is_scalar() || as->text.empty() || !one_line) refuse(as->mark, "as: expects a text in one line, got " + as->description());
  return as->text;
}

// Returns a number of a range, and the unit behind it in `unit`, as written.
double number_of(const Value& range, const char* key, const SourceMark& mark, std::string& unit) {
  const Value* v = range.find(key);
  if (!v) refuse(mark, fmt::format("a range needs '{}', a number that may have a unit", key));
  double number = 0;
  const char* end = v->text.data() + v->text.size();
  const auto [stop, status] = std::from_chars(v->text.data(), end, number);
  if (!v->is_scalar() || status != std::errc() || !std::isfinite(number))
    refuse(v->mark, fmt::format("{}: expects a number that may have a unit, got {}", key, v->description()));
  unit = std::string(stop, end);
  unit.erase(0, unit.find_first_not_of(' '));
  return number;
}

bool chosen(const Value& map, const char* key, const char* yes, const char* no) {
  const Value* v = map.find(key);
  if (!v || (v->is_scalar() && v->text == no)) return false;
  if (v->is_scalar() && v->text == yes) return true;
  refuse(v->mark, fmt::format("{}: expects {} or {}, got {}", key, no, yes, v->description()));
}

VariedRange range_of(const Value::Entry& e) {
  VariedRange range;
  refuse_unknown(e.value, {"from", "to", "scale", "whole", "as"});
  range.mark = e.value.mark;
  std::string unit_to;
  range.from = number_of(e.value, "from", e.mark, range.unit);
  range.to = number_of(e.value, "to", e.mark, unit_to);
  range.log = chosen(e.value, "scale", "log", "linear");
  range.whole = chosen(e.value, "whole", "true", "false");
  if (unit_to != range.unit)
    refuse(e.value.mark, fmt::format("'from' is in '{}', 'to' in '{}'; write both in one unit", range.unit, unit_to));
  if (!(range.from < range.to)) refuse(e.value.mark, fmt::format("'from' ({}) must be below 'to' ({})", range.from, range.to));
  if (range.whole && (range.from != std::floor(range.from) || range.to != std::floor(range.to)))
    refuse(e.value.mark, fmt::format("whole: true needs 'from' and 'to' that are whole numbers, not {} and {}", range.from, range.to));
  if (range.log && range.from <= 0) refuse(e.value.mark, "scale: log needs 'from' above zero");
  return range;
}

std::vector<Value> values_of(const Value::Entry& e) {
  const Value* list = &e.value;
  if (e.value.is_map()) {
    refuse_unknown(e.value, {"values", "as"});
    list = e.value.find("values");
    if (!list) refuse(e.value.mark, "needs 'values', a list");
  }
  if (!list->is_sequence() || list->items.empty())
    refuse(list->mark, fmt::format("{}: expects a list of values, got {}", e.key, list->description()));
  return list->items;
}

}  // namespace

Value VariedRange::at(double u) const {
  const double top = whole ? to + 1 : to;
  double x = log ? from * std::pow(top / from, u) : from + (top - from) * u;
  if (whole) x = std::min(std::floor(x), to);
  Value v = Value::scalar(whole ? fmt::format("{:.0f}", x) : fmt::format("{:.6g}", x));
  if (!unit.empty()) v.text += " " + unit;
  v.mark = mark;
  return v;
}

std::vector<VariedKey> keys_with_values(const Value& keys) {
  std::vector<VariedKey> varied;
  for (const Value::Entry& e : entries_of(keys)) {
    if (e.value.find("from"))
      refuse(e.value.mark, fmt::format("{}: a range is for type: latin_hypercube and type: sobol; list the values here", e.key));
    varied.push_back({e.key, column_of(e), e.mark, values_of(e), {}});
  }
  return varied;
}

std::vector<VariedKey> keys_with_ranges(const Value& keys) {
  std::vector<VariedKey> varied;
  for (const Value::Entry& e : entries_of(keys)) {
    if (!e.value.is_map())
      refuse(e.value.mark, fmt::format("{}: expects a range such as {{from: 1 kPa, to: 1 MPa, scale: log}}, got {}", e.key,
                                       e.value.description()));
    varied.push_back({e.key, column_of(e), e.mark, {}, range_of(e)});
  }
  return varied;
}

std::string shown_text(const Value& value) { return value.is_scalar() ? value.text : inline_text(value); }

}  // namespace tack
