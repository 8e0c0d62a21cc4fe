#include "framework/calibrate/bobyqa.hpp"

#include <nlopt.h>

#include <algorithm>
#include <exception>
#include <memory>
#include <new>

namespace tack {
namespace {

struct Callback {
  const std::function<std::optional<double>(const std::vector<double>&)>& value;
  nlopt_opt opt;
  std::exception_ptr failure;
};

// Called from C code: must not throw.
double evaluate(unsigned size, const double* u, double*, void* data) noexcept {
  Callback& callback = *static_cast<Callback*>(data);
  try {
    if (const auto found = callback.value({u, u + size})) return *found;
  } catch (...) {
    callback.failure = std::current_exception();
  }
  nlopt_force_stop(callback.opt);
  return 0;
}

}  // namespace

void bobyqa(const BobyqaSettings& s, std::vector<double> start,
            const std::function<std::optional<double>(const std::vector<double>&)>& value) {
  const unsigned size = static_cast<unsigned>(start.size());
  const nlopt_algorithm algorithm = size > 1 ? NLOPT_LN_BOBYQA : NLOPT_LN_NELDERMEAD;
  const std::unique_ptr<nlopt_opt_s, void (*)(nlopt_opt)> opt(nlopt_create(algorithm, size), nlopt_destroy);
  if (!opt) throw std::bad_alloc();
  Callback callback{value, opt.get(), nullptr};
  nlopt_set_min_objective(opt.get(), evaluate, &callback);
  nlopt_set_lower_bounds(opt.get(), s.low.data());
  nlopt_set_upper_bounds(opt.get(), s.high.data());
  std::vector<double> steps;  // models need room for a step to both sides of a bound
  for (unsigned i = 0; i < size; ++i) {
    steps.push_back(std::min(s.step, 0.25 * (s.high[i] - s.low[i])));
    start[i] = std::clamp(start[i], s.low[i], s.high[i]);
  }
  nlopt_set_initial_step(opt.get(), steps.data());
  nlopt_set_maxeval(opt.get(), s.evaluations);
  nlopt_set_xtol_abs1(opt.get(), s.tolerance);
  double least = 0;
  nlopt_optimize(opt.get(), start.data(), &least);  // status ignored: every point is recorded
  if (callback.failure) std::rethrow_exception(callback.failure);
}

}  // namespace tack
