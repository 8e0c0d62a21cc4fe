// Line search for the strong Wolfe conditions
//     E(q + t p) <= E(q) + c1 t p.g,   |p.g(q + t p)| <= c2 |p.g|
// by bracketing and interpolation (Nocedal and Wright, algorithms 3.5 and 3.6) among the feasible
// steps. If E still falls steeply at t_max, the step is t_max. Within the rounding error of E,
// slopes decide alone.
#include <algorithm>
#include <cmath>

#include "framework/config/field.hpp"
#include "solvers/line_search/line_search.hpp"

namespace tack {

class StrongWolfe : public LineSearch {
 public:
  void fields(Fields& f) override {
    f.number("decrease", c1_, units::none, "c1").range(0, 0.5);
    f.number("curvature", c2_, units::none, "c2").range(0.01, 1);
    f.integer("max_trials", max_trials_, "trial steps before giving up").at_least(1);
  }

  LineSearchResult search(Objective& objective, const VecX& q, const VecX& p, double slope,
                          double t_max) override {
    result_ = {};
    objective_ = &objective;
    q_ = &q;
    p_ = &p;
    start_ = {0, objective.value(), slope};
    noise_ = objective.value_noise();
    Point low = start_;
    Point trial = at(t_max);  // the longest feasible step first: Newton's, as a rule
    if (high(trial, low) || trial.slope >= 0) {
      if (!too_high(trial) && flat(trial)) return accept(trial);
      return zoom(low, trial);
    }
    // E still falls at the longest feasible step.
    return accept(trial);
  }

 private:
  struct Point {
    double t, value, slope;
  };

  Point at(double t) {
    objective_->move_to(*q_ + t * *p_);
    ++result_.evaluations;
    const double value = objective_->value();
    noise_ = std::max(noise_, objective_->value_noise());
    if (!std::isfinite(value)) return {t, std::numeric_limits<double>::infinity(), 0};
    return {t, value, objective_->gradient().dot(*p_)};
  }
  LineSearchResult accept(const Point& point) {
    result_.found = true;
    result_.step = point.t;
    return result_;
  }
  bool in_noise(const Point& a) const { return std::abs(a.value - start_.value) <= noise_; }
  bool too_high(const Point& a) const {
    if (in_noise(a)) return a.slope > (1 - 2 * c1_) * -start_.slope;
    return a.value > start_.value + c1_ * a.t * start_.slope;
  }
  bool high(const Point& a, const Point& low) const {
    return too_high(a) || (!in_noise(a) && a.value >= low.value);
  }
  bool flat(const Point& a) const { return std::abs(a.slope) <= -c2_ * start_.slope; }

  // Narrows the interval between `low`, the lowest trial with sufficient decrease, and `other`.
  LineSearchResult zoom(Point low, Point other) {
    while (result_.evaluations < max_trials_) {
      const Point trial = at(between(low, other));
      if (high(trial, low)) {
        other = trial;
        continue;
      }
      if (flat(trial)) return accept(trial);
      if (trial.slope * (other.t - low.t) >= 0) other = low;
      low = trial;
      if (std::abs(other.t - low.t) < 1e-10 * other.t) break;
    }
    if (low.t == 0) return result_;
    at(low.t);
    return accept(low);
  }

  // Returns the minimum of the parabola through low and the slope of `other`, kept away from both
  // ends.
  static double between(const Point& low, const Point& other) {
    const double width = other.t - low.t;
    double fraction = 0.5;
    if (std::isfinite(other.value)) {
      const double curvature = (other.slope - low.slope) / width;
      if (curvature != 0) fraction = -low.slope / curvature / width;
    }
    if (!(fraction > 0 && fraction < 1)) fraction = 0.5;
    return low.t + std::clamp(fraction, 0.1, 0.9) * width;
  }

  double c1_ = 1e-4, c2_ = 0.9;
  int max_trials_ = 40;

  LineSearchResult result_;
  Objective* objective_ = nullptr;
  const VecX *q_ = nullptr, *p_ = nullptr;
  Point start_{};
  double noise_ = 0;
};

TACK_REGISTER(LineSearch, StrongWolfe, "strong_wolfe",
              "Strong Wolfe conditions on the decrease and the slope, for quasi-Newton methods.",
              "Nocedal and Wright, Numerical Optimization, 3.5");

}  // namespace tack
