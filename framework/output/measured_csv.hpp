// measured.csv: measured curves that expectations compare the run with, point by point. Columns:
// probe and along (text, of the run), x, measured and computed [SI; computed is nan where the run
// never gets], and the stage of the expectation.
#pragma once

#include <filesystem>
#include <vector>

#include "framework/output/expectations.hpp"

namespace tack {

// Writes the file, if there is such an expectation. Skips data that can no longer be read. Throws
// InputError if the file cannot be written.
void write_measured(const std::filesystem::path& path, const std::vector<Expectation>& expectations,
                    const ProbeSeries& series, const std::vector<StageVisit>& stages);

}  // namespace tack
