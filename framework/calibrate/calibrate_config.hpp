// The file of `tack calibrate`, typed: experiments and their measured curves, fitted parameters,
// and settings of the search.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/batch/batch_config.hpp"
#include "framework/measured/measured_data.hpp"

namespace tack {

// A scene and the curve that was measured for it.
struct MeasuredExperiment {
  std::string name;  // empty: that of the data's file
  std::string base;  // absolute
  std::vector<std::string> set;
  std::string data;                // absolute
  std::string x = "time", y;       // columns of probes.csv
  std::string x_column, y_column;  // columns of the data; empty: as x and y
  std::optional<Quantity> from, to;
  // As written: "2 %" of the largest measured number, or a number; null: unknown.
  Value noise;
  double weight = 1;

  void fields(Fields& f);
};

enum class FitScale { automatic, log, linear };

// A fitted scene parameter.
struct FitConfig {
  std::optional<Quantity> from, to, start;
  FitScale scale = FitScale::automatic;
  std::string as;
  // As written: a key, a list of keys, or a map of these by the name of the experiment; null: the
  // key of its own entry.
  Value keys;

  void fields(Fields& f);
};

struct SearchConfig {
  int design = 0;       // points; 0: 32 per parameter
  int chains = 3;       // local searches, from the best points
  int evaluations = 0;  // largest number in design and chains together; 0: no limit
  bool polish = true, gradients = true;
  // In u (fitted_parameter.hpp): logarithms, or thirds of the range.
  double step = 0.15, difference = 0.05, tolerance = 1e-3;

  void fields(Fields& f);
};

struct CalibrateConfig {
  std::string name, about;
  std::vector<MeasuredExperiment> experiments;
  std::vector<std::string> set;
  std::map<std::string, FitConfig> fit;  // by key path, or any name with `keys`
  SearchConfig search;
  int threads = 1;                   // threads per run
  int jobs = 0;                      // concurrent runs; 0: as many as the cores allow
  std::optional<double> memory;      // GB, of a run
  std::optional<double> time_limit;  // s, of a run
  SlurmConfig slurm;

  void fields(Fields& f);
};

// Reads a calibration file; every experiment gets a name. Throws InputError with file, line and
// remedy.
CalibrateConfig load_calibration(const std::string& path,
                                 const std::vector<std::string>& overrides);

}  // namespace tack
