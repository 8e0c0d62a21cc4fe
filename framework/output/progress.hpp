// What a run tells while it runs. On a terminal that can be rewritten, one live line
//   step 120  t 1.2 s (40%)  4 iterations  310 contacts  gap 0.0001 m  2m05s left
// at most ten times a second; elsewhere such lines one below the other, every twentieth of the run.
// A step that takes long tells an iteration every five seconds. All of it, and every step, also goes to the log.
// Not for several threads at once.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "framework/stepping/step_report.hpp"

namespace tack {

enum class Verbosity {
  quiet,    // warnings only
  normal,   // and messages and progress
  verbose,  // and details and a line for every step, instead of the live line
};

struct ProgressOptions {
  Verbosity verbosity = Verbosity::normal;
  int live_width = 0;  // columns of a terminal to keep a live line on; 0: none, plain lines
  std::function<double()> clock;  // s; default: a steady clock
};

// The columns of the terminal behind a file descriptor, 0 if it is no terminal: for live_width.
int terminal_width(int descriptor);

class Progress {
 public:
  // `log` may be null. Both streams must outlive this object.
  Progress(std::ostream& out, std::ostream* log, ProgressOptions options = {});
  ~Progress();  // erases the live line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // The run goes from `start` to `end` [s]; the time that is left is reckoned from here on.
  void begin(double start, double end);
  void step(const StepReport& report);
  // An iteration of the step that is under way, which shows it as far as nothing was told for a while. `residual`:
  // in tolerances.
  void iteration(int step, double time, int iteration, double residual);

  void message(std::string_view text);
  void detail(std::string_view text);  // on the terminal only if verbose
  void warning(std::string_view text);

  // Erases the live line, so that others may write.
  void finish();

 private:
  void print(std::string_view text);
  void log(std::string_view text);
  void erase();
  void show_live(const std::string& line, double now);
  std::string time_left(const StepReport& report, double now) const;
  std::string line_of(const StepReport& report, double now) const;
  double fraction(double time) const;

  std::ostream& out_;
  std::ostream* log_;
  ProgressOptions options_;
  double start_ = 0, end_ = 0;  // s, simulated
  double begun_ = 0;            // s, on the clock
  double told_ = 0;             // s, when anything was last told
  double shown_ = -1;           // s, when the live line was last written; negative: never
  int printed_ = 0;             // twentieths of the run already told in plain lines
  bool live_ = false;           // a live line stands on the terminal
};

}  // namespace tack
