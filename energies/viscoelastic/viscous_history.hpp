// History of a Maxwell branch: F_v^-1 of each sample (a tet, or a point of it).
#pragma once

#include <string>
#include <vector>

#include "energies/solid/svd3.hpp"
#include "energies/viscoelastic/maxwell.hpp"
#include "framework/body/body.hpp"
#include "framework/core/history.hpp"
#include "geometry/parallel.hpp"

namespace tack {

class ViscousHistory {
 public:
  ViscousHistory(const Body& body, const MaxwellParameters& parameters);

  void load_history(const History& history, int samples);

  // Goes back to the end of the last step.
  void rewind() {
    h_ = 0;
    inverse_ = committed_;
    strains_.clear();
  }
  // Starts a step h [s] from the end of the last, which has the elastic deformation gradients
  // elastic(i).
  template <class Elastic>
  void begin_step(double h, const Elastic& elastic) {
    h_ = h;
    strains_.resize(inverse_.size());
    for_each(samples(), [&](int i) {
      const Strain start(elastic(i), parameters_);
      set(strains_, i, start.tensor());
      set(inverse_, i, inverse(i) * start.flow(parameters_.start(h)));
    });
  }

  // Returns F_v^-1 of the step: between steps that of the end of the last one.
  Mat3 inverse(int i) const { return matrix(inverse_, i); }
  // Returns the factor a of the potential.
  double end_factor() const { return parameters_.end(h_); }

  // Stores F_v^-1 at the end of a step with elastic(i) = F F_v'^-1.
  template <class Elastic>
  void commit(const Elastic& elastic, History& history) const {
    HistoryArray inverses{9, inverse_, {}};
    if (h_ > 0)
      for_each(samples(), [&](int i) {
        const Strain end(elastic(i), parameters_);
        set(inverses.values, i, inverse(i) * end.flow(parameters_.end(h_)));
      });
    history[name_] = std::move(inverses);
  }

  // Returns the dissipation of the step [J]. volume(i): of sample i [m^3].
  template <class Elastic, class Volume>
  double dissipated(const Elastic& elastic, const Volume& volume) const {
    if (h_ == 0) return 0;
    return sum_chunks(samples(), [&](int first, int last) {
      double sum = 0;
      for (int i = first; i < last; ++i)
        sum += volume(i) * density(matrix(strains_, i), Strain(elastic(i), parameters_).tensor());
      return sum;
    });
  }

 private:
  // The part of an elastic Hencky strain that decays, in principal axes.
  struct Strain {
    Strain(const Mat3& elastic, const MaxwellParameters& parameters) {
      const Svd3<double> svd = svd3(elastic);
      axes = svd.v;
      values = svd.s.array().log();
      deviatoric = parameters.bulk == 0;
      if (deviatoric) values.array() -= values.sum() / 3;
    }
    Mat3 tensor() const { return axes * values.asDiagonal() * axes.transpose(); }
    // Returns what F_v^-1 is multiplied by when a fraction of the strain is left.
    Mat3 flow(double left) const {
      const Vec3 factors = ((left - 1) * values).array().exp();
      const Mat3 f = axes * factors.asDiagonal() * axes.transpose();
      return deviatoric ? Mat3(f / std::cbrt(f.determinant())) : f;
    }
    Mat3 axes;
    Vec3 values;
    bool deviatoric;
  };

  // Returns the dissipation of a step from the strain `start` to the trial strain `trial` at a
  // constant rate [J/m^3]: the integral of 2 psi(e) / time, e = steady + (start - steady)
  // exp(-t / time).
  double density(const Mat3& start, const Mat3& trial) const {
    const double x = h_ / parameters_.time;
    const Mat3 steady = (trial - parameters_.start(h_) * start) / x, rest = start - steady;
    const double once = -std::expm1(-x), twice = -std::expm1(-2 * x) / 2;
    return 2 * (x * product(steady, steady) + 2 * once * product(steady, rest) +
                twice * product(rest, rest));
  }
  // The bilinear form of psi.
  double product(const Mat3& a, const Mat3& b) const {
    return parameters_.modulus * (a.cwiseProduct(b).sum() - a.trace() * b.trace() / 3) +
           parameters_.bulk / 2 * a.trace() * b.trace();
  }

  static Mat3 matrix(const std::vector<double>& all, int i) {
    return Eigen::Map<const Mat3>(all.data() + 9 * static_cast<size_t>(i));
  }
  static void set(std::vector<double>& all, int i, const Mat3& m) {
    Eigen::Map<Mat3>(all.data() + 9 * static_cast<size_t>(i)) = m;
  }
  int samples() const { return static_cast<int>(inverse_.size() / 9); }

  std::string name_;  // of its history array
  MaxwellParameters parameters_;
  std::vector<double> committed_;  // F_v^-1 after the last step, column major
  std::vector<double> inverse_;    // F_v'^-1 of this step
  std::vector<double> strains_;    // e_n of this step, the part that decays
  double h_ = 0;                   // step size [s]; 0: between steps
};

}  // namespace tack
