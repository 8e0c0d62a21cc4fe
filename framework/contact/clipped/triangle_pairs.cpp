#include "framework/contact/clipped/triangle_pairs.hpp"

#include <Eigen/Geometry>

#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Relative difference up to which two surfaces are equal in area: round-off of their sums.
constexpr double equal_area_ratio = 1e-9;

}  // namespace

TrianglePairFinder::TrianglePairFinder(const ContactSystem& system, const ClippedLaws& laws,
                                       const StripEdges& edges)
    : system_(system), laws_(laws), edges_(edges), rest_(system.surface()) {
  const ContactSurface& surface = system_.surface();
  const int objects = system_.pairs().objects();
  surface_area_.assign(objects, 0);
  for (const Triangle& t : surface.mesh.triangles) {
    const std::array<Vec3, 3> x = corners(surface.rest, t);
    surface_area_[surface.mesh.vertex_object[t[0]]] +=
        0.5 * (x[1] - x[0]).cross(x[2] - x[0]).norm();
  }
  has_planes_.assign(objects, 0);
  for (int b = 0; b < objects; ++b)
    for (int a = 0; a < objects && !has_planes_[b]; ++a)
      has_planes_[b] = laws_.any(a, b) && has_planes(b, a);
}

// Returns whether the planes of `object` are used towards the other.
bool TrianglePairFinder::has_planes(int object, int other) const {
  const ClippedPlanes planes = laws_.planes(object, other);
  if (planes == ClippedPlanes::of_both || object == other) return true;
  if (planes == ClippedPlanes::of_first || planes == ClippedPlanes::of_second)
    return planes == ClippedPlanes::of_first;
  if (planes == ClippedPlanes::of_coarser) return system_.pairs().finer(other, object);
  const double own = surface_area_[object], others = surface_area_[other];
  if (std::abs(own - others) > equal_area_ratio * (own + others)) return own > others;
  return system_.pairs().finer(other, object);
}

// Returns the law of two triangles, that of their regions; -1: none.
int TrianglePairFinder::law_of(int a, int b) const {
  const CollisionMesh& mesh = system_.surface().mesh;
  const Triangle &ta = mesh.triangles[a], &tb = mesh.triangles[b];
  const int of_a = mesh.vertex_object[ta[0]], of_b = mesh.vertex_object[tb[0]];
  return laws_.between(of_a, of_b, system_.pairs().region_pair(of_a, of_b, ta, tb));
}

// Returns the edges of a triangle beyond which the law is another one.
template <class LawBeyond>
unsigned char TrianglePairFinder::interfaces(int triangle, int law,
                                             const LawBeyond& law_beyond) const {
  unsigned found = 0;
  for (int k = 0; k < 3; ++k) {
    const int beyond = edges_.neighbour(triangle, k);
    if (beyond >= 0 && law_beyond(beyond) != law) found |= 1u << k;
  }
  return static_cast<unsigned char>(found);
}

// Appends the pairs that stand for triangles a and b.
void TrianglePairFinder::add(int a, int b, std::vector<TrianglePair>& out) {
  const CollisionMesh& mesh = system_.surface().mesh;
  const int of_a = mesh.vertex_object[mesh.triangles[a][0]];
  const int of_b = mesh.vertex_object[mesh.triangles[b][0]];
  const int law = law_of(a, b), of_objects = laws_.between(of_a, of_b, -1);
  if (law < 0 && of_objects < 0) return;
  if (of_a == of_b && rest_.neighbours(a, b, laws_.laws()[law < 0 ? of_objects : law].range))
    return;
  TrianglePair pair{a, b, law, law, 0, 0};
  if (law != of_objects) {
    pair.interfaces_a = interfaces(a, law, [&](int beyond) { return law_of(beyond, b); });
    pair.interfaces_b = interfaces(b, law, [&](int beyond) { return law_of(a, beyond); });
  }
  if (of_objects >= 0 && (pair.interfaces_a | pair.interfaces_b) != 0) {
    out.push_back({a, b, of_objects, -1, 0, 0});
    pair.law = laws_.difference(law, of_objects);
  }
  if (pair.law >= 0) out.push_back(pair);
}

std::vector<TrianglePair> TrianglePairFinder::find() {
  const CollisionMesh& mesh = system_.surface().mesh;
  const int all = static_cast<int>(mesh.triangles.size());
  std::vector<std::vector<TrianglePair>> found(chunk_count(all));
  for_each_chunk(all, [&](int chunk, int first, int last) {
    std::vector<int> near_by;
    for (int b = first; b < last; ++b) {
      const int object = mesh.vertex_object[mesh.triangles[b][0]];
      if (!has_planes_[object]) continue;
      near_by.clear();
      system_.broad_phase().triangles_near(mesh.triangles[b], near_by);
      for (const int a : near_by) {
        const int other = mesh.vertex_object[mesh.triangles[a][0]];
        if (laws_.any(other, object) && has_planes(object, other)) add(a, b, found[chunk]);
      }
    }
  });
  std::vector<TrianglePair> pairs;
  for (const auto& some : found) pairs.insert(pairs.end(), some.begin(), some.end());
  return pairs;
}

}  // namespace tack
