// Laws of known energy and plates of triangles, for tests of the clipped integral.
#pragma once

#include <cmath>
#include <memory>
#include <tuple>
#include <vector>

#include "framework/contact/clipped/clipped_pair.hpp"

namespace tack {

// Traction that rises linearly to `strength` at half of the range and falls to zero at the range.
class TentLaw final : public NormalLaw {
 public:
  TentLaw(double range, double work) : range_(range), strength_(2 * work / range) {}
  std::string_view name() const override { return "tent"; }
  void prepare(const PairMaterials&) override {}
  double range() const override { return range_; }
  void add_samples(int n, const double* d, LawSample* out) const override {
    const double peak = range_ / 2, slope = strength_ / peak, work = strength_ * peak;
    for (int i = 0; i < n; ++i) {
      if (d[i] >= range_) continue;
      if (d[i] < peak) {
        out[i].value += -work + slope * d[i] * d[i] / 2;
        out[i].slope += slope * d[i];
        out[i].curvature += slope;
      } else {
        out[i].value -= slope * (range_ - d[i]) * (range_ - d[i]) / 2;
        out[i].slope += slope * (range_ - d[i]);
        out[i].curvature -= slope;
      }
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    for (int i = 0; i < n; ++i) {
      LawSample sample;
      add_samples(1, d + i, &sample);
      out[i] += sample.value;
    }
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<TentLaw>(*this); }

 private:
  double range_, strength_;
};

inline PairLaw tent_law() {
  PairLaw law;
  law.add(std::make_shared<TentLaw>(1.0, 1.0));
  return law;
}

// -(1 + 4 g) exp(-4 g) (1 - g)^3.
class SteepLaw final : public NormalLaw {
 public:
  std::string_view name() const override { return "steep"; }
  void prepare(const PairMaterials&) override {}
  double range() const override { return 1; }
  void add_samples(int n, const double* d, LawSample* out) const override {
    for (int i = 0; i < n; ++i) {
      if (d[i] >= 1) continue;
      const double e = std::exp(-4 * d[i]), f = -(1 + 4 * d[i]) * e, f1 = 16 * d[i] * e,
                   f2 = 16 * (1 - 4 * d[i]) * e;
      const double c = std::pow(1 - d[i], 3), c1 = -3 * std::pow(1 - d[i], 2), c2 = 6 * (1 - d[i]);
      out[i].value += f * c;
      out[i].slope += f1 * c + f * c1;
      out[i].curvature += f2 * c + 2 * f1 * c1 + f * c2;
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    for (int i = 0; i < n; ++i) out[i] += at(d[i]).value;
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<SteepLaw>(*this); }
};

inline PairLaw steep_law() {
  PairLaw law;
  law.add(std::make_shared<SteepLaw>());
  return law;
}

// A plate [x0, x0 + side] x [y0, y0 + side] at height z, cells x cells squares of two triangles.
struct Plate {
  std::vector<std::array<Vec3, 3>> triangles;
  std::vector<std::array<bool, 3>> boundary;
};
inline Plate plate(double x0, double y0, double z, double side, int cells, bool up) {
  Plate all;
  const double h = side / cells;
  const auto on_boundary = [&](const Vec3& p, const Vec3& q) {
    for (int d = 0; d < 2; ++d)
      for (const double at : {d == 0 ? x0 : y0, (d == 0 ? x0 : y0) + side})
        if (std::abs(p[d] - at) < 1e-9 && std::abs(q[d] - at) < 1e-9) return true;
    return false;
  };
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Vec3 p(x0 + i * h, y0 + j * h, z), px = p + Vec3(h, 0, 0), py = p + Vec3(0, h, 0),
                                               pxy = p + Vec3(h, h, 0);
      for (std::array<Vec3, 3> t :
           {std::array<Vec3, 3>{p, px, pxy}, std::array<Vec3, 3>{p, pxy, py}}) {
        if (!up) std::swap(t[1], t[2]);
        all.triangles.push_back(t);
        std::array<bool, 3> boundary;
        for (int k = 0; k < 3; ++k) boundary[k] = on_boundary(t[k], t[(k + 1) % 3]);
        all.boundary.push_back(boundary);
      }
    }
  return all;
}

struct PlatesResult {
  double energy = 0, area = 0;
  Vec3 force_on_a = Vec3::Zero();
};
inline PlatesResult between(const Plate& a, const Plate& b, double strip, const PairLaw& law) {
  ClipIntegrator integrator;
  const GapBands bands = gap_bands(law);
  PlatesResult all;
  for (std::size_t i = 0; i < a.triangles.size(); ++i)
    for (std::size_t j = 0; j < b.triangles.size(); ++j) {
      ClippedPair pair{a.triangles[i], b.triangles[j], a.boundary[i], {}};
      for (int k = 0; k < 3; ++k) {
        const Vec3 &from = pair.b[k], &to = pair.b[(k + 1) % 3];
        pair.owns_b[k] = std::tie(from.x(), from.y()) < std::tie(to.x(), to.y());
        pair.strip_b[k] = b.boundary[j][k] ? strip : 0;
      }
      Vec18 gradient;
      const ClippedIntegral one = integrator.derivatives(pair, law, bands, gradient, nullptr);
      all.energy += one.energy;
      for (int k = 0; k < 3; ++k) {
        all.area += one.area[k];
        all.force_on_a -= gradient.segment<3>(3 * k);
      }
    }
  return all;
}

}  // namespace tack
