// measured.csv: the measured curves that a run's expectations hold it against, point by point. Columns: probe and along (text, of the run), x, measured and
// computed [SI; computed is nan where the run never gets there].
#pragma once

#include <filesystem>
#include <vector>

#include "framework/output/expectations.hpp"

namespace tack {

// Nothing is written without such an expectation; data that cannot be read any more are left out. Throws InputError when the file cannot be written.
void write_measured(const std::filesystem::path& path, const std::vector<Expectation>& expectations, const ProbeSeries& series);

}  // namespace tack
