#include "framework/calibrate/calibrate_config.hpp"

#include <fmt/format.h>

#include <filesystem>

#include "framework/batch/batch_plan.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/experiment/file_kind.hpp"
#include "framework/output/file_names.hpp"

namespace tack {
namespace {

std::string name_of(const MeasuredExperiment& e) { return e.name.empty() ? std::filesystem::path(e.data).stem().string() : e.name; }

// Returns whether two experiments have a name of a file or of a case in common. fits/NAME.csv has the points of an experiment, fits/NAME_run.csv all samples of its run.
bool same_files(const std::string& one, const std::string& other) {
  const std::string a = file_name(one), b = file_name(other);
  return a == b || a + "_run" == b || b + "_run" == a || case_name({{"base", one}}) == case_name({{"base", other}});
}

// Returns an error message for names that are equal, or equal as names of files and cases.
std::string check_names(const std::vector<MeasuredExperiment>& experiments) {
  for (size_t i = 0; i < experiments.size(); ++i)
    for (size_t k = 0; k < i; ++k) {
      const std::string one = name_of(experiments[k]), other = name_of(experiments[i]);
      if (one == other) return fmt::format("two experiments are named '{}'; give each its own `name`", one);
      if (same_files(one, other))
        return fmt::format("the files of the experiments '{}' and '{}' would have the same names; let the names differ in letters, digits, - or ., and by more than an ending '_run'", one, other);
    }
  return "";
}

// Returns an error message if the noise is known for some of the experiments only; "" otherwise.
std::string check_noise(const std::vector<MeasuredExperiment>& experiments) {
  const auto known = std::count_if(experiments.begin(), experiments.end(), [](const MeasuredExperiment& e) { return !e.noise.is_null(); });
  if (known == 0 || known == static_cast<long>(experiments.size())) return "";
  return "some have a noise, some have none; give it for all of them, or for none, when it is estimated from the residuals";
}

std::string check_range(const FitConfig& f) {
  if (!f.from || !f.to) return "";  // both are required
  if (!(f.from->si < f.to->si)) return "must be below to";
  if (f.scale == FitScale::log && f.from->si <= 0) return "must be above zero on a logarithmic scale";
  if (f.start && (f.start->si < f.from->si || f.start->si > f.to->si)) return "the start is not between from and to";
  return "";
}

}  // namespace

void MeasuredExperiment::fields(Fields& f) {
  f.text("name", name, "name in tables; as the file of its data unless given").line();
  f.path("base", base, "an experiment").required();
  f.texts("set", set, "overrides of it, as `output.frame_interval=1 s`");
  f.path("data", data, "the measured curve: text in columns (CSV) with a line of names and units, `gap [mm], force [N]`").required();
  f.text("x", x, "abscissa: a probe of the scene, or time").line();
  f.text("y", y, "ordinate: a probe of the scene").required().line();
  f.text("x_column", x_column, "column of the abscissa in the data; as x unless given").line();
  f.text("y_column", y_column, "column of the measured values in the data; as y unless given").line();
  f.optional_quantity("from", from, "smallest abscissa that counts; the file's unless given");
  f.optional_quantity("to", to, "largest abscissa that counts; the file's unless given");
  f.raw("noise", noise, "standard deviation of a measured value: a fraction of the largest, as 2%, or in its unit. "
                        "Estimated from the residual of the fit unless given");
  f.number("weight", weight, units::none, "weight of each of its points").positive();
}

void FitConfig::fields(Fields& f) {
  f.optional_quantity("from", from, "lower bound").required();
  f.optional_quantity("to", to, "upper bound").required();
  f.optional_quantity("start", start, "initial guess, evaluated first; the middle unless given");
  f.choice("scale", scale,
           {{"automatic", FitScale::automatic, "logarithmic if from is above zero"},
            {"log", FitScale::log, "ratios count: 1 and 2 are as far apart as 10 and 20"},
            {"linear", FitScale::linear, "differences count"}},
           "scale of the range");
  f.text("as", as, "name in tables; the last element of the key unless given").line();
  f.raw("keys", keys, "scene keys that take the value, instead of the entry's own: a key, a list, or a map of keys or lists by name of the experiment");
  f.check("from", [this] { return check_range(*this); });
}

void SearchConfig::fields(Fields& f) {
  f.integer("design", design, "evaluations of the initial design (Sobol sequence); 0: 32 per parameter").at_least(0);
  f.integer("chains", chains, "multistart: local searches (BOBYQA), each from one of the best evaluations").at_least(0);
  f.integer("evaluations", evaluations, "largest number of evaluations of design and chains together; 0: no limit").at_least(0);
  f.flag("polish", polish, "local refinement at the end: Gauss-Newton steps (Levenberg-Marquardt)");
  f.flag("gradients", gradients, "use analytic sensitivities of the runs (output.gradients) where available, instead of finite differences");
  f.number("step", step, units::none, "first step of a local search, in logarithms; on a linear scale, in thirds of the range").positive().at_most(1);
  f.number("difference", difference, units::none, "increment of finite differences, on the scale of `step`").positive().at_most(0.5);
  f.number("tolerance", tolerance, units::none, "parameter tolerance at the end of a local search, on the scale of `step`").positive().at_most(0.1);
}

void CalibrateConfig::fields(Fields& f) {
  f.text("name", name, "name of the results folder").required().line();
  f.text("about", about, "purpose of the calibration");
  f.list("experiments", experiments, "experiments: scenes, each with a measured curve").required().nonempty();
  f.texts("set", set, "overrides of all experiments, as `time.step=1 ms`");
  f.map("fit", fit, "fitted parameters, by scene key").required();
  f.object("search", search, "settings of the search");
  f.integer("threads", threads, "threads per run").at_least(1);
  f.integer("jobs", jobs, "concurrent runs; 0: as many as cores allow").at_least(0);
  f.optional_number("memory", memory, units::none, "memory limit of a run in GB; a run that needs more fails").positive();
  f.optional_number("time_limit", time_limit, units::time, "wall time of a run, after which it is stopped and counts as failed").positive();
  f.object("slurm", slurm, "resources that `--slurm` requests");
  f.check("slurm", [this]() -> std::string {
    return slurm.requeues == 0 ? "" : "requeues: runs of a calibration write no checkpoints; give them a longer `time`";
  });
  f.check("experiments", [this] { return check_names(experiments); });
  f.check("experiments", [this] { return check_noise(experiments); });
  f.check("fit", [this]() -> std::string { return fit.empty() ? "name at least one parameter: a key of the experiments with its range" : ""; });
}

CalibrateConfig load_calibration(const std::string& path, const std::vector<std::string>& overrides) {
  Value root = parse_file(path);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  refuse_other_kind(root, FileKind::calibration);
  CalibrateConfig config;
  bind(root, config, "the calibration");
  for (MeasuredExperiment& e : config.experiments) e.name = name_of(e);
  return config;
}

}  // namespace tack
