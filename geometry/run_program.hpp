// Other programs, started and waited for.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tack {

struct ProgramPlaces {
  std::filesystem::path folder = {};    // where it works; empty: here
  std::filesystem::path output = {};    // file of its standard output; empty: this program's
  bool errors_too = false;              // and what it complains of
};

// Its exit code; -1 if it could not be started, or was ended. Ctrl-C ends it.
int run_program(std::vector<std::string> words, const ProgramPlaces& places = {});

}  // namespace tack
