#include "framework/config/schema_numbers.hpp"

#include <fmt/format.h>

#include <array>
#include <map>

#include "geometry/errors.hpp"

namespace tack {

#define TACK_NUMBER R"(^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*)"
const char* const number_pattern = TACK_NUMBER R"(([A-Za-z%µ°1/(].*)?$)";

const char* const expression_pattern = R"(^[-+( ]*[A-Za-z_][A-Za-z0-9_]*\s*([-+*/^(<>?)].*)?$|^.*\S\s*[*?]\s*\S.*$|^.*\S [-+/] \S.*$)";

namespace {

using Exponents = std::array<int, 3>;  // of kg, m and s

// Non-ASCII letters stand alone, not in brackets, because libraries that match bytes would split
// them.
struct Known {
  const char* spellings;
  Exponents exponents;
  int largest_power;  // largest common power
};
constexpr std::array common_units{
    Known{"(([pnucdmk]|µ)?m|in|ft)", {0, 1, 0}, 3},
    Known{"(([pnum]|µ)?s|min|h|d)", {0, 0, 1}, 3},
    Known{"(([num]|µ|k)?g|t)", {1, 0, 0}, 1},
    Known{"([numkMG]|µ)?N", {1, 1, -2}, 1},
    Known{"(([umhkMG]|µ)?Pa|m?bar|psi|atm)", {1, -1, -2}, 1},
    Known{"([pnumkM]|µ)?J", {1, 2, -2}, 1},
    Known{"([pnumkM]|µ)?W", {1, 2, -3}, 1},
    Known{"[mkMG]?Hz", {0, 0, -1}, 1},
};
constexpr const char* dimensionless = "(%|m?rad|deg|°)";  // angles as well
constexpr const char* over = R"(\s*/\s*)";
constexpr const char* times = R"((\s+|\s*[*.]\s*))";

Exponents sum(const Exponents& a, const Exponents& b, int factor) {
  return {a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2]};
}

std::string power_text(int power) {
  constexpr std::array raised{"", R"((\^?2|²))", R"((\^?3|³))"};
  if (power > 0) return raised[static_cast<size_t>(power) - 1];
  return fmt::format(R"(\^?-{})", -power);
}

struct Spelling {
  std::string pattern;
  Exponents exponents;
};

// Returns all known spellings with their dimensions.
std::vector<Spelling> forms() {
  std::vector<Spelling> all{{dimensionless, {0, 0, 0}}};
  for (const Known& a : common_units) {
    for (int power = 1; power <= a.largest_power; ++power) {
      const std::string own = a.spellings + power_text(power);
      const Exponents exponents = sum({0, 0, 0}, a.exponents, power);
      const Exponents reciprocal = sum({0, 0, 0}, exponents, -1);
      all.push_back({own, exponents});
      all.push_back({fmt::format("(1{}{}|{}{})", over, own, a.spellings, power_text(-power)), reciprocal});
      all.push_back({fmt::format("(rad|deg){}{}", over, own), reciprocal});
      for (const Known& b : common_units) {
        all.push_back({own + times + b.spellings, sum(exponents, b.exponents, 1)});
        for (int below = 1; below <= b.largest_power; ++below)
          all.push_back({fmt::format("{0}({1}{2}{3}|{4}{2}{5})", own, over, b.spellings, power_text(below), times, power_text(-below)),
                         sum(exponents, b.exponents, -below)});
      }
    }
  }
  return all;
}

// Returns true if the program accepts a number of these exponents for `unit`.
bool accepted(const Exponents& exponents, const Unit& unit) {
  std::string text = "1";
  constexpr std::array names{"kg", "m", "s"};
  for (size_t i = 0; i < names.size(); ++i)
    if (exponents[i] != 0) text += fmt::format(" {}^{}", names[i], exponents[i]);
  try {
    to_si(text == "1" ? "1 %" : text, unit);
    return true;
  } catch (const InputError&) {
    return false;
  }
}

std::string whole(const std::vector<std::string>& alternatives) {
  return fmt::format(TACK_NUMBER R"(({})\s*$)", fmt::join(alternatives, "|"));
}

}  // namespace

std::string known_unit_pattern() {
  std::string one, raised, lowered;
  for (const Known& a : common_units) {
    const char* bar = one.empty() ? "" : "|";
    one += bar + std::string(a.spellings);
    raised += bar + std::string(a.spellings) + (a.largest_power > 1 ? fmt::format("({}|{})?", power_text(2), power_text(3)) : "");
    lowered += fmt::format(R"({}{}\^?-[1-{}])", bar, a.spellings, a.largest_power);
  }
  return whole({dimensionless, fmt::format("(1{0}|(rad|deg){0})({1})", over, raised), lowered,
                fmt::format("({0})({1}({0})|{2}({3}|{4}))?", raised, over, times, one, lowered)});
}

std::string unit_pattern(const Unit& unit) {
  std::map<Exponents, bool> fits;
  std::vector<std::string> right;
  for (const Spelling& f : forms()) {
    const auto [found, first] = fits.emplace(f.exponents, false);
    if (first) found->second = accepted(f.exponents, unit);
    if (found->second) right.push_back(f.pattern);
  }
  return whole(right);
}

}  // namespace tack
