// Nearest known name to a misspelt one, for "did you mean" messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tack {

// Returns the number of insertions, deletions, replacements and swaps of neighbours that turn a
// into b (optimal string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

// Returns the name nearest to `word`, the first of equally near ones. If none is close, returns the
// first that contains the word, or "".
std::string nearest(std::string_view word, const std::vector<std::string>& names);

// Returns "; did you mean 'young'? (keys: density, young)". Translates names of other programs,
// such as "E". label: noun for the names.
std::string suggestion(std::string_view word, const std::vector<std::string>& names,
                       std::string_view label);

}  // namespace tack
