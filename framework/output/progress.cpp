#include "framework/output/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "framework/config/words.hpp"

namespace tack {
namespace {

constexpr double live_interval = 0.1;  // s
constexpr int plain_lines = 20;        // in a run
constexpr double silence = 5;          // s without output before an iteration is shown

double steady_seconds() {
  const auto now = std::chrono::steady_clock::now().time_since_epoch();
  return std::chrono::duration<double>(now).count();
}

}  // namespace

int terminal_width(int descriptor) {
  if (!isatty(descriptor)) return 0;
  constexpr int usual = 80;
  winsize size{};
  const bool known = ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0;
  return known ? size.ws_col : usual;
}

Progress::Progress(std::ostream& out, std::ostream* log, ProgressOptions options)
    : out_(out), log_(log), options_(std::move(options)) {
  if (!options_.clock) options_.clock = steady_seconds;
  start_clock_ = last_output_ = options_.clock();
}

Progress::~Progress() { finish(); }

void Progress::begin(double start, double end, bool end_is_limit) {
  start_ = start;
  end_ = end;
  end_is_limit_ = end_is_limit;
  start_clock_ = options_.clock();
  last_live_line_ = -1;
  printed_twentieths_ = 0;
}

double Progress::fraction(double time) const {
  return end_ > start_ ? std::clamp((time - start_) / (end_ - start_), 0.0, 1.0) : 1.0;
}

std::string Progress::time_left(const StepReport& report, double now) const {
  const double done = fraction(report.time);
  if (!(done > 0)) return "";
  return fmt::format("{}{} left", end_is_limit_ ? "at most " : "", duration_text((now - start_clock_) * (1 - done) / done));
}

std::string Progress::line_of(const StepReport& r, double now) const {
  std::string line =
      fmt::format("step {}  t {:.6g} s ({:.0f}%)  {}  {}", r.step, r.time,
                  std::floor(100 * fraction(r.time) + 1e-9),
                  counted(r.solve.iterations, "iteration"), counted(r.contacts, "contact"));
  // The smallest distance within an object is shown only if no other object is near: it never exceeds
  // the mesh size.
  if (std::isfinite(r.min_gap)) line += fmt::format("  gap {:.3g} m", r.min_gap);
  else if (std::isfinite(r.min_distance)) line += fmt::format("  self-distance {:.3g} m", r.min_distance);
  if (const int n = r.rejections.cutbacks(); n > 0) line += fmt::format("  {}", counted(n, "halving"));
  if (!r.converged) line += "  not converged";
  const std::string left = time_left(r, now);
  return left.empty() ? line : line + "  " + left;
}

void Progress::step(const StepReport& report) {
  const double now = options_.clock();
  const std::string line = line_of(report, now);
  log(line);
  if (options_.verbosity == Verbosity::quiet) return;
  if (options_.verbosity == Verbosity::verbose) return print(line);
  if (options_.live_width > 0) return show_live(line, now);
  const int twentieth = static_cast<int>(plain_lines * fraction(report.time) + 1e-9);
  if (twentieth <= printed_twentieths_) return;
  printed_twentieths_ = twentieth;
  print(line);
}

void Progress::iteration(int step, double time, int iteration, double residual) {
  const double now = options_.clock();
  if (now - last_output_ < silence) return;
  const std::string line = fmt::format("step {}  t {:.6g} s ({:.0f}%)  iteration {}  residual {:.3g}", step, time,
                                       std::floor(100 * fraction(time) + 1e-9), iteration, residual);
  log(line);
  if (options_.verbosity == Verbosity::quiet) return;
  if (options_.live_width > 0 && options_.verbosity == Verbosity::normal) return show_live(line, now);
  print(line);
}

// Leaves the cursor on the line. A longer line would wrap and could not be erased.
void Progress::show_live(const std::string& line, double now) {
  if (last_live_line_ >= 0 && now - last_live_line_ < live_interval) return;
  last_live_line_ = now;
  const auto room = static_cast<std::size_t>(std::max(1, options_.live_width - 1));
  out_ << '\r' << line.substr(0, room) << "\x1b[K" << std::flush;
  has_live_line_ = true;
}

void Progress::erase() {
  if (has_live_line_) out_ << "\r\x1b[K";
  has_live_line_ = false;
  last_live_line_ = -1;  // the next step shows the line at once
}

void Progress::print(std::string_view text) {
  erase();
  out_ << text << '\n' << std::flush;
}

void Progress::log(std::string_view text) {
  last_output_ = options_.clock();
  if (log_) *log_ << text << '\n' << std::flush;
}

void Progress::message(std::string_view text) {
  log(text);
  if (options_.verbosity != Verbosity::quiet) print(text);
}

void Progress::detail(std::string_view text) {
  log(text);
  if (options_.verbosity == Verbosity::verbose) print(text);
}

void Progress::warning(std::string_view text) { failure(fmt::format("warning: {}", text)); }

void Progress::failure(std::string_view text) {
  log(text);
  print(text);
}

void Progress::finish() {
  erase();
  out_ << std::flush;
}

}  // namespace tack
