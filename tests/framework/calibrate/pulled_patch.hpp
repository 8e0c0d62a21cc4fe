// A bonded patch that a machine of finite stiffness pulls off: force over the displacement of the
// machine in closed form. With soft machines the force drops suddenly.
#pragma once

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "framework/calibrate/point_queue.hpp"

namespace tack {

struct PulledPatch {
  int points = 120;
  double displacement_max = 4e-4;  // of the machine [m]

  // Returns the force per area [Pa] of a bilinear law. Its onset is a quarter of 1e-4 m for
  // strength 10 kPa and work 1 J/m^2.
  std::vector<double> curve(double strength, double work, double stiffness) const {
    const double end = 2 * work / strength, onset = 0.25 * work / strength,
                 softening = strength / (end - onset);
    double widest = onset;
    bool broken = false;
    std::vector<double> force;
    for (int i = 1; i <= points; ++i) {
      const double displacement = displacement_max * i / points;
      double gap = displacement;
      if (!broken) {
        const double secant = strength * (end - widest) / (end - onset) / widest;
        gap = stiffness * displacement / (stiffness + secant);
        if (gap > widest) {
          if (stiffness > softening)
            gap = (stiffness * displacement - softening * end) / (stiffness - softening);
          else broken = true;
          broken = broken || gap >= end;
          widest = std::max(widest, gap);
        }
      }
      force.push_back(broken ? 0 : stiffness * (displacement - gap));
    }
    return force;
  }
};

// Returns the force of an opening double cantilever (Euler-Bernoulli arms, crack longer by a
// fraction of the cohesive zone). It hardly depends on the strength.
inline std::vector<double> cantilever_curve(double strength, double work) {
  const double stiffness = 8.3e-7, width = 1e-2;  // E I [N m^2], m
  const double zone = std::pow(stiffness * (2 * work / strength) / (strength * width), 0.25);
  std::vector<double> force;
  for (int i = 0; i < 120; ++i) {
    const double opening = 1e-3 + 5e-3 * i / 119;
    const double crack =
        std::pow(9 * stiffness * opening * opening / (2 * work * width), 0.25) + 0.1 * zone;
    force.push_back(3 * stiffness * opening / std::pow(crack, 3));
  }
  return force;
}

// Normally distributed numbers of mean 0 and standard deviation 1, equal with every library.
class Noise {
 public:
  explicit Noise(unsigned seed) : random_(seed) {}
  double next() {
    const double u = unit(), v = unit();
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.14159265358979323846 * v);
  }

 private:
  double unit() { return (static_cast<double>(random_() >> 11) + 0.5) * 0x1p-53; }
  std::mt19937_64 random_;
};

// Evaluates a model in closed form, once per request and in their order.
class ModelEvaluator : public Evaluator {
 public:
  using Model = std::function<std::vector<double>(const DesignPoint&)>;
  ModelEvaluator(Model model, std::vector<double> data, double scale)
      : model_(std::move(model)), data_(std::move(data)), scale_(scale) {}

  // Also gives derivatives of `smooth` by each parameter whose entry of `without` is empty; the
  // model itself may be noisy.
  ModelEvaluator(Model model, std::vector<double> data, double scale, Model smooth,
                 std::vector<std::string> without)
      : model_(std::move(model)), smooth_(std::move(smooth)), data_(std::move(data)), scale_(scale),
        without_(std::move(without)) {}
  std::vector<std::string> without_derivatives() override { return without_; }

  void serve(PointQueue& queue) override {
    for (queue.wait_for_all(); !queue.finished(); queue.wait_for_all())
      for (PointQueue::Request* request : queue.take()) {
        PointEvaluation e = evaluation(request->values);
        e.asked_derivatives = request->derivatives;
        if (request->derivatives && e.good) e.derivatives = derivatives(request->values);
        differentiated += request->derivatives ? 1 : 0;
        queue.answer(*request, std::move(e));
      }
  }
  int runs = 0, differentiated = 0;

 private:
  PointEvaluation evaluation(const DesignPoint& values) {
    ++runs;
    PointEvaluation e{values, true, "done", "", 0, {}, model_(values), {}, false, {}};
    if (e.residuals.empty())
      return {values,
              false,
              "simulation failed",
              "",
              std::numeric_limits<double>::infinity(),
              {},
              {},
              {},
              false,
              {}};
    for (size_t i = 0; i < data_.size(); ++i) {
      e.residuals[i] = (e.residuals[i] - data_[i]) / scale_;
      e.misfit += e.residuals[i] * e.residuals[i];
    }
    e.misfits = {e.misfit};
    return e;
  }

  // By u = ln(value).
  std::vector<std::vector<double>> derivatives(const DesignPoint& values) const {
    std::vector<std::vector<double>> all;
    for (size_t i = 0; i < values.size(); ++i) {
      all.emplace_back();
      if (!without_[i].empty()) continue;
      DesignPoint other = values;
      other[i] *= 1 + 1e-7;
      const std::vector<double> a = smooth_(values), b = smooth_(other);
      for (size_t k = 0; k < a.size(); ++k) all.back().push_back((b[k] - a[k]) / 1e-7 / scale_);
    }
    return all;
  }

  Model model_, smooth_;
  std::vector<double> data_;
  double scale_;
  std::vector<std::string> without_;
};

}  // namespace tack
