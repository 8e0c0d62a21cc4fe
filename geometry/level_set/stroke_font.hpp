// Letters as lines: capitals, digits and . , ! ? - + = / : ' & (small letters are taken for
// capitals).
#pragma once

#include <array>
#include <string_view>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

using Stroke = std::array<Vec2, 2>;

// Returns the strokes of a line of text, its capitals one unit high, centred at the origin; x runs
// to the right, y up. Throws InputError for a character that is not known.
std::vector<Stroke> text_strokes(std::string_view text);

}  // namespace tack
