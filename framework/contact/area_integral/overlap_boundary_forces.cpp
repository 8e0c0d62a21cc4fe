#include "framework/contact/area_integral/overlap_boundary_forces.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/contact/area_integral/own_boundary.hpp"
#include "geometry/distance/barycentric_slopes.hpp"

namespace tack {
namespace {

// Overhangs within this of the own boundary depend on the positions, over the range of the law. In a step, a boundary moves
// by less.
constexpr double overhang_per_range_max = 1;

// Collects the forces of one pair of objects.
class PairForces {
 public:
  // sum: zero before construction and after hand_over(). touched: all false before and after.
  PairForces(int a, int b, const PairTable& table, const CollisionMesh& mesh, const LaggedSurface& lagged, VecX& sum, std::vector<char>& touched, std::vector<Overhang>& overhangs)
      : a_(a), b_(b), table_(table), mesh_(mesh), lagged_(lagged), sum_(sum), touched_(touched), overhangs_(overhangs) {}

  void add(const OverlapBoundaryEdge& edge) {
    const std::array<Vec3, 3> other = corners(lagged_.x(), mesh_.triangles[edge.other]);
    const Vec3 p = point_inside(lagged_.x(), mesh_.triangles[edge.triangle], edge.inside);
    const int next = (edge.side + 1) % 3;
    const Vec3 direction = other[next] - other[edge.side], normal = lagged_.normal(edge.other);
    const double along_edge = direction.dot(p - other[edge.side]) / direction.squaredNorm();
    const double height = normal.dot(p - other[edge.side]);
    const Vec3 outward = direction.cross(normal).normalized();
    const double strength = energy(edge.triangle, edge.other, std::abs(height)) * edge.length;
    if (strength == 0) return;
    Vec3 foot = Vec3::Zero();
    foot[edge.side] = 1 - along_edge;
    foot[next] = along_edge;
    const std::array<Vec3, 3> slope = barycentric_slopes(other);
    std::array<int, 6> vertices;
    std::array<Vec3, 6> gradient;  // of s
    for (int i = 0; i < 3; ++i) {
      vertices[i] = mesh_.triangles[edge.triangle][i];
      vertices[3 + i] = mesh_.triangles[edge.other][i];
      gradient[i] = edge.inside[i] * outward;
      gradient[3 + i] = height * outward.dot(slope[i]) * normal - foot[i] * outward;
    }
    const double range = table_.point(a_, b_).range_max();
    const double width = way_to_boundary(mesh_, lagged_, {edge.triangle, edge.inside}, outward, normal, overhang_per_range_max * range);
    if (a_ != b_ && width <= overhang_per_range_max * range) overhangs_.push_back({a_, b_, vertices, gradient, -strength, width, softening_per_range * range});
    else
      for (int i = 0; i < 6; ++i) act(vertices[i], strength * gradient[i]);
  }

  void add(const OverlapFacet& facet) {
    const Vec3 normal = lagged_.normal(facet.seed_triangle);
    const std::array<Vec3, 3> own = corners(lagged_.x(), mesh_.triangles[facet.triangle]);
    const Vec3 twice = (own[1] - own[0]).cross(own[2] - own[0]);
    const double projected_area = twice.dot(normal) / 2;
    const double strength = energy(facet.triangle, facet.seed_triangle, facet.distance);
    if (strength == 0 || std::abs(projected_area) < facing_cosine_min / 2 * twice.norm()) return;
    const double half = -strength * facet.area / projected_area / 2;  // includes the sign
    if (facet.seed_triangle != seed_triangle_) {                      // facets of one triangle mostly have one seed triangle
      seed_triangle_ = facet.seed_triangle;
      seed_slopes_ = barycentric_slopes(corners(lagged_.x(), mesh_.triangles[seed_triangle_]));
    }
    for (int i = 0; i < 3; ++i) {
      act(mesh_.triangles[facet.triangle][i], half * (own[(i + 1) % 3] - own[(i + 2) % 3]).cross(normal));
      act(mesh_.triangles[facet.seed_triangle][i], -half * twice.dot(seed_slopes_[i]) * normal);
    }
  }

  void hand_over(std::vector<int>& vertices, std::vector<Vec3>& forces) {
    for (const int v : order_) {
      forces.push_back(vertex(sum_, v));
      vertex(sum_, v).setZero();
      touched_[v] = false;
    }
    vertices = std::move(order_);
  }

 private:
  double energy(int triangle, int other, double distance) const {
    const PairRole& role = table_.point(a_, b_, table_.region_pair(a_, b_, mesh_.triangles[triangle], mesh_.triangles[other]));
    return role.area_factor * std::min(0.0, table_.laws()[role.law].at(distance).value);
  }
  void act(int v, const Vec3& force) {
    vertex(sum_, v) += force;
    if (!touched_[v]) order_.push_back(v);
    touched_[v] = true;
  }

  int a_, b_;
  const PairTable& table_;
  const CollisionMesh& mesh_;
  const LaggedSurface& lagged_;
  VecX& sum_;
  std::vector<char>& touched_;
  std::vector<Overhang>& overhangs_;
  std::vector<int> order_;  // touched vertices, once each
  int seed_triangle_ = -1;  // of the slopes
  std::array<Vec3, 3> seed_slopes_;
};

}  // namespace

void OverlapBoundaryForces::update(const std::vector<OverlapFacets>& pairs, const PairTable& table, const CollisionMesh& mesh,
                                   const LaggedSurface& lagged) {
  pairs_.clear();
  all_.resize(0);
  overhangs_.clear();
  VecX sum;
  std::vector<char> touched;
  for (const OverlapFacets& pair : pairs) {
    const PairRole& role = table.point(pair.a, pair.b);
    if (role.law < 0 || (pair.facets.empty() && pair.boundary_edges.empty())) continue;
    if (all_.size() == 0) {
      all_ = sum = VecX::Zero(lagged.x().size());
      touched.assign(mesh.vertex_object.size(), false);
    }
    PairForces forces(pair.a, pair.b, table, mesh, lagged, sum, touched, overhangs_);
    for (const OverlapFacet& facet : pair.facets) forces.add(facet);
    for (const OverlapBoundaryEdge& edge : pair.boundary_edges) forces.add(edge);
    Pair& found = pairs_.emplace_back();
    found.a = pair.a;
    found.b = pair.b;
    forces.hand_over(found.vertices, found.forces);
    for (size_t i = 0; i < found.vertices.size(); ++i) vertex(all_, found.vertices[i]) += found.forces[i];
  }
}

VecX OverlapBoundaryForces::between(int a, int b, Eigen::Index size) const {
  VecX forces = VecX::Zero(size);
  for (const Pair& pair : pairs_)
    if ((pair.a == a && pair.b == b) || (pair.a == b && pair.b == a))
      for (size_t i = 0; i < pair.vertices.size(); ++i) vertex(forces, pair.vertices[i]) += pair.forces[i];
  return forces;
}

Vec3 OverlapBoundaryForces::on(int a, int b, const CollisionMesh& mesh) const {
  const VecX forces = between(a, b, 3 * static_cast<Eigen::Index>(mesh.vertex_object.size()));
  Vec3 sum = Vec3::Zero();
  for (size_t v = 0; v < mesh.vertex_object.size(); ++v)
    if (mesh.vertex_object[v] == a) sum += vertex(forces, static_cast<int>(v));
  return sum;
}

}  // namespace tack
