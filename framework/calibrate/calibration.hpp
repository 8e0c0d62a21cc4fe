// What a calibration found.
#pragma once

#include "framework/calibrate/confidence.hpp"
#include "framework/calibrate/fitted_scenes.hpp"
#include "framework/calibrate/search.hpp"

namespace tack {

struct Calibration {
  SearchResult search;
  std::optional<Confidence> confidence;  // nothing if there are no derivatives
  std::vector<std::string> warnings;     // those of the confidence, and what else a reader must know
};

Calibration calibrate(const FittedScenes& scenes, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell);

// The numbers with their intervals, warnings, and what is left: for the console.
std::string summary_text(const Calibration& found, const FittedScenes& scenes);

}  // namespace tack
