// Surfaces with one barrier between all objects, their candidates and closed forms of the barrier:
// for tests of contact models without a world.
#pragma once

#include <cmath>

#include "framework/contact/laws/pair_table.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "tests/framework/contact/surface_builder.hpp"

namespace tack {

// phi(d) = -kappa dhat (d/dhat - 1)^2 ln(d/dhat), the clamped logarithm.
class LogBarrier : public NormalLaw {
 public:
  LogBarrier(double kappa, double range) : kappa_(kappa), range_(range) {}
  std::string_view name() const override { return "log"; }
  void prepare(const PairMaterials& /*materials*/) override {}
  double range() const override { return range_; }
  void add_samples(int n, const double* d, LawSample* out) const override {
    for (int i = 0; i < n; ++i) {
      if (!(d[i] < range_)) continue;
      const double r = d[i] / range_, l = std::log(r), s = r - 1;
      out[i].value += -kappa_ * range_ * s * s * l;
      out[i].slope += -kappa_ * (2 * s * l + s * s / r);
      out[i].curvature += -kappa_ / range_ * (2 * l + 4 * s / r - s * s / (r * r));
    }
  }
  void add_values(int n, const double* d, double* out) const override {
    for (int i = 0; i < n; ++i) {
      LawSample sample;
      add_samples(1, d + i, &sample);
      out[i] += sample.value;
    }
  }
  std::unique_ptr<NormalLaw> clone() const override { return std::make_unique<LogBarrier>(*this); }

 private:
  double kappa_, range_;  // Pa, m
};

// A surface with a law between all objects, and within each.
struct ModelScene {
  ModelScene(const SurfaceBuilder& builder, double range, double kappa = 1e4)
      : surface(builder.surface()), pairs(object_count(surface.mesh)), barrier(kappa, range) {
    PairLaw law;
    law.add(std::make_shared<LogBarrier>(kappa, range));
    const int id = pairs.add_law(law);
    PairRole role;
    role.law = id;
    role.area_factor = 1;
    role.range = range;
    for (int a = 0; a < pairs.objects(); ++a)
      for (int b = a; b < pairs.objects(); ++b) {
        pairs.point(a, b) = pairs.point(b, a) = role;
        pairs.set_edge(a, b, role);
      }
    broad_phase = std::make_unique<BroadPhase>(surface.mesh, CollidingObjects());
  }

  const Candidates& candidates_at(const VecX& x) {
    broad_phase->update(x, VecX(), pairs.laws()[0].range(), 0.1 * pairs.laws()[0].range());
    return broad_phase->candidates();
  }

  ContactSurface surface;
  PairTable pairs;
  LogBarrier barrier;
  std::unique_ptr<BroadPhase> broad_phase;
};

// Returns the sum of the forces (3n) on the vertices of an object [N].
inline Vec3 force_on(const ContactSurface& surface, const VecX& forces, int object) {
  Vec3 sum = Vec3::Zero();
  for (const int v : surface.mesh.vertices)
    if (surface.mesh.vertex_object[v] == object) sum += vertex(forces, v);
  return sum;
}

// Adds a tetrahedron of object `object` whose apex points downwards. Returns the apex; the other
// vertices follow.
inline int add_tip(SurfaceBuilder& builder, const Vec3& apex, double size, int object) {
  const int a = builder.add_vertex(apex, object);
  for (int i = 0; i < 3; ++i)
    builder.add_vertex(
        apex + size * Vec3(std::cos(2.0944 * i + 0.2), std::sin(2.0944 * i + 0.2), 1), object);
  builder.add_triangle({a, a + 2, a + 1});
  builder.add_triangle({a, a + 3, a + 2});
  builder.add_triangle({a, a + 1, a + 3});
  builder.add_triangle({a + 1, a + 2, a + 3});
  return a;
}

// Adds two flat strips that meet along x = 0 and rise (slope > 0: a valley) or fall (a ridge)
// towards both sides, with normals upwards.
inline void add_fold(SurfaceBuilder& builder, double slope, int object) {
  builder.add_grid({8, 8}, object, [=](double u, double v) {
    const double x = 0.2 * (u - 0.5);
    return Vec3(x, 0.2 * (v - 0.5), slope * std::abs(x));
  });
}

// Adds the six faces of a box with n x n cells each and outward normals, rotated about its centre.
inline void add_fine_box(SurfaceBuilder& builder, const Vec3& centre, double size, int n,
                         int object, const Mat3& rotation) {
  std::vector<std::pair<Vec3, int>> known;
  const auto vertex_at = [&](const Vec3& p) {
    for (const auto& [q, v] : known)
      if ((p - q).norm() < 1e-9 * size) return v;
    known.emplace_back(p, builder.add_vertex(p, object));
    return known.back().second;
  };
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-0.5, 0.5})
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
          std::array<int, 4> v;
          for (int k = 0; k < 4; ++k) {
            Vec3 local;
            local[axis] = side;
            local[(axis + 1) % 3] = (i + (k == 1 || k == 2)) / double(n) - 0.5;
            local[(axis + 2) % 3] = (j + (k >= 2)) / double(n) - 0.5;
            v[k] = vertex_at(centre + rotation * (size * local));
          }
          if (side < 0) std::swap(v[1], v[3]);
          if ((i + j) % 2)
            builder.add_triangle({v[0], v[1], v[2]}), builder.add_triangle({v[0], v[2], v[3]});
          else builder.add_triangle({v[0], v[1], v[3]}), builder.add_triangle({v[1], v[2], v[3]});
        }
}

}  // namespace tack
