// Mean volume changes over patches of tets (geometry/tets/tet_patches.hpp), J = v / V, with an
// energy V U(J) each. The Hessian is that of the tets at fixed pressures U', plus V U'' (dJ/dx)
// (dJ/dx)^T, of rank one over all vertices of the patch.
#pragma once

#include <array>

#include "energies/solid/material_split.hpp"
#include "framework/body/body.hpp"
#include "framework/core/term.hpp"

namespace tack {

class Patches {
 public:
  // A body with its tets patch by patch, patches of as many vertices together; and the patch of
  // each tet, from 0 on.
  struct Sorted {
    Body body;
    std::vector<int> patch;
  };
  static Sorted sorted(const Body& body);

  Patches(const Sorted& sorted, const VecX& rest);

  struct Patch {
    int first, last;     // tets
    int vertices, size;  // the first in `vertices`, and how many
    double volume;       // m^3
  };
  int count() const { return static_cast<int>(patches_.size()); }
  const Patch& patch(int p) const { return patches_[p]; }
  int patch_of(int tet) const { return patch_of_[tet]; }
  const int* vertices(int p) const { return &vertices_[patches_[p].vertices]; }

  double growth(int p, const VecX& x) const;  // J - 1
  // dJ/dx of the patch's vertices, 3 numbers each [1/m].
  void derivative(int p, const VecX& x, double* out) const;

  // Patches of one size: the first, and how many.
  struct Run {
    int first, count;
  };
  const std::vector<Run>& runs() const { return runs_; }
  StencilBatch batch(const Run& run) const;

 private:
  std::vector<Tet> tets_;
  std::vector<double> rest_;                 // six times the volume of each [m^3]
  std::vector<std::array<int, 4>> corners_;  // of each, in the vertices of its patch
  std::vector<int> patch_of_, vertices_;
  std::vector<Patch> patches_;
  std::vector<Run> runs_;
};

// The stencils of rank one. Their gradients are left to the tets.
template <class Volume>
class PatchStencils final : public StencilRanges {
 public:
  PatchStencils(const Patches& patches, const Patches::Run& run, const Volume& law)
      : patches_(patches), run_(run), law_(law) {}

  void range_derivatives(const VecX& x, Projection projection, int first, int last,
                         double* gradient, double* hessian) const override {
    const int size = patches_.patch(run_.first).size;
    std::fill(gradient, gradient + 3 * static_cast<size_t>(size) * (last - first), 0.0);
    if (!hessian) return;
    std::array<double, 3 * largest_rank_one> slope;
    for (int p = run_.first + first; p < run_.first + last; ++p) {
      const double bulk =
          projected(law_.at(patches_.growth(p, x)).bulk, projection) * patches_.patch(p).volume;
      patches_.derivative(p, x, slope.data());
      for (int a = 0; a < size; ++a)
        for (int b = 0; b <= a; ++b, hessian += 9)
          Eigen::Map<Mat3>{hessian} = bulk * Eigen::Map<const Vec3>(&slope[3 * a]) *
                                      Eigen::Map<const Vec3>(&slope[3 * b]).transpose();
    }
  }

 private:
  const Patches& patches_;
  Patches::Run run_;
  const Volume& law_;
};

}  // namespace tack
