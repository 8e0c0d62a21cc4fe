// A function of one unknown as an objective.
#pragma once

#include <functional>

#include "framework/core/objective.hpp"

namespace tack {

class Line : public Objective {
 public:
  Line(std::function<double(double)> value, std::function<double(double)> slope, double noise = 0)
      : value_(std::move(value)), slope_(std::move(slope)), noise_(noise) {}
  int size() const override { return 1; }
  void move_to(const VecX& q) override { x = q(0); }
  double value() override { return ++count_, value_(x); }
  double value_noise() const override { return noise_; }
  const VecX& gradient() override { return gradient_ = VecX::Constant(1, slope_(x)); }
  const BlockMatrix& hessian(const HessianRequest&) override { return matrix_; }
  int value_count() const override { return count_; }

  double x = 0;

 private:
  std::function<double(double)> value_, slope_;
  double noise_;
  int count_ = 0;
  VecX gradient_;
  BlockMatrix matrix_;
};

}  // namespace tack
