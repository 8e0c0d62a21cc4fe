#include "framework/contact/surface/overclosure.hpp"

#include <cmath>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/distance/closest_parameters.hpp"

namespace tack {
namespace {

constexpr size_t count_max = 5;                         // reported overclosures
constexpr double touching_distance_per_extent = 1e-14;  // extent: the larger one of two primitives

template <size_t N>
double extent(const std::array<Vec3, N>& x) {
  double longest = 0;
  for (const Vec3& corner : x) longest = std::max(longest, (corner - x[0]).norm());
  return longest;
}

// Returns the point of the first primitive that is closest to the second.
template <size_t B>
Vec3 position_on_first(const std::array<Vec3, 1>& a, const std::array<Vec3, B>&) {
  return a[0];
}
Vec3 position_on_first(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  return a[0] + edge_edge_parameters(a[0], a[1], b[0], b[1])[0] * (a[1] - a[0]);
}

class Search {
 public:
  Search(const ContactSystem& contact, const VecX& x) : contact_(contact), x_(x) {}

  template <size_t A, size_t B>
  void check(const std::array<int, A>& a, const std::array<int, B>& b, double distance_bound) {
    if (found_.size() == count_max) return;
    const ContactSurface& surface = contact_.surface();
    const int object_a = surface.mesh.vertex_object[a[0]], object_b = surface.mesh.vertex_object[b[0]];
    if (distance_bound > contact_.pairs().offset(object_a, object_b)) return;
    const double offset = offset_between(surface, contact_.pairs(), a, b);
    const auto ca = corners(x_, a);
    const auto cb = corners(x_, b);
    const double distance = std::sqrt(squared_distance(ca, cb));
    const bool touching = distance <= touching_distance_per_extent * std::max(extent(ca), extent(cb));
    if (!touching && (offset == 0 || distance > offset)) return;
    found_.push_back({{a.begin(), a.end()}, {b.begin(), b.end()}, distance, offset, touching, position_on_first(ca, cb)});
  }
  std::vector<Overclosure> take() { return std::move(found_); }

 private:
  const ContactSystem& contact_;
  const VecX& x_;
  std::vector<Overclosure> found_;
};

}  // namespace

std::vector<Overclosure> find_overclosures(const ContactSystem& contact, const VecX& x) {
  Search search(contact, x);
  const CollisionMesh& mesh = contact.surface().mesh;
  const Candidates& candidates = contact.candidates();
  for_each_kind(mesh, candidates, [&](const auto& kind) {
    for (size_t i = 0; i < kind.pairs.size(); ++i)
      search.check(kind.first(kind.pairs[i]), kind.second(kind.pairs[i]), (candidates.distance_bounds.*kind.lengths)[i]);
  });
  return search.take();
}

}  // namespace tack
