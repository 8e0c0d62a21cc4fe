// History of a Maxwell branch: F_v^-1 of each sample (a tet, a point of it, or a triangle).
// N = 3 for solids, 2 for sheets.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "energies/viscoelastic/relaxation.hpp"
#include "framework/body/body.hpp"
#include "framework/core/history.hpp"
#include "geometry/parallel.hpp"

namespace tack {

template <int N>
class ViscousHistory {
 public:
  using Matrix = typename Relaxation<N>::Matrix;
  using Strain = typename Relaxation<N>::Strain;

  ViscousHistory(const Body& body, const Relaxation<N>& relaxation)
      : name_(fmt::format("{}/energies/{}/viscous_inverse", body.name, body.energy)),
        relaxation_(relaxation) {}

  void load_history(const History& history, int samples) {
    if (const auto* values = history_values(history, name_, size, samples)) {
      committed_ = *values;
    } else {
      committed_.resize(static_cast<size_t>(size) * samples);
      for (int i = 0; i < samples; ++i) set(committed_, i, Matrix::Identity());
    }
    restore();
  }

  // Goes back to the end of the last step. Returns false if it was there.
  bool rewind() {
    if (h_ == 0) return false;
    restore();
    return true;
  }
  // Starts a step h > 0 [s] from the end of the last, which has the elastic strains strain(i).
  // shifts: factors of the relaxation time, of equal numbers of successive samples; none: 1.
  template <class StrainOf>
  void begin_step(double h, std::vector<double> shifts, const StrainOf& strain) {
    h_ = h;
    shifts_ = std::move(shifts);
    strains_.resize(inverse_.size());
    for_each(samples(), [&](int i) {
      const Strain first = strain(i);
      const Relaxation<N> relaxation = shifted(i);
      set(strains_, i, first.tensor());
      set(inverse_, i, inverse(i) * relaxation.flow(first, relaxation.start(h)));
    });
  }

  // Returns F_v^-1 of the step: between steps that of the end of the last one.
  Matrix inverse(int i) const { return matrix(inverse_, i); }
  // Returns the factor a of the potential of sample i, and whether it is that of all samples.
  double end_factor(int i) const { return shifted(i).end(h_); }
  bool uniform() const { return shifts_.size() <= 1; }
  const Relaxation<N>& relaxation() const { return relaxation_; }

  // Stores F_v^-1 at the end of a step with the trial strains strain(i).
  template <class StrainOf>
  void commit(const StrainOf& strain, History& history) const {
    HistoryArray inverses{size, inverse_, {}};
    if (h_ > 0)
      for_each(samples(), [&](int i) {
        set(inverses.values, i, inverse(i) * relaxation_.flow(strain(i), end_factor(i)));
      });
    history[name_] = std::move(inverses);
  }

  // Returns the dissipation of the step [J]. volume(i): of sample i [m^3].
  template <class StrainOf, class Volume>
  double dissipated(const StrainOf& strain, const Volume& volume) const {
    if (h_ == 0) return 0;
    return sum_chunks(samples(), [&](int first, int last) {
      double sum = 0;
      for (int i = first; i < last; ++i)
        sum += volume(i) * shifted(i).dissipated(h_, matrix(strains_, i), strain(i).tensor());
      return sum;
    });
  }

 private:
  static constexpr int size = N * N;

  static Matrix matrix(const std::vector<double>& all, int i) {
    return Eigen::Map<const Matrix>(all.data() + size * static_cast<size_t>(i));
  }
  static void set(std::vector<double>& all, int i, const Matrix& m) {
    Eigen::Map<Matrix>(all.data() + size * static_cast<size_t>(i)) = m;
  }
  int samples() const { return static_cast<int>(inverse_.size() / size); }
  Relaxation<N> shifted(int i) const {
    Relaxation<N> relaxation = relaxation_;
    if (!shifts_.empty()) relaxation.time *= shifts_[i / (samples() / shifts_.size())];
    return relaxation;
  }
  void restore() {
    h_ = 0;
    shifts_.clear();
    inverse_ = committed_;
    strains_.clear();
  }

  std::string name_;  // of its history array
  Relaxation<N> relaxation_;
  std::vector<double> committed_;  // F_v^-1 after the last step, column major
  std::vector<double> inverse_;    // F_v'^-1 of this step
  std::vector<double> strains_;    // e_n of this step, the part that decays
  std::vector<double> shifts_;     // factors of the relaxation time in this step
  double h_ = 0;                   // step size [s]; 0: between steps
};

}  // namespace tack
