// English for messages and documentation.
#pragma once

#include <string>
#include <string_view>

namespace tack {

std::string with_article(std::string_view noun);  // "a pressure (Pa)", "an angle (rad)"
std::string plural(std::string_view noun);        // "lengths", "energies", "works of adhesion"

}  // namespace tack
