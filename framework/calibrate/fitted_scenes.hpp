// The scenes of a calibration for any values of the fitted parameters, and their measured points.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/batch/batch_plan.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/calibrate/point_evaluation.hpp"
#include "framework/calibrate/fitted_parameter.hpp"
#include "framework/calibrate/measured_points.hpp"
#include "framework/output/gradient_config.hpp"

namespace tack {

class FittedScenes {
 public:
  // Reads, binds and builds every experiment at the start values, and fills in the units of the
  // parameters. Throws InputError for unreadable scenes and data, keys that are no parameters of a
  // scene, and units that differ from the key's.
  FittedScenes(const CalibrateConfig& config, const std::string& program);

  const std::vector<FittedParameter>& parameters() const { return parameters_; }
  // One for each experiment.
  const std::vector<MeasuredPoints>& measured() const { return measured_; }
  // Warnings of the scenes: retired keys.
  const std::vector<std::string>& warnings() const { return warnings_; }
  bool noise_known() const { return measured_.front().noise_known; }

  // Number of runs per evaluation; experiments with equal scenes share a run.
  int runs() const { return static_cast<int>(scenes_.size()); }
  int run_of(int experiment) const { return run_of_[static_cast<size_t>(experiment)]; }
  const std::string& run_name(int run) const { return scenes_[static_cast<size_t>(run)].name; }

  // Returns, per parameter, the reason why runs give no sensitivities to it (output.gradients); ""
  // if they do. The first call builds scenes.
  const std::vector<std::string>& without_derivatives();

  // Returns the case of a run for an evaluation: without frames; with `derivatives`, with
  // output.gradients for all parameters that support them. Throws InputError if the scene does not
  // accept the values.
  BatchCase case_of(int run, const DesignPoint& values, bool derivatives = false);
  // Returns the scene file of a run with every key and the values.
  std::string scene_text(int run, const DesignPoint& values);

  // Evaluates a point from the folders of its runs, in their order. The evaluation is bad, with the
  // reason, if samples are unreadable or pass no measured point.
  PointEvaluation evaluation(const DesignPoint& values, bool derivatives,
                             const std::vector<std::filesystem::path>& run_folders) const;
  DesignPoint start() const;

 private:
  struct Scene {
    std::string name;  // of the first experiment with this scene
    Value root;
    int experiment = 0;  // index of that experiment
  };

  int scene_of(const CalibrateConfig& config, int experiment);
  std::vector<Variant::Setting> settings(int run, const DesignPoint& values) const;
  void check_keys(int experiment, const Value& resolved, const CalibrateConfig& config);
  ResolvedCase resolved(int run, const DesignPoint& values,
                        const std::vector<Variant::Setting>& more);
  const std::vector<std::string>& keys_of(const FittedParameter& parameter, int run) const;
  GradientConfig gradient_of(const FittedParameter& parameter, const std::string& key) const;
  std::vector<double> derivatives(size_t parameter, double value,
                                  const std::vector<ProbeSeries>& series,
                                  const std::vector<ProbeSeries>& gradients) const;

  std::vector<FittedParameter> parameters_;
  std::vector<MeasuredPoints> measured_;
  std::vector<Scene> scenes_;
  std::vector<int> run_of_;
  CaseResolver resolver_;
  std::optional<std::vector<std::string>> without_;
  std::vector<std::string> warnings_;
};

// Formats the values: "strength 3162.28, work 0.316".
std::string values_text(const std::vector<FittedParameter>& parameters, const DesignPoint& values);

}  // namespace tack
