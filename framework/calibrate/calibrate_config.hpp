// The file of `tack calibrate`, typed: which experiments are held against which measured curves, which of their numbers are fitted, and
// how they are searched for.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/batch/batch_config.hpp"
#include "framework/measured/measured_data.hpp"

namespace tack {

// A scene and a curve that was measured of it.
struct MeasuredExperiment {
  std::string name;  // empty: that of the data's file
  std::string base;  // absolute
  std::vector<std::string> set;
  std::string data;  // absolute
  std::string x = "time", y;  // columns of probes.csv
  std::string x_column, y_column;  // of the data; empty: as x and y
  std::optional<Quantity> from, to;
  Value noise;  // as written: "2 %" of the largest measured number, or a number; null: not known
  double weight = 1;

  void fields(Fields& f);
};

enum class FitScale { automatic, log, linear };

// A number of the scenes that is searched for.
struct FitConfig {
  std::optional<Quantity> from, to, start;
  FitScale scale = FitScale::automatic;
  std::string as;
  Value keys;  // null: the key that it stands under; else as written: a key, a list of keys, or those by the name of the experiment

  void fields(Fields& f);
};

struct SearchConfig {
  int design = 0;       // points; 0: 32 for each number
  int chains = 3;       // local searches, from the best points
  int evaluations = 0;  // most of design and chains together; 0: as many as it takes
  bool polish = true, gradients = true;
  double step = 0.15, difference = 0.05, tolerance = 1e-3;  // in logarithms, or in thirds of the range

  void fields(Fields& f);
};

struct CalibrateConfig {
  std::string name, about;
  std::vector<MeasuredExperiment> experiments;
  std::vector<std::string> set;
  std::map<std::string, FitConfig> fit;  // by key path, or any name with `keys`
  SearchConfig search;
  int threads = 1;                   // of a run
  int jobs = 0;                      // side by side; 0: as many as cores allow
  std::optional<double> memory;      // GB, of a run
  std::optional<double> time_limit;  // s, of a run
  SlurmConfig slurm;

  void fields(Fields& f);
};

// With a name for each experiment. Throws InputError with file, line and remedy.
CalibrateConfig load_calibration(const std::string& path, const std::vector<std::string>& overrides);

}  // namespace tack
