// The experiments of a calibration: their scenes with any values of the fitted numbers, and the points that were measured of them.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/batch/batch_plan.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/calibrate/point_evaluation.hpp"
#include "framework/calibrate/fitted_number.hpp"
#include "framework/calibrate/measured_points.hpp"
#include "framework/output/gradient_config.hpp"

namespace tack {

class FittedScenes {
 public:
  // Reads, binds and builds every experiment at the start of the numbers, whose units are filled in. Throws InputError for scenes and data that
  // cannot be read, keys that are no numbers of theirs, units that are others than the key's.
  FittedScenes(const CalibrateConfig& config, const std::string& program);

  const std::vector<FittedNumber>& numbers() const { return numbers_; }
  const std::vector<MeasuredPoints>& measured() const { return measured_; }  // of each experiment
  bool noise_known() const { return measured_.front().noise_known; }

  // Experiments with the same scene are one run.
  int runs() const { return static_cast<int>(scenes_.size()); }
  int run_of(int experiment) const { return run_of_[static_cast<size_t>(experiment)]; }
  const std::string& run_name(int run) const { return scenes_[static_cast<size_t>(run)].name; }

  // Why runs give no derivatives by a number (output.gradients), "" if they do. Builds scenes, the first time.
  const std::vector<std::string>& without_derivatives();

  // As an evaluation runs it: without frames, with derivatives by all numbers that have them if they are wanted. Throws InputError if the scene does not
  // take the values.
  BatchCase case_of(int run, const Point& values, bool derivatives = false);
  // As its file is, every key, with the values.
  std::string scene_text(int run, const Point& values);

  // From the folders of its runs, in their order. Bad, with the reason, if samples cannot be read or pass nothing that was measured.
  PointEvaluation evaluation(const Point& values, bool derivatives, const std::vector<std::filesystem::path>& run_folders) const;
  Point start() const;

 private:
  struct Scene {
    std::string name;  // of the first experiment that has it
    Value root;
    int experiment = 0;  // the same
  };

  int scene_of(const CalibrateConfig& config, int experiment);
  std::vector<Variant::Setting> settings(int run, const Point& values) const;
  void check_keys(int experiment, const Value& resolved, const CalibrateConfig& config);
  ResolvedCase resolved(int run, const Point& values, const std::vector<Variant::Setting>& more);
  const std::vector<std::string>& keys_of(const FittedNumber& number, int run) const;
  GradientConfig gradient_of(const FittedNumber& number, const std::string& key) const;
  std::vector<double> derivatives(size_t number, double value, const std::vector<ProbeSeries>& series, const std::vector<ProbeSeries>& gradients) const;

  std::vector<FittedNumber> numbers_;
  std::vector<MeasuredPoints> measured_;
  std::vector<Scene> scenes_;
  std::vector<int> run_of_;
  CaseResolver resolver_;
  std::optional<std::vector<std::string>> without_;
};

// "strength 3162.28, work 0.316"
std::string values_text(const std::vector<FittedNumber>& numbers, const Point& values);

}  // namespace tack
