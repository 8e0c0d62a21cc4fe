#include "framework/contact/overlap_boundary_forces.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace tack {
namespace {

// Returns the gradients of the barycentric coordinates of a triangle, in its plane [1/m].
std::array<Vec3, 3> slopes(const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const Vec3 over = normal / normal.squaredNorm();
  return {over.cross(t[2] - t[1]), over.cross(t[0] - t[2]), over.cross(t[1] - t[0])};
}

// Collects the forces of one pair of objects.
class PairForces {
 public:
  // sum: zero, and again when they have been handed over; touched: none, and of none again.
  PairForces(int a, int b, const PairTable& table, const CollisionMesh& mesh, const LaggedSurface& held, VecX& sum, std::vector<char>& touched)
      : a_(a), b_(b), table_(table), mesh_(mesh), held_(held), sum_(sum), touched_(touched) {}

  void add(const OverlapBoundaryEdge& rim) {
    const std::array<Vec3, 3> other = corners(held_.x(), mesh_.triangles[rim.other]);
    const Vec3 p = point_inside(held_.x(), mesh_.triangles[rim.triangle], rim.inside);
    const int next = (rim.side + 1) % 3;
    const Vec3 along = other[next] - other[rim.side], normal = held_.normal(rim.other);
    const double part = along.dot(p - other[rim.side]) / along.squaredNorm();
    const double height = normal.dot(p - other[rim.side]);
    const Vec3 outward = along.cross(normal).normalized();
    const double strength = energy(rim.triangle, rim.other, std::abs(height)) * rim.length;
    if (strength == 0) return;
    Vec3 foot = Vec3::Zero();
    foot[rim.side] = 1 - part;
    foot[next] = part;
    const std::array<Vec3, 3> slope = slopes(other);
    for (int i = 0; i < 3; ++i) {
      act(mesh_.triangles[rim.triangle][i], strength * rim.inside[i] * outward);
      act(mesh_.triangles[rim.other][i], strength * (height * outward.dot(slope[i]) * normal - foot[i] * outward));
    }
  }

  void add(const OverlapFacet& covered) {
    const Vec3 normal = held_.normal(covered.leader);
    const std::array<Vec3, 3> own = corners(held_.x(), mesh_.triangles[covered.triangle]);
    const Vec3 twice = (own[1] - own[0]).cross(own[2] - own[0]);
    const double whole = twice.dot(normal) / 2;
    const double strength = energy(covered.triangle, covered.leader, covered.distance);
    if (strength == 0 || std::abs(whole) < least_cosine / 2 * twice.norm()) return;
    const double half = -strength * covered.area / whole / 2;  // the sign with it
    if (covered.leader != leader_) {  // corners of a triangle mostly have the same
      leader_ = covered.leader;
      leader_slopes_ = slopes(corners(held_.x(), mesh_.triangles[leader_]));
    }
    for (int i = 0; i < 3; ++i) {
      act(mesh_.triangles[covered.triangle][i], half * (own[(i + 1) % 3] - own[(i + 2) % 3]).cross(normal));
      act(mesh_.triangles[covered.leader][i], -half * twice.dot(leader_slopes_[i]) * normal);
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
  const LaggedSurface& held_;
  VecX& sum_;
  std::vector<char>& touched_;
  std::vector<int> order_;  // those touched, once each
  int leader_ = -1;         // of the slopes
  std::array<Vec3, 3> leader_slopes_;
};

}  // namespace

void OverlapBoundaryForces::take(const std::vector<OverlapFacets>& pairs, const PairTable& table, const CollisionMesh& mesh,
                     const LaggedSurface& held) {
  pairs_.clear();
  all_.resize(0);
  VecX sum;
  std::vector<char> touched;
  for (const OverlapFacets& pair : pairs) {
    const PairRole& role = table.point(pair.a, pair.b);
    if (role.law < 0 || (pair.parts.empty() && pair.rims.empty())) continue;
    if (all_.size() == 0) {
      all_ = sum = VecX::Zero(held.x().size());
      touched.assign(mesh.vertex_object.size(), false);
    }
    PairForces forces(pair.a, pair.b, table, mesh, held, sum, touched);
    for (const OverlapFacet& part : pair.parts) forces.add(part);
    for (const OverlapBoundaryEdge& rim : pair.rims) forces.add(rim);
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
