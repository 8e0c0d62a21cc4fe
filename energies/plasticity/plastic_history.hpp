// History variables of a von Mises material, per sample (a tet or a point of it), and the return
// mapping.
#pragma once

#include <string>

#include "energies/solid/svd3.hpp"
#include "energies/plasticity/von_mises.hpp"
#include "framework/core/history.hpp"
#include "geometry/parallel.hpp"

namespace tack {

class PlasticHistory {
 public:
  explicit PlasticHistory(const Body& body);

  void load_history(const History& history, int samples);
  Mat3 inverse(int i) const {
    return Eigen::Map<const Mat3>(&inverse_[9 * static_cast<size_t>(i)]);
  }                                                              // Fp^-1
  const std::vector<double>& strain() const { return strain_; }  // accumulated plastic strains
  std::string strain_array() const { return name_ + strain_name; }

  // Applies the return mapping. deformation(i): F Fp^-1 of sample i at the end of the step.
  template <class Deformation>
  void commit(const VonMises& material, const Deformation& deformation, History& history) const {
    HistoryArray inverses{9, inverse_, {}}, strains{1, strain_, {}};
    for_each(samples(), [&](int i) {
      const Trial trial(deformation(i));
      const double r = trial.norm - material.limit(strain_[i]);
      if (!(r > 0)) return;
      const double added = material.flow(r);
      strains.values[i] += added;
      const double back = std::min(std::sqrt(1.5) * added + inside, trial.norm) / trial.norm;
      const Vec3 flow = (-back * trial.deviator).array().exp();
      const Mat3 next = inverse(i) * trial.svd.v * flow.asDiagonal() * trial.svd.v.transpose();
      Eigen::Map<Mat3>(&inverses.values[9 * static_cast<size_t>(i)]) =
          next / std::cbrt(next.determinant());
    });
    history[name_ + inverse_name] = std::move(inverses);
    history[name_ + strain_name] = std::move(strains);
  }

  // Returns the plastic work, by which a commit reduces the value [J]. volume(i): volume of sample
  // i [m^3].
  template <class Deformation, class Volume>
  double dissipated(const VonMises& material, const Deformation& deformation,
                    const Volume& volume) const {
    return over_flows(material, deformation, volume,
                      [&](int i, double added) { return material.work(strain_[i], added); });
  }
  // Returns the viscous dissipation beside the plastic work [J].
  template <class Deformation, class Volume>
  double viscous(const VonMises& material, const Deformation& deformation,
                 const Volume& volume) const {
    return over_flows(material, deformation, volume,
                      [&](int, double added) { return material.viscous_work(added); });
  }

 private:
  // Returns the sum of volume(i) density(i, added plastic strain) over all samples that flow.
  template <class Deformation, class Volume, class Density>
  double over_flows(const VonMises& material, const Deformation& deformation, const Volume& volume,
                    const Density& density) const {
    return sum_chunks(samples(), [&](int first, int last) {
      double sum = 0;
      for (int i = first; i < last; ++i) {
        const double added = material.flow(Trial(deformation(i)).norm - material.limit(strain_[i]));
        if (added > 0) sum += volume(i) * density(i, added);
      }
      return sum;
    });
  }

  static constexpr const char* inverse_name = "plastic_inverse";
  static constexpr const char* strain_name = "plastic_strain";
  // The return mapping leaves |dev e| inside the yield surface by more than round-off, so that a
  // sample at rest does not flow.
  static constexpr double inside = 1e-13;

  struct Trial {
    explicit Trial(const Mat3& f) : svd(svd3(f)), deviator(svd.s.array().log()) {
      deviator.array() -= deviator.sum() / 3;
      norm = deviator.norm();
    }
    Svd3<double> svd;
    Vec3 deviator;
    double norm;
  };

  int samples() const { return static_cast<int>(strain_.size()); }

  std::string name_;                      // prefix of its history arrays
  std::vector<double> inverse_, strain_;  // per sample: Fp^-1 (column major), accumulated strain
};

}  // namespace tack
