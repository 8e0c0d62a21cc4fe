// probes.csv: the time [s] and what each probe measured, one row per sample.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/csv.hpp"

namespace tack {

// A series of samples; the column "time" [s] comes first.
using ProbeSeries = CsvTable;

// Also keeps the samples, for the expectations. Throws InputError when the file cannot be written
// or two columns have one name.
class ProbesCsv {
 public:
  // `columns` without "time".
  ProbesCsv(std::filesystem::path path, const std::vector<std::string>& columns);

  // Continues a file written before with its samples up to `last_time` [s]; a missing file is an
  // empty one. Throws InputError if it has other columns.
  static ProbesCsv continued(std::filesystem::path path, const std::vector<std::string>& columns,
                             double last_time);

  // One value per column. Throws std::logic_error for a wrong count.
  void add(double time, const std::vector<double>& values);

  const ProbeSeries& series() const { return series_; }

 private:
  ProbesCsv(std::filesystem::path path, ProbeSeries series);

  ProbeSeries series_;
  CsvFile file_;
};

}  // namespace tack
