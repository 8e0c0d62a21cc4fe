// The file of `tack batch`, typed: experiments, variations, statistics, limits.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/batch/batch_plots.hpp"
#include "framework/batch/variation.hpp"
#include "framework/output/specified_statistic.hpp"

namespace tack {

struct BatchBase {
  std::string name;  // empty: that of the file
  std::string file;  // absolute
  std::vector<std::string> set;
  void fields(Fields& f);
};

struct BatchStatistic : SpecifiedStatistic {
  std::string name;  // a column of results.csv; empty: made from the rest
  void fields(Fields& f);
  std::string column() const;
};

// Resources that a Slurm job array requests; threads and memory are those of one case.
struct SlurmConfig {
  std::string partition, account;
  double time = 3600;                 // s, of a case
  int at_once = 0;                    // cases; 0: no limit
  int requeues = 0;                   // of a case that reaches its time limit
  int max_array_size = 0;             // tasks of one array; 0: as the cluster's MaxArraySize allows
  std::vector<std::string> prologue;  // lines of shell before each case
  std::vector<std::string> options;   // options of sbatch, as "--constraint=..."
  void fields(Fields& f);
};

// Returns a time in minutes, rounded up, as Slurm counts time limits.
long whole_minutes(double seconds);

// Format of the table, beside results.csv.
enum class BatchTable { csv, hdf5 };

struct BatchConfig {
  std::string name, about;
  std::string base;  // absolute; empty: `bases`
  std::vector<BatchBase> bases;
  std::vector<std::string> set;
  std::vector<std::unique_ptr<const Variation>> vary;
  std::vector<BatchStatistic> statistics;
  BatchTable table = BatchTable::csv;
  std::vector<BatchPlot> plots;      // further pictures of `tack plot`
  int threads = 1;                   // per case
  int jobs = 0;                      // side by side; 0: as the cores allow
  std::optional<double> memory;      // GB, of a case
  std::optional<double> time_limit;  // s, of a case
  SlurmConfig slurm;
  void fields(Fields& f);

  std::vector<BatchBase> all_bases() const;  // with names
};

// Reads a batch file. Throws InputError with file, line and remedy.
BatchConfig load_batch(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace tack
