// English phrases for messages, documentation and progress reports.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tack {

std::string with_article(std::string_view noun);  // "a pressure (Pa)", "an angle (rad)"
std::string plural(std::string_view noun);        // "lengths", "energies", "works of adhesion"

std::string listed(const std::vector<std::string>& names);  // "a", "a and b", "a, b and c"
std::string counted(long count, std::string_view noun);     // "1 case", "24 cases"
std::string duration_text(double seconds);                  // "12s", "2m05s", "1h02m"

}  // namespace tack
