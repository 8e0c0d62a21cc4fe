#include "framework/batch/batch_progress.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/config/words.hpp"
#include "geometry/utf8_prefix.hpp"

namespace tack {
namespace {

constexpr double live_interval = 0.5;  // s

std::string bar(double fraction) {
  constexpr int width = 20;
  const int full = static_cast<int>(width * fraction + 0.5);
  return std::string(static_cast<size_t>(full), '#') + std::string(static_cast<size_t>(width - full), '.');
}

}  // namespace

std::string short_duration(double seconds) {
  return seconds < 10 ? fmt::format("{:.3g}s", std::round(seconds * 10) / 10) : duration_text(seconds);
}

BatchProgress::BatchProgress(std::ostream& out, size_t cases, size_t open, int jobs, int live_width, bool quiet)
    : out_(out), cases_(cases), open_(open), jobs_(jobs), live_width_(live_width), quiet_(quiet) {}

BatchProgress::~BatchProgress() {
  erase();
  out_ << std::flush;
}

BatchObserver BatchProgress::observer() {
  return {[this](const BatchCase& one, const CaseState& state) { ended(one, state); },
          [this](const std::vector<BatchObserver::Running>& running, size_t waiting) { tick(running, waiting); }};
}

double BatchProgress::seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begun_).count();
}

void BatchProgress::ended(const BatchCase& one, const CaseState& state) {
  ++ended_;
  const bool bad = failed(state.status);
  failed_ += bad ? 1 : 0;
  if (quiet_ && !bad) return;
  erase();
  const size_t done = cases_ - open_ + ended_;
  out_ << fmt::format("[{}/{}] {}  {}  {}{}\n", done, cases_, one.name, bad ? fmt::format("FAILED: {}", to_string(state.status)) : to_string(state.status),
                      short_duration(state.wall_seconds), state.error.empty() ? "" : "  " + state.error)
       << std::flush;
}

void BatchProgress::tick(const std::vector<BatchObserver::Running>& running, size_t waiting) {
  const double now = seconds();
  if (quiet_ || live_width_ <= 0 || (shown_ >= 0 && now - shown_ < live_interval)) return;
  double work = static_cast<double>(ended_);
  std::vector<std::string> lines{""};
  for (const auto& [one, run] : running) {
    const double fraction = run->fraction();
    work += fraction;
    lines.push_back(fmt::format("  [{}] {:3.0f}%  {}  {}", bar(fraction), 100 * fraction, short_duration(run->seconds()), one->name));
  }
  const double left = work > 0 ? now * (static_cast<double>(open_) - work) / work : 0;
  lines[0] = fmt::format("{} of {} done, {} running, {} waiting, {} failed{}", cases_ - open_ + ended_, cases_, running.size(), waiting, failed_,
                         work > 0 ? ", " + short_duration(left) + " left" : "");
  erase();
  const size_t width = static_cast<size_t>(std::max(1, live_width_ - 1));
  for (const std::string& line : lines) out_ << utf8_prefix(line, width) << '\n';
  out_ << std::flush;
  lines_ = static_cast<int>(lines.size());
  shown_ = now;
}

void BatchProgress::erase() {
  if (lines_ > 0) out_ << fmt::format("\x1b[{}A\r\x1b[J", lines_);
  lines_ = 0;
  shown_ = -1;
}

}  // namespace tack
