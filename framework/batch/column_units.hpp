// The units of the columns of results.csv, for axes and legends.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/batch/batch_config.hpp"
#include "framework/experiment/experiment.hpp"

namespace tack {

// Returns the SI units by column; plain numbers are left out. Columns: varied keys, statistics (if
// there are none, those that every probe has), values of expectations, and times. `resolved`: the
// experiment's values with their units as comments (to_value).
std::map<std::string, std::string> column_units(const Experiment& experiment, const Value& resolved,
                                                const Variant& variant,
                                                const std::vector<BatchStatistic>& statistics);

// Returns the unit in the comment of a resolved value: "Pa" of "Pa", and of "[s, Pa]", that of a
// time-dependent one; "" without a comment.
std::string unit_in(const std::string& comment);

}  // namespace tack
