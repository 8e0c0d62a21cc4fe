// The result of a calibration.
#pragma once

#include "framework/calibrate/confidence.hpp"
#include "framework/calibrate/fitted_scenes.hpp"
#include "framework/calibrate/search.hpp"

namespace tack {

struct Calibration {
  SearchResult search;
  std::optional<Confidence> confidence;  // nothing if there are no derivatives
  std::vector<std::string> warnings;     // of the confidence and of the search
};

Calibration calibrate(const FittedScenes& scenes, const SearchConfig& config, Evaluator& evaluator,
                      const SearchProgress& progress);

// Returns the fitted values with their intervals, warnings and residuals, for the console.
std::string summary_text(const Calibration& found, const FittedScenes& scenes);

}  // namespace tack
