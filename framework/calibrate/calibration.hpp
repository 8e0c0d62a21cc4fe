// The result of a calibration.
#pragma once

#include "framework/calibrate/confidence.hpp"
#include "framework/calibrate/fitted_scenes.hpp"
#include "framework/calibrate/search.hpp"
#include "framework/core/warning.hpp"

namespace tack {

struct Calibration {
  SearchResult search;
  std::optional<Confidence> confidence;  // nothing if there are no derivatives
  std::vector<Warning> warnings;         // of the confidence and of the search
};

Calibration calibrate(const FittedScenes& scenes, const SearchConfig& config, Evaluator& evaluator,
                      const SearchProgress& progress);

// Returns warnings about a search and its best run.
std::vector<Warning> warnings_about(const SearchResult& search,
                                    const std::vector<MeasuredPoints>& measured);

// Returns the fitted values with their intervals, warnings and residuals, for the console.
std::string summary_text(const Calibration& calibration, const FittedScenes& scenes);

}  // namespace tack
