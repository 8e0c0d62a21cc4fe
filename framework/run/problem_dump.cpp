#include "framework/run/problem_dump.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns the number after `key=`; 0 for another request or a number that is not positive.
int number_of(const std::string& request, const std::string& key) {
  if (!request.starts_with(key + "=")) return 0;
  int number = 0;
  const char* end = request.data() + request.size();
  const auto [stop, status] = std::from_chars(request.data() + key.size() + 1, end, number);
  return status == std::errc() && stop == end ? number : 0;
}

}  // namespace

ProblemDump::ProblemDump(const std::vector<std::string>& requests) {
  for (const std::string& request : requests) {
    const int step = number_of(request, "step"), hardest = number_of(request, "hardest");
    if (step > 0) steps_.insert(step);
    if (hardest > 0) hardest_ = std::max(hardest_, hardest);
    if (step <= 0 && hardest <= 0)
      throw InputError(fmt::format("--dump-problem {}: expects step=K, counted from 1, or hardest=N", request));
  }
}

void ProblemDump::before(const State& state, double h, const Store& store) {
  if (steps_.erase(state.step + 1)) store(state, h, -1);
  if (hardest_ > 0) next_ = {state, h, 0};
}

void ProblemDump::after(int iterations) {
  if (hardest_ == 0) return;
  next_.iterations = iterations;
  const auto place = std::find_if(candidates_.begin(), candidates_.end(),
                                  [&](const Candidate& c) { return c.iterations < iterations; });
  if (place == candidates_.end() && static_cast<int>(candidates_.size()) >= hardest_) return;
  candidates_.insert(place, std::move(next_));
  if (static_cast<int>(candidates_.size()) > hardest_) candidates_.pop_back();
}

void ProblemDump::finish(const Store& store) {
  for (const Candidate& c : candidates_) store(c.state, c.h, c.iterations);
  candidates_.clear();
}

}  // namespace tack
