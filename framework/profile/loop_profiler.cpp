#include "framework/profile/loop_profiler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <ctime>
#include <string>
#include <utility>

#include "framework/profile/loop_label.hpp"

namespace tack {
namespace {

using Clock = std::chrono::steady_clock;

// Pieces of a loop whose times exceed the processor time by this were interrupted [s]. Shorter
// differences come from reading the clocks.
constexpr double interruption_min = 20e-6;

// Sets a value for the lifetime of a scope.
template <class T>
class SetFor {
 public:
  SetFor(T& value, T during) : value_(value), before_(std::exchange(value, during)) {}
  ~SetFor() { value_ = before_; }
  SetFor(const SetFor&) = delete;
  SetFor& operator=(const SetFor&) = delete;

 private:
  T& value_;
  T before_;
};

// Returns the processor time of this thread [s].
double thread_seconds() {
  timespec time{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

double seconds_between(Clock::time_point begin, Clock::time_point end) {
  return std::chrono::duration<double>(end - begin).count();
}

// Returns the processor time of one call of `read` [s].
template <class Read>
double cost_of(const Read& read) {
  constexpr int calls = 1000;
  const double begun = thread_seconds();
  for (int i = 0; i < calls; ++i) read();
  return (thread_seconds() - begun) / calls;
}

std::string file_and_line(const std::string& label) { return label.substr(label.rfind(", ") + 2); }

// Returns the name of the code between two loops; null: the begin or the end of the run.
std::string name_between(const SourcePosition* first, const SourcePosition* second) {
  const std::string from = first ? loop_label(*first) : "the start", to = second ? loop_label(*second) : "the end";
  const bool one_function = first && second && function_label(first->function_name()) == function_label(second->function_name());
  return fmt::format("{} to {}", from, one_function ? file_and_line(to) : to);
}

}  // namespace

LoopProfiler::LoopProfiler(PhaseClock& clock, const std::vector<int>& cores)
    : clock_(clock), asked_(cores.at(0)), cores_(cores), read_cost_(cost_of([] { return Clock::now(); })),
      thread_read_cost_(cost_of(thread_seconds)) {
  cores_.insert(cores_.end(), {2, 4});
  std::sort(cores_.begin(), cores_.end());
  cores_.erase(std::unique(cores_.begin(), cores_.end()), cores_.end());
  active_.emplace(this);
  mark();
}

void LoopProfiler::run(const SourcePosition& loop, int chunks, const ChunkCall& chunk) {
  if (chunks <= 0) return;
  if (!in_loop_) return run_outermost(loop, chunks, chunk, nullptr);
  if (chunks == 1) return chunk(0);
  end_segment();
  trace_.begin_loop();
  run_chunks(chunks, chunk);
  trace_.end_loop();
}

void LoopProfiler::run(const SourcePosition& loop, int chunks, const ChunkCall& chunk, const ChunkOrder& order) {
  if (chunks <= 0) return;
  if (!in_loop_) return run_outermost(loop, chunks, chunk, &order);
  for (int c = 0; c < chunks; ++c) chunk(c);
}

void LoopProfiler::run_outermost(const SourcePosition& loop, int chunks, const ChunkCall& chunk, const ChunkOrder* order) {
  charge_serial();
  Loop& entry = loop_at(loop);
  for (int i = 0; i < phase_count; ++i)
    if (serial_[i] > 0) {
      LoopCost& cost = between_[{last_, &entry.position, static_cast<Phase>(i)}];
      cost.phase = static_cast<Phase>(i);
      ++cost.runs;
      cost.seconds += std::exchange(serial_[i], 0.0);
    }
  trace_.clear();
  const SetFor<bool> inside(in_loop_, true);
  clock_.skip();
  const double begun = thread_seconds();
  segment_ = Clock::now();
  run_chunks(chunks, chunk);
  const double total = thread_seconds() - begun - thread_read_cost_ - static_cast<double>(trace_.segments() + 1) * read_cost_;
  clock_.seconds();
  if (trace_.seconds() - total > interruption_min) trace_.lower_longest(total);
  LoopCost& cost = entry.cost;
  const double seconds = trace_.seconds();
  const bool divided = chunks > 1 || trace_.nested();
  ++cost.runs;
  cost.chunks += chunks;
  cost.seconds += seconds;
  cost.divided_runs += divided ? 1 : 0;
  cost.undivided += divided ? 0 : seconds;
  for (size_t k = 0; k < cores_.size(); ++k) cost.on_cores[k] += trace_.scheduled(cores_[k], order);
  last_ = &entry.position;
  mark();
}

void LoopProfiler::run_chunks(int chunks, const ChunkCall& chunk) {
  for (int c = 0; c < chunks; ++c) {
    chunk(c);
    end_segment();
    trace_.end_chunk();
  }
}

void LoopProfiler::end_segment() {
  const Clock::time_point now = Clock::now();
  trace_.add_segment(std::max(0.0, seconds_between(segment_, now) - read_cost_));
  segment_ = now;
}

LoopProfiler::Loop& LoopProfiler::loop_at(const SourcePosition& position) {
  const Phase phase = clock_.current();
  const Position key{position.file_name(), position.function_name(), position.line()};
  Loop& loop = loops_.try_emplace({key, phase}, Loop{position, {}}).first->second;
  loop.cost.phase = phase;
  loop.cost.on_cores.resize(cores_.size());
  return loop;
}

// Charges the processor time since mark() to the phases since then, in proportion to their time on
// the wall.
void LoopProfiler::charge_serial() {
  const double seconds = std::max(0.0, thread_seconds() - mark_ - thread_read_cost_);
  const PhaseClock::Seconds& phases = clock_.seconds();
  double wall = 0;
  for (int i = 0; i < phase_count; ++i) wall += phases[i] - phases_[i];
  if (wall <= 0) return;
  for (int i = 0; i < phase_count; ++i) serial_[i] += seconds * (phases[i] - phases_[i]) / wall;
}

void LoopProfiler::mark() {
  clock_.skip();
  phases_ = clock_.seconds();
  mark_ = thread_seconds();
}

CoreScaling LoopProfiler::finish() {
  charge_serial();
  active_.reset();
  CoreScaling scaling{cores_, asked_, {}};
  std::map<std::pair<std::string, Phase>, LoopCost> loops, serial;
  const auto add = [&](LoopCost& sum, const LoopCost& cost) {
    sum.phase = cost.phase;
    sum.runs += cost.runs;
    sum.chunks += cost.chunks;
    sum.divided_runs += cost.divided_runs;
    sum.seconds += cost.seconds;
    sum.undivided += cost.undivided;
    sum.on_cores.resize(cores_.size());
    for (size_t k = 0; k < cost.on_cores.size(); ++k) sum.on_cores[k] += cost.on_cores[k];
  };
  for (const auto& [key, loop] : loops_) add(loops[{loop_label(loop.position), loop.cost.phase}], loop.cost);
  for (int i = 0; i < phase_count; ++i)
    if (serial_[i] > 0) {
      LoopCost& cost = between_[{last_, nullptr, static_cast<Phase>(i)}];
      cost.phase = static_cast<Phase>(i);
      ++cost.runs;
      cost.seconds += serial_[i];
    }
  for (const auto& [key, cost] : between_)
    add(serial[{name_between(std::get<0>(key), std::get<1>(key)), cost.phase}], cost);
  for (auto& [key, cost] : serial) {
    cost.serial = true;
    cost.undivided = cost.seconds;
    std::fill(cost.on_cores.begin(), cost.on_cores.end(), cost.seconds);
  }
  for (auto* all : {&loops, &serial})
    for (auto& [key, cost] : *all) {
      cost.name = key.first;
      scaling.costs.push_back(std::move(cost));
    }
  scaling.sort();
  return scaling;
}

LoopProfiler::Pause::Pause(LoopProfiler* profiler) : profiler_(profiler) {
  if (profiler_) profiler_->charge_serial();
}

LoopProfiler::Pause::~Pause() {
  if (profiler_) profiler_->mark();
}

}  // namespace tack
