// Names of files for probes, experiments and pictures.
#pragma once

#include <map>
#include <set>
#include <string>

namespace tack {

// Returns the text with '_' for what a file name should not have: all but letters of any alphabet,
// digits, '-', '_' and '.'.
std::string file_name(std::string text);

// Gives texts that differ file names that differ: beside "a_b", "a b" becomes "a_b.2".
class FileNames {
 public:
  const std::string& of(const std::string& text);

 private:
  std::map<std::string, std::string> names_;  // by text
  std::set<std::string> taken_;
};

}  // namespace tack
