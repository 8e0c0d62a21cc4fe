#include "framework/core/term_values.hpp"

#include <chrono>

#include "framework/core/term_times.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Writes the value of the term; returns the time that it took if asked for [s].
double evaluate(const Term& term, const VecX& x, bool timed, double& value) {
  using Clock = std::chrono::steady_clock;
  if (!timed) return value = term.value(x), 0.0;
  const Clock::time_point start = Clock::now();
  value = term.value(x);
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}  // namespace

bool is_small(const Term& term) {
  if (term.dynamic() || term.ranges().empty()) return false;
  int stencils = 0;
  for (const StencilBatch& batch : term.batches()) stencils += batch.count;
  return stencils <= chunk_size;
}

TermValues::TermValues(std::span<const Term* const> terms) : terms_(terms.begin(), terms.end()) {
  for (int t = 0; t < static_cast<int>(terms_.size()); ++t) (is_small(*terms_[t]) ? small_ : others_).push_back(t);
}

std::vector<double> TermValues::at(const VecX& x, TermTimes* times) const {
  std::vector<double> values(terms_.size()), seconds(times ? terms_.size() : 0);
  const auto one = [&](int t) {
    const double time = evaluate(*terms_[t], x, times != nullptr, values[t]);
    if (times) seconds[t] = time;
  };
  for_each(static_cast<int>(small_.size()), [&](int k) { one(small_[k]); }, small_terms_per_chunk);
  for (const int t : others_) one(t);
  if (times)
    for (size_t t = 0; t < terms_.size(); ++t) times->add(terms_[t], Evaluation::value, seconds[t]);
  return values;
}

}  // namespace tack
