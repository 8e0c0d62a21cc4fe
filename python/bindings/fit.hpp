// A calibration for optimisers in Python: its parameters, and evaluations of points by the runs of
// `tack calibrate`.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/calibrate/calibrate_run.hpp"
#include "framework/calibrate/case_evaluator.hpp"
#include "python/bindings/arrays.hpp"

namespace tack::python {

class Fit {
 public:
  // program: an executable that runs a case. jobs, threads: 0: as the file says. Throws InputError.
  Fit(const std::string& path, const std::vector<std::string>& set, const std::string& output,
      const std::string& program, int jobs, int threads, bool failed);

  std::string folder() const { return folder_.root.string(); }
  // Returns a dictionary for each parameter, in the order of points.
  py::list parameters() const;
  // Returns a dictionary for each experiment, in the order of residuals.
  py::list experiments() const;
  // Returns count points that fill the ranges evenly: values in SI.
  std::vector<DesignPoint> design(int count) const;
  // Evaluates points side by side; the thread that calls this starts the processes. Values are
  // rounded to six digits. Throws InputError for a value out of its range.
  py::list evaluate(const std::vector<std::vector<double>>& points, bool derivatives);
  // Returns the derivatives of the residuals by the values of a point (SI), as a calibration finds
  // them: by sensitivities of the runs, or else by central differences.
  py::dict jacobian(const std::vector<double>& point);
  // Writes the table of the runs. Further evaluations may follow.
  void write_tables();

 private:
  DesignPoint checked(const std::vector<double>& values) const;
  template <class Act>
  void without_interpreter(const Act& act);

  CalibrateConfig config_;
  FittedScenes scenes_;
  CalibrationFolder folder_;
  std::unique_ptr<CaseEvaluator> evaluator_;
};

void bind_fit(py::module_& module);

}  // namespace tack::python
