// Diagonally implicit Runge-Kutta methods whose last stage is the end of the step, with contact as
// an impulse. A method is its tableau: see sdirk2.cpp, tr_bdf2.cpp.
//
// With the accelerations b by all terms but the dynamic ones, node 0 the start of the step and node
// i the end of stage i, at the time c_i h:
//     v_i = v_0 + h sum_j A_ij b_j + sum_j J_j,
//     x_i = x_0 + c_i h v_0 + h^2 sum_j (A A)_ij b_j + sum_j J_j ((c_i - c_j) h + k_j H_j),
// sums up to j = i. J_j = H_j (c_j + s_j) is the impulse of contact over stage j, of length H_j
// (contact_change.hpp). The tableau itself would apply a force of one stage again in later ones,
// with a factor above 1 where it acts as an extrapolation: an impact within a stage would return
// more than its energy (SDIRK2: up to twice). Steps that gain energy by stresses of an impact,
// which the tableau does integrate, are repeated (fallback()).
//
// From node to node, H = H_i:
//     x_i = x_{i-1} + H v_{i-1} + h^2 sum_j [(A A)_ij - (A A)_{i-1,j} - H/h A_{i-1,j}] b_j
//           + H^2 (k_i (c_i + s_i) + (r_i - k_i) z c_{i-1}),
//     v_i = v_{i-1} + h sum_j (A_ij - A_{i-1,j}) b_j + H (c_i + s_i).
// The unknown is x_i, with the scales (A_ii h)^2 and k_i H^2. r_i H^2 is the sum of the weights of
// b_j, so that rest is kept, and k_i = max(1/2, r_i, A_ii h / H): with the last one the velocity is
// a linear function of x_i (end_velocity()), which strong damping needs.
#pragma once

#include <algorithm>
#include <vector>

#include "framework/stepping/integrators/contact_change.hpp"
#include "framework/stepping/integrators/implicit_euler.hpp"

namespace tack {

class RungeKutta : public TimeIntegrator {
 public:
  std::vector<double> stages() const override { return ends_; }
  Prediction predict(const StepStage& stage) const override;
  void update(const StepStage& stage, const VecX& x, const VecX& contact, VecX& v,
              VecX& a) const override;
  EndVelocity end_velocity(const StepStage& stage) const override;
  LocalError local_error(const StepStage& stage, const VecX& x, const VecX& contact) const override;
  bool follows_contact() const override { return true; }
  const TimeIntegrator* fallback() const override { return &euler_; }
  bool damps() const override { return true; }
  std::string energy_advice(bool gain, bool contact) const override;

 protected:
  using Matrix = std::vector<std::vector<double>>;
  // ends: c_1 ... c_s = 1. rows: A_ij of the nodes i = 1 ... s, j = 0 ... i. embedded: weights of
  // all nodes of a formula of order three, which estimates the error; empty: the error is that of
  // the acceleration at the start, kept, scaled to the error constant of the method.
  // Throws InputError for ends that do not ascend to 1, rows of another length or sum,
  // diagonals that are not positive, and methods that are not A-stable.
  RungeKutta(std::vector<double> ends, Matrix rows, std::vector<double> embedded = {}) {
    set_tableau(std::move(ends), std::move(rows), std::move(embedded));
  }
  // Replaces the tableau, e.g. by one that depends on a parameter of the scene: to be called from a
  // check of fields(). Throws as the constructor does.
  void set_tableau(std::vector<double> ends, Matrix rows, std::vector<double> embedded = {});

 private:
  void check_tableau() const;
  double length_fraction(size_t node) const;  // H_i / h
  double position_weight(size_t node, size_t j) const;
  // Returns r and k.
  double smooth_weight(size_t node) const;
  double contact_weight(size_t node) const {
    return std::max({0.5, smooth_weight(node), rows_[node].back() / length_fraction(node)});
  }
  double diagonal(const StepStage& stage) const { return rows_[stage.index() + 1].back(); }
  ContactImpulse contact_impulse(const StepStage& stage) const;
  // Returns x_i and v_i for b_i = c_i = 0, with the shift of contact.
  StageEnd without_unknowns(const StepStage& stage) const;

  std::vector<double> ends_;
  Matrix rows_, squares_;  // A and A A, by node
  std::vector<double> embedded_;
  double error_constant_ = 0;
  ImplicitEuler euler_;
};

}  // namespace tack
