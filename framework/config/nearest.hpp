// The known name closest to a misspelt one, for "did you mean" messages.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace tack {

// Number of insertions, deletions, replacements and swaps of neighbours that turn a into b (optimal
// string alignment distance).
int edit_distance(std::string_view a, std::string_view b);

// The name nearest to `word`, the first of equally near ones; if none is close, the first that
// contains the word; else "".
std::string nearest(std::string_view word, const std::vector<std::string>& names);

// Returns "; did you mean 'young'? (keys: density, young)". Knows the names of other programs, "E".
// `label` says what the names are.
std::string suggestion(std::string_view word, const std::vector<std::string>& names,
                       std::string_view label);

}  // namespace tack
