#include "framework/run/stage_ends.hpp"

#include <fmt/format.h>

namespace tack {

std::string with_unit(double value, const Unit& unit) { return unit.plain() ? fmt::format("{:.6g}", value) : fmt::format("{:.6g} {}", value, unit.si); }

std::string text_of(const EndCondition& end, const Unit& unit) {
  if (end.time) return fmt::format("{:.6g} s", *end.time);
  if (!end.contact.empty()) return fmt::format("contact of {} and {}", end.contact[0], end.contact[1]);
  if (!end.when.empty()) return end.when;
  if (end.above) return fmt::format("{} above {}", end.probe, with_unit(*end.above, unit));
  if (end.below) return fmt::format("{} below {}", end.probe, with_unit(*end.below, unit));
  if (end.rate_below) return fmt::format("{} changing by less than {} per second", end.probe, with_unit(*end.rate_below, unit));
  return fmt::format("{} dropping by {:.6g} %", end.probe, 100 * *end.drop);
}

}  // namespace tack
