#include "framework/config/written_number.hpp"

#include <charconv>

#include "framework/config/units.hpp"
#include "framework/config/value.hpp"
#include "geometry/errors.hpp"

namespace tack {

std::string WrittenNumber::text_of(double other) const { return Value::number(other).text + (unit.empty() ? "" : " " + unit); }

std::optional<WrittenNumber> written_number(const std::string& text) {
  double number = 0;
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (status != std::errc()) return std::nullopt;
  const size_t from = text.find_first_not_of(' ', static_cast<size_t>(stop - text.data()));
  if (from == text.npos) return WrittenNumber{number, ""};
  try {
    const std::string unit = si_unit(text.substr(from));
    return WrittenNumber{to_si(text, units::any), unit == units::none.si ? "" : unit};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

}  // namespace tack
