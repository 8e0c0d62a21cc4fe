// Names of files for probes, experiments and pictures.
#pragma once

#include <map>
#include <set>
#include <string>
#include <utility>

namespace tack {

// Returns the text with '_' for what a file name should not have: all but letters of any alphabet,
// digits, '-', '_' and '.', which is not the first.
std::string file_name(std::string text);

// Gives texts that differ file names that differ: beside "a_b", "a b" becomes "a_b.2".
class FileNames {
 public:
  // before_number: between the name and the number.
  explicit FileNames(std::string before_number = ".") : before_number_(std::move(before_number)) {}
  const std::string& of(const std::string& text);

 private:
  std::string before_number_;
  std::map<std::string, std::string> names_;  // by text
  std::set<std::string> taken_;
};

}  // namespace tack
