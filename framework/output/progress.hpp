// Progress reports of a run. A terminal shows one live line, at most ten times a second:
//    step 120  t 1.2 s (40%)  4 iterations  310 contacts  gap 0.0001 m  2m05s left
// Other streams get such lines one below the other, every twentieth of the run. A long step shows
// an iteration every five seconds. Everything, and every step, also goes to the log. Not
// thread-safe.
#pragma once

#include <functional>
#include <ostream>
#include <string>
#include <string_view>

#include "framework/stepping/step_report.hpp"

namespace tack {

enum class Verbosity {
  quiet,    // warnings only
  normal,   // warnings, messages and progress
  verbose,  // also details and a line per step, in place of the live line
};

struct ProgressOptions {
  Verbosity verbosity = Verbosity::normal;
  int live_width = 0;             // columns of a terminal for a live line; 0: plain lines
  std::function<double()> clock;  // s; default: a steady clock
};

// Returns the columns of the terminal of a file descriptor, for live_width; 0: no terminal.
int terminal_width(int descriptor);

class Progress {
 public:
  // `log` may be null. Both streams must outlive this object.
  Progress(std::ostream& out, std::ostream* log, ProgressOptions options = {});
  ~Progress();  // erases the live line
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  // Begins a run from `start` to `end` [s]. Estimates of the remaining time count from here.
  // end_is_limit: the run may end earlier, with its protocols.
  void begin(double start, double end, bool end_is_limit = false);
  void step(const StepReport& report);
  // Shows an iteration of the present step if nothing was shown for a while. residual: in units of
  // the tolerance.
  void iteration(int step, double time, int iteration, double residual);

  void message(std::string_view text);
  void detail(std::string_view text);  // on the terminal only if verbose
  void warning(std::string_view text);
  void failure(std::string_view text);  // printed however quiet the run is

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
  bool end_is_limit_ = false;
  double start_clock_ = 0;      // s, on the clock
  double last_output_ = 0;      // s, time of the last output
  double last_live_line_ = -1;  // s, time of the last live line; negative: never
  int printed_twentieths_ = 0;  // twentieths of the run shown in plain lines
  bool has_live_line_ = false;  // the terminal shows a live line
};

}  // namespace tack
