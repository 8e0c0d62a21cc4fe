// The composite tets of a body at rest, pack_width side by side, and the deformation gradients of
// their samples (composite_samples.hpp).
#pragma once

#include "energies/solid/composite_samples.hpp"
#include "energies/solid/material_split.hpp"
#include "energies/solid/tet_geometry.hpp"

namespace tack {

using CompositeNodes = PackMatrix<3, composite_nodes>;

// Values at the points of pack_width tets.
struct CompositePoints {
  std::array<PackMat3, composite_points> f;
  Pack growth;  // mean J - 1
};

class CompositeTets {
 public:
  // body.tets: eight for each, as divide_tets has left them. Throws InputError naming the body and
  // the part if one is not positively oriented.
  CompositeTets(const Body& body, const VecX& rest);

  int count() const { return static_cast<int>(nodes_.size()); }
  int packs() const { return static_cast<int>(shape_.size()); }
  const std::vector<Tet>& parts() const { return parts_; }
  const std::vector<CompositeTet>& nodes() const { return nodes_; }
  // Returns the volumes at rest times the factors of the energy, if there are any [m^3].
  const Pack& volume(int pack) const { return scaled_.empty() ? volume_[pack] : scaled_[pack]; }
  // Returns the volume at rest [m^3].
  double volume_of(int tet) const { return volume_[tet / pack_width][tet % pack_width]; }
  // Returns the weight of sample k in the energy, a fraction of the volume of a tet.
  static double weight(int k) {
    return k < composite_points ? (1 - weight_of_parts) / composite_points
                                : weight_of_parts / composite_parts;
  }

  // Returns the volume of sample i % 12 of tet i / 12 in the energy [m^3].
  double volume_of_sample(int i) const {
    return weight(i % composite_samples) * volume_of(i / composite_samples);
  }

  // Returns the gradients of corners 1 to 3 at sample k, as rows, times the history matrix of the
  // material, if there is one.
  const PackMat3& shape(int pack, int k) const {
    return turned_.empty() ? shape_[pack] : turned_[composite_samples * pack + k];
  }
  Mat3 shape_of(int tet, int k) const {
    return get_lane<3, 3>(shape(tet / pack_width, k), tet % pack_width);
  }
  // Sets it to that at rest times inverse(i) for sample i % 12 of tet i / 12.
  template <class Inverse>
  void turn(const Inverse& inverse) {
    turned_.resize(static_cast<size_t>(composite_samples) * shape_.size());
    for (int p = 0; p < packs(); ++p)
      for (int k = 0; k < composite_samples; ++k)
        for (int l = 0; l < pack_width; ++l)
          set_lane<3, 3>(
              turned_[composite_samples * p + k], l,
              get_lane<3, 3>(shape_[p], l) *
                  inverse(composite_samples * std::min(p * pack_width + l, count() - 1) + k));
  }

  // Multiplies the energy of each tet by factor(tet), or by 1 from now on.
  template <class Factor>
  void set_factors(const Factor& factor) {
    scaled_ = volume_;
    for (int p = 0; p < packs(); ++p)
      for (int l = 0; l < pack_width; ++l)
        scaled_[p].set(l, volume_[p][l] * factor(std::min(p * pack_width + l, count() - 1)));
  }
  void clear_factors() { scaled_.clear(); }

  // Returns the nodes of the tets first .. first + n at x, relative to their first nodes:
  // differences are exact far from the origin. Further lanes repeat the last tet.
  CompositeNodes at(int first, int n, const VecX& x) const;
  CompositePoints points(int pack, const CompositeNodes& x) const;
  PackMat3 part(int pack, int s, const CompositeNodes& x) const;
  // Returns the deformation gradient of one sample of one tet.
  Mat3 deformation(int tet, int k, const VecX& x) const;
  // Returns that of sample i % 12 of tet i / 12.
  Mat3 deformation(int i, const VecX& x) const {
    return deformation(i / composite_samples, i % composite_samples, x);
  }

 private:
  const CompositeTable& table_ = composite_table();
  std::vector<Tet> parts_;
  std::vector<CompositeTet> nodes_;
  std::vector<PackMat3> shape_, turned_;  // of pack_width tets each; the last lanes repeat the last
                                          // tet. turned_: of each sample, or empty
  std::vector<Pack> volume_, scaled_;     // of pack_width tets each [m^3]. scaled_: times factors,
                                          // or empty
};

}  // namespace tack
