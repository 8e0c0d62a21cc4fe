// Letters as strokes: capitals, digits and . , ! ? - + = / : ' & (small letters become capitals).
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

using Stroke = std::array<Vec2, 2>;

// Returns the strokes of a line of text with capitals of height 1, centred at the origin; x to the
// right, y up. Throws InputError for an unknown character.
std::vector<Stroke> text_strokes(std::string_view text);

}  // namespace tack
