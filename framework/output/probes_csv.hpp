// probes.csv: time [s] and the values of probes, one row per sample.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/output/csv.hpp"

namespace tack {

// A series of samples; its first column is "time" [s].
using ProbeSeries = CsvTable;

// Writes the file and keeps the samples for expectations. Throws InputError if the file cannot be
// written or two columns have one name.
class ProbesCsv {
 public:
  // columns: without "time".
  ProbesCsv(std::filesystem::path path, const std::vector<std::string>& columns);

  // Continues an existing file with its samples up to `last_time` [s]; a missing file counts as
  // empty. Throws InputError if its columns differ.
  static ProbesCsv continued(std::filesystem::path path, const std::vector<std::string>& columns,
                             double last_time);

  // Appends a sample, one value per column. Throws std::logic_error for a wrong count.
  void add(double time, const std::vector<double>& values);

  const ProbeSeries& series() const { return series_; }

 private:
  ProbesCsv(std::filesystem::path path, ProbeSeries series);

  ProbeSeries series_;
  CsvFile file_;
};

}  // namespace tack
