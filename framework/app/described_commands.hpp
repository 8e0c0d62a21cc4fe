// Descriptions of the commands and their options, for completion scripts and the manual page.
#pragma once

#include "framework/app/command_set.hpp"

namespace CLI {
class App;
}

namespace tack {

// Returns all commands of the program with their options.
CommandSet command_set_of(const CLI::App& app);

}  // namespace tack
