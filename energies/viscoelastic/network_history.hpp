// History of a nonequilibrium network (bergstrom_boyce.hpp): F_v^-1 of each sample (a tet, or a
// point of it), and the factors of the flow of a step.
#pragma once

#include <string>
#include <vector>

#include "energies/solid/svd3.hpp"
#include "energies/viscoelastic/network_flow.hpp"
#include "framework/body/body.hpp"
#include "framework/core/history.hpp"
#include "geometry/parallel.hpp"

namespace tack {

class NetworkHistory {
 public:
  NetworkHistory(const Body& body, const NetworkFlow& flow);

  void load_history(const History& history, int samples);
  /// Starts a step h [s]; 0: nothing flows. slowdowns: factors of all times, of equal numbers of
  /// successive samples; none: 1.
  void begin_step(double h, const std::vector<double>& slowdowns);

  int samples() const { return static_cast<int>(log_factors_.size()); }
  Mat3 inverse(int i) const {
    return Eigen::Map<const Mat3>(&inverse_[9 * static_cast<size_t>(i)]);
  }                                                           // F_v^-1 at the start of the step
  double log_factor(int i) const { return log_factors_[i]; }  // ln k of the step

  /// Stores F_v^-1 at the end of a step. deformation(i): F F_v^-1 of sample i there.
  template <class Deformation>
  void commit(const Deformation& deformation, History& history) const {
    HistoryArray inverses{9, inverse_, {}};
    for_each(samples(), [&](int i) {
      const Strain trial(deformation(i));
      const double flowed = fractions(i, trial).flowed;
      if (!(flowed > 0)) return;
      const Vec3 flow = (-flowed * trial.deviator).array().exp();
      const Mat3 next = inverse(i) * trial.axes * flow.asDiagonal() * trial.axes.transpose();
      Eigen::Map<Mat3>(&inverses.values[9 * static_cast<size_t>(i)]) =
          next / std::cbrt(next.determinant());
    });
    history[name_] = std::move(inverses);
  }

  /// Returns the dissipation of a step [J]: the flow times the mean of the stresses of both ends,
  /// so that a step at constant strain dissipates what the springs give up. A stress of the start
  /// that opposes the flow counts as none: the dissipation is never negative. before(i), after(i):
  /// F F_v^-1 of sample i at the ends of the step, with the F_v of its start. volume(i): m^3.
  template <class Before, class After, class Volume>
  double dissipated(const Before& before, const After& after, const Volume& volume) const {
    return sum_chunks(samples(), [&](int first, int last) {
      double sum = 0;
      for (int i = first; i < last; ++i) {
        const Strain trial(after(i));
        const NetworkFlow::Fractions<double> f = fractions(i, trial);
        if (!(f.flowed > 0)) continue;
        const double start = Strain(before(i)).tensor().cwiseProduct(trial.tensor()).sum();
        const double end = f.left * trial.norm * trial.norm;
        sum += volume(i) * flow_.mu * f.flowed * (std::max(start, 0.0) + end);
      }
      return sum;
    });
  }

 private:
  // The deviatoric Hencky strain of an elastic deformation gradient.
  struct Strain {
    explicit Strain(const Mat3& elastic) {
      const Svd3<double> svd = svd3(elastic);
      axes = svd.v;
      deviator = svd.s.array().log();
      deviator.array() -= deviator.sum() / 3;
      norm = deviator.norm();
    }
    Mat3 tensor() const { return axes * deviator.asDiagonal() * axes.transpose(); }
    Mat3 axes;
    Vec3 deviator;
    double norm;
  };
  NetworkFlow::Fractions<double> fractions(int i, const Strain& trial) const {
    return flow_.fractions(trial.norm, log_factors_[i]);
  }

  std::string name_;  // of its history array
  NetworkFlow flow_;
  std::vector<double> inverse_;      // column major
  std::vector<double> log_factors_;  // minus infinity: nothing flows
};

}  // namespace tack
