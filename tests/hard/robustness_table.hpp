// Page docs/robustness.md: every hard case with every solver.
#pragma once

#include <string>
#include <vector>

#include "tests/hard/hard_case.hpp"

namespace tack {

struct HardRow {
  HardCase hard;
  std::vector<HardOutcome> outcomes;  // per solver
};

// Returns the text of the page.
std::string robustness_page(const std::vector<HardRow>& rows,
                            const std::vector<HardSolver>& solvers);

// Returns the cases without a row in a page.
std::vector<std::string> missing_rows(const std::string& page, const std::vector<HardCase>& cases);

}  // namespace tack
