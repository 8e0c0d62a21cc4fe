// tack calibrate: fits scene parameters of experiments to measured curves.
#include <fmt/format.h>
#include <unistd.h>

#include <chrono>
#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/app/interrupt_signals.hpp"
#include "framework/batch/batch_estimate.hpp"
#include "framework/batch/batch_progress.hpp"
#include "framework/batch/resolved_case.hpp"
#include "framework/calibrate/calibrate_run.hpp"
#include "framework/config/words.hpp"
#include "framework/output/progress.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/utf8_prefix.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

constexpr double longest_trial_seconds = 3;  // s
// Typical number of points per parameter in all searches after the design.
constexpr int typical_points_by_runs = 45, typical_points_by_derivatives = 30;

// Prints the current phase: on a terminal in a line that is rewritten, elsewhere as a line when the
// phase begins.
class CalibrationProgress {
 public:
  CalibrationProgress(const std::vector<FittedParameter>& parameters, int live_width, bool quiet) : parameters_(parameters), live_width_(live_width), quiet_(quiet) {}
  ~CalibrationProgress() { erase(); }

  void begin(const std::string& phase, int points, const PointEvaluation* best) {
    phase_ = phase;
    points_ = points;
    done_ = 0;
    if (quiet_) return;
    erase();
    fmt::print("{}{}{}\n", phase, points > 0 ? fmt::format(", {}", counted(points, "evaluation")) : "",
               best ? fmt::format("; best so far: {}, misfit {:.4g}", values_text(parameters_, best->values), best->misfit) : "");
    std::fflush(stdout);
  }
  void evaluated(const PointEvaluation& e) {
    ++done_;
    failed_ += e.good ? 0 : 1;
    least_ = std::min(least_, e.misfit);
  }
  void tick() {
    if (quiet_ || live_width_ <= 0 || Clock::now() - shown_ < std::chrono::milliseconds(500)) return;
    shown_ = Clock::now();
    erase();
    const std::string line = fmt::format("  {}: {}{} done, {} failed in total, smallest misfit {:.4g}", phase_, done_, points_ > 0 ? fmt::format(" of {}", points_) : "", failed_, least_);
    fmt::print("{}", utf8_prefix(line, static_cast<size_t>(std::max(1, live_width_ - 1))));
    std::fflush(stdout);
    live_ = true;
  }

 private:
  void erase() {
    if (live_) fmt::print("\r\x1b[K");
    live_ = false;
  }

  const std::vector<FittedParameter>& parameters_;
  int live_width_;
  bool quiet_, live_ = false;
  std::string phase_;
  int points_ = 0, done_ = 0, failed_ = 0;
  double least_ = std::numeric_limits<double>::infinity();
  Clock::time_point shown_ = Clock::now();
};

void show_plan(const CalibrateConfig& config, FittedScenes& scenes, BatchDescription d) {
  for (const FittedParameter& n : scenes.parameters())
    fmt::print("  {} from {:.6g} to {:.6g}{}, first {:.6g}, {}\n", n.name, n.from, n.to, n.unit == "1" ? "" : " " + n.unit, n.start, n.log ? "logarithmic" : "linear");
  for (const MeasuredPoints& m : scenes.measured())
    fmt::print("  {}: {} over {}, {} of {}\n", m.name, m.y, m.x, counted(static_cast<long>(m.curve.size()), "point"), m.curve.path);
  std::vector<const BatchCase*> open;
  for (int run = 0; run < scenes.runs(); ++run) d.plan.cases.push_back(scenes.case_of(run, scenes.start()));
  for (const BatchCase& one : d.plan.cases) open.push_back(&one);
  const int parameters = static_cast<int>(scenes.parameters().size());
  bool from_runs = false;
  if (config.search.gradients && config.search.polish)
    for (const std::string& why : scenes.without_derivatives()) from_runs = from_runs || why.empty();
  int points = (config.search.design > 0 ? config.search.design : 32 * parameters) + (from_runs ? typical_points_by_derivatives : typical_points_by_runs) * parameters;
  if (config.search.evaluations > 0) points = std::min(points, config.search.evaluations + 5 * parameters);
  const BatchEstimate estimate = estimate_of(fs::read_symlink("/proc/self/exe").string(), BatchFolder{}, d.plan, d.limits, open, longest_trial_seconds);
  double of_point = 0;
  for (const auto& [base, seconds] : estimate.of_case) {
    fmt::print("a run of {} takes {} {}\n", base, estimate.about(), short_duration(seconds));
    of_point += seconds;
  }
  fmt::print("about {} evaluations of {} each, {} concurrent: {} {} in total{}; nothing was run yet\n", points, counted(scenes.runs(), "run"), d.limits.jobs,
             estimate.about(), short_duration(of_point * points / d.limits.jobs), estimate.condition());
}

}  // namespace

int calibrate_command(const CalibrateOptions& options) {
  let_signals_interrupt();
  const CalibrateConfig config = load_calibration(options.file.file, options.file.overrides);
  FittedScenes scenes(config, program_digest());
  if (!options.quiet)
    for (const std::string& line : scenes.warnings()) fmt::print("warning: {}\n", line);
  CalibrationSettings settings;
  settings.file = fs::absolute(options.file.file).lexically_normal().string();
  settings.output = options.output;
  settings.program = fs::read_symlink("/proc/self/exe").string();
  settings.provenance = provenance_of(options.command_line, options.threads > 0 ? options.threads : config.threads);
  settings.cases = calibration_description(config, scenes, settings.file, settings.provenance, options.jobs, options.threads);
  settings.slurm = options.slurm;
  settings.rerun_failed = options.failed;
  if (options.dry_run) {
    show_plan(config, scenes, std::move(settings.cases));
    return exit_done;
  }
  CalibrationProgress progress(scenes.parameters(), terminal_width(STDOUT_FILENO), options.quiet);
  CalibrationObserver observer;
  observer.print = [&](const std::string& line) {
    if (!options.quiet || line.starts_with("interrupted")) fmt::print("{}\n", line);
  };
  observer.phase = [&](const std::string& phase, int points, const PointEvaluation* best) { progress.begin(phase, points, best); };
  observer.evaluated = [&](const PointEvaluation& e) { progress.evaluated(e); };
  observer.tick = [&] { progress.tick(); };
  try {
    const CalibrationRun run = run_calibration(config, scenes, settings, observer);
    if (options.quiet) return exit_done;
    fmt::print("{}: {} of {}, {} now\n{}results in {}\n", config.name, counted(static_cast<long>(run.calibration.search.rows.size()), "evaluation"),
               counted(static_cast<long>(scenes.parameters().size()), "parameter"), counted(run.started, "run"), summary_text(run.calibration, scenes),
               run.folder.root.string());
  } catch (const Interrupted&) {
    return exit_interrupted;
  }
  return exit_done;
}

}  // namespace tack
