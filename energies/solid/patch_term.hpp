// Linear tets with a common volume change per patch, for a splittable material
// (material_split.hpp):
//     sum over tets of V psi_s(F) + sum over patches of V U(J),   J the volume of a patch over its
//     rest volume.
// Volume does not lock, because there are fewer patches than vertices; bending is that of linear
// tets. Patches do not overlap: means about every vertex would leave pressures free that alternate
// from vertex to vertex.
// Source: Bonet and Burton 1998, A simple average nodal pressure tetrahedral element.
#pragma once

#include <memory>

#include "energies/solid/patch_volumes.hpp"
#include "energies/solid/sample_stiffness.hpp"
#include "energies/solid/solid_term.hpp"

namespace tack {

// A separate type, so that no function is shared with linear tets: the linker would keep one copy,
// compiled for one of the two.
template <class Shape>
struct PatchShape : Shape {};

template <class Shape, class Volume>
class PatchTerm : public SolidTerm<PatchShape<Shape>> {
 public:
  PatchTerm(std::string name, const Shape& shape, const Volume& volume, const Body& body,
            const VecX& rest)
      : PatchTerm(std::move(name), shape, volume, Patches::sorted(body), rest) {}

  double value(const VecX& x) const override {
    return Base::value(x) + sum_chunks(patches_.count(), [&](int first, int last) {
             double sum = 0;
             for (int p = first; p < last; ++p) {
               const double growth = patches_.growth(p, x);
               sum += growth > -1 ? patches_.patch(p).volume * law_.at(growth).energy
                                  : std::numeric_limits<double>::infinity();
             }
             return sum;
           });
  }

  std::vector<StencilBatch> batches() const override {
    std::vector<StencilBatch> all = Base::batches();
    for (const Patches::Run& run : patches_.runs()) all.push_back(patches_.batch(run));
    return all;
  }

  std::vector<const StencilRanges*> ranges() const override {
    std::vector<const StencilRanges*> all{this};
    for (const auto& stencils : stencils_) all.push_back(stencils.get());
    return all;
  }

  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    const std::vector<StencilBatch> all = batches();
    const std::vector<const StencilRanges*> each = ranges();
    for (size_t b = 0; b < all.size(); ++b) {
      const size_t size = 3 * static_cast<size_t>(all[b].arity),
                   blocks = 9 * static_cast<size_t>(hessian_blocks(all[b].arity));
      for_each_chunk(all[b].count, [&](int, int first, int last) {
        each[b]->range_derivatives(x, projection, first, last, gradient + size * first,
                                   hessian ? hessian + blocks * first : nullptr);
      });
      gradient += size * all[b].count;
      if (hessian) hessian += blocks * all[b].count;
    }
  }

  void range_derivatives(const VecX& x, Projection projection, int first, int last,
                         double* gradient, double* hessian) const override {
    double pressure = 0;
    for (int t = first, known = -1; t < last; t += pack_width, gradient += 12 * pack_width) {
      const int n = std::min(pack_width, last - t);
      Pack pressures = 0;
      for (int l = 0; l < n; ++l) {
        if (const int p = patches_.patch_of(t + l); p != known)
          pressure = pressure_of(known = p, x);
        pressures.set(l, pressure);
      }
      const auto& material = this->material(t / pack_width);
      this->elements(Pressed<std::decay_t<decltype(material)>>{material, pressures}, t, n, x,
                     projection, gradient, hessian);
      if (hessian) hessian += 90 * pack_width;
    }
  }

 protected:
  StressRecord stress_record() const override {
    StressRecord stress{[this](const VecX& x) {
      std::vector<Mat3> all = this->cauchy_stress(x);
      for (int t = 0; t < this->count(); ++t)
        all[t] += pressure_of(patches_.patch_of(t), x) * Mat3::Identity();
      return all;
    }};
    stress.tets = &this->tets_;
    return stress;
  }
  double pressure_of(int patch, const VecX& x) const {
    return law_.at(patches_.growth(patch, x)).pressure;
  }

  Patches patches_;
  Volume law_;

 private:
  using Base = SolidTerm<PatchShape<Shape>>;

  // A material under a pressure.
  template <class Lanes>
  struct Pressed {
    const Lanes& lanes;
    Pack pressure;
    PrincipalDerivatives derivatives(const PackVec3& s) const {
      PrincipalDerivatives d = lanes.derivatives(s);
      add_pressure(d, s, pressure);
      return d;
    }
  };

  PatchTerm(std::string name, const Shape& shape, const Volume& volume,
            const Patches::Sorted& sorted, const VecX& rest)
      : Base(std::move(name), PatchShape<Shape>{shape}, sorted.body, rest), patches_(sorted, rest),
        law_(volume) {
    for (const Patches::Run& run : patches_.runs())
      stencils_.push_back(std::make_unique<PatchStencils<Volume>>(patches_, run, law_));
  }

  std::vector<std::unique_ptr<PatchStencils<Volume>>> stencils_;
};

}  // namespace tack
