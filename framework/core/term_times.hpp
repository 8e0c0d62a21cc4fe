// How often each term of the potential is evaluated in a run, and how long that takes: for those who ask
// (`tack profile`). The clock of a run holds the table, and without one nothing is timed. Nothing is measured per
// stencil: whole evaluations are, or chunks of them where those of several terms are under way at once.
#pragma once

#include <array>
#include <chrono>
#include <map>

namespace tack {

class Term;

enum class Evaluation { value, gradient, hessian, count };  // with the Hessian comes the gradient
inline constexpr int evaluation_count = static_cast<int>(Evaluation::count);

struct TermTime {
  std::array<long, evaluation_count> evaluations{};
  std::array<double, evaluation_count> seconds{};
};

class TermTimes {
 public:
  void add(const Term* term, Evaluation kind, double seconds) {
    TermTime& time = times_[term];
    ++time.evaluations[static_cast<int>(kind)];
    time.seconds[static_cast<int>(kind)] += seconds;
  }
  // Zeros for a term that was never evaluated.
  TermTime of(const Term* term) const {
    const auto found = times_.find(term);
    return found == times_.end() ? TermTime() : found->second;
  }

 private:
  std::map<const Term*, TermTime> times_;
};

// Charges the lifetime of a scope to a term; to nobody without a table.
class TermScope {
 public:
  TermScope(TermTimes* times, const Term* term, Evaluation kind) : times_(times), term_(term), kind_(kind) {
    if (times_) start_ = Clock::now();
  }
  ~TermScope() {
    if (times_) times_->add(term_, kind_, std::chrono::duration<double>(Clock::now() - start_).count());
  }
  TermScope(const TermScope&) = delete;
  TermScope& operator=(const TermScope&) = delete;

 private:
  using Clock = std::chrono::steady_clock;
  TermTimes* times_;
  const Term* term_;
  Evaluation kind_;
  Clock::time_point start_;
};

}  // namespace tack
