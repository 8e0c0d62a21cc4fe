// Number and duration of the evaluations of each term in a run (`tack profile`). The clock of the
// run holds the table; without a table nothing is timed. Timed units are whole evaluations, or
// chunks of them where several terms are evaluated at once, never single stencils.
#pragma once

#include <array>
#include <chrono>
#include <map>

namespace tack {

class Term;

/// Kinds of evaluations of a term.
enum class Evaluation { value, gradient, hessian, count };  // hessian: with the gradient
inline constexpr int evaluation_count = static_cast<int>(Evaluation::count);

/// Count and time of the evaluations of a term, by kind.
struct TermTime {
  std::array<long, evaluation_count> evaluations{};
  std::array<double, evaluation_count> seconds{};
};

/// Counts and times of all terms.
class TermTimes {
 public:
  void add(const Term* term, Evaluation kind, double seconds) {
    TermTime& time = times_[term];
    ++time.evaluations[static_cast<int>(kind)];
    time.seconds[static_cast<int>(kind)] += seconds;
  }
  /// Returns the counts and times of a term; zeros for a term that was never evaluated.
  TermTime of(const Term* term) const {
    const auto found = times_.find(term);
    return found == times_.end() ? TermTime() : found->second;
  }

 private:
  std::map<const Term*, TermTime> times_;
};

/// Charges the lifetime of a scope to a term; does nothing without a table.
class TermScope {
 public:
  TermScope(TermTimes* times, const Term* term, Evaluation kind)
      : times_(times), term_(term), kind_(kind) {
    if (times_) start_ = Clock::now();
  }
  ~TermScope() {
    if (times_)
      times_->add(term_, kind_, std::chrono::duration<double>(Clock::now() - start_).count());
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
