// Misspelt words of a command line.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace tack {

// Returns a message about the first misspelt command or option of `words`, with the nearest name
// that `app` knows; "" if there is none.
std::string misspelt_word(const CLI::App& app, const std::vector<std::string>& words);

}  // namespace tack
