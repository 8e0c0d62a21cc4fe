// A comparison from its file to its folder.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "framework/compare/comparison.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

struct ComparisonSettings {
  std::string file;
  std::vector<std::string> overrides;  // "a.b=c"
  std::string output;                  // empty: results/<name>
  Provenance provenance;               // its plugins are filled in
};

/// Compares, and writes compare.csv, compare.md, compare.json and the plots. print: gets each line
/// of progress, warnings and plots that could not be drawn. Returns the folder, absolute. Throws
/// InputError before anything is written.
std::filesystem::path run_comparison(const ComparisonSettings& settings,
                                     const std::function<void(const std::string&)>& print);

}  // namespace tack
