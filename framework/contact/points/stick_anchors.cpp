#include "framework/contact/points/stick_anchors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace tack {
namespace {

constexpr int width = 2 * largest_contact_arity + 9;

// Returns the orthonormal frame of a triangle at x; I without a triangle or without area.
Mat3 frame_of(const std::array<int, 3>& triangle, const VecX& x) {
  if (triangle[0] < 0) return Mat3::Identity();
  const Vec3 u = vertex(x, triangle[1]) - vertex(x, triangle[0]), v = vertex(x, triangle[2]) - vertex(x, triangle[0]);
  const Vec3 area = u.cross(v);
  if (!(area.norm() > 0)) return Mat3::Identity();
  Mat3 frame;
  frame.col(0) = u.normalized();
  frame.col(2) = area.normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

template <class Point>
Vec3 separation(const Point& p, int count, const std::array<int, largest_contact_arity>& vertices, const VecX& x) {
  Vec3 r = Vec3::Zero();
  for (int i = 0; i < count; ++i) r += p[i] * vertex(x, vertices[i]);
  return r;
}

}  // namespace

struct StickAnchors::Placed {
  Vec3 position;     // of the point
  Vec3 r, slip;      // r and E
};

bool StickAnchors::any(const PairTable& pairs) {
  for (size_t law = 0; law < pairs.laws().size(); ++law)
    if (pairs.tangential(static_cast<int>(law)).sticks()) return true;
  return false;
}

void StickAnchors::read(const History& history) {
  anchors_.clear();
  const auto found = history.find(history_name);
  if (found == history.end()) return;
  const HistoryArray& array = found->second;
  if (array.width != width || static_cast<int>(array.keys.size()) != array.entries()) throw std::logic_error("the anchors of friction have another width");
  for (int e = 0; e < array.entries(); ++e) {
    const double* v = array.values.data() + static_cast<size_t>(width) * e;
    Anchor a{};
    a.count = static_cast<int>(*v++);
    a.own_count = static_cast<int>(*v++);
    a.object = static_cast<int>(*v++);
    a.opposite = array.keys[e][1];
    for (int& i : a.vertices) i = static_cast<int>(*v++);
    for (double& c : a.c) c = *v++;
    for (int& i : a.triangle) i = static_cast<int>(*v++);
    a.w = Vec3(v[0], v[1], v[2]);
    anchors_.push_back(a);
  }
}

void StickAnchors::assign(const PairTable& pairs, const VecX& x, ContactPoints& points) const {
  if (anchors_.empty()) return;
  std::vector<Placed> placed;
  std::vector<std::array<int, 2>> of_vertex;  // own vertex, anchor
  for (size_t k = 0; k < anchors_.size(); ++k) {
    const Anchor& a = anchors_[k];
    Placed p{Vec3::Zero(), separation(a.c, a.count, a.vertices, x), {}};
    for (int i = 0; i < a.own_count; ++i) {
      p.position += a.c[i] * vertex(x, a.vertices[i]);
      of_vertex.push_back({a.vertices[i], static_cast<int>(k)});
    }
    p.slip = p.r - frame_of(a.triangle, x) * a.w;
    placed.push_back(p);
  }
  std::sort(of_vertex.begin(), of_vertex.end());
  for_each_record(points, [&](auto& c) {
    const double longest = pairs.tangential(c.law).elastic_slip;
    if (longest == 0) return;
    Vec3 position = Vec3::Zero();
    for (int i = 0; i < c.own_vertex_count; ++i) position += c.coefficients[i] * vertex(x, c.vertices[i]);
    const Placed* closest = nullptr;
    std::pair<bool, double> least{true, std::numeric_limits<double>::infinity()};  // another stencil, squared distance
    for (int i = 0; i < c.own_vertex_count; ++i)
      for (auto at = std::lower_bound(of_vertex.begin(), of_vertex.end(), std::array{c.vertices[i], 0}); at != of_vertex.end() && (*at)[0] == c.vertices[i]; ++at) {
        const Anchor& a = anchors_[(*at)[1]];
        const Placed& p = placed[(*at)[1]];
        if (a.object != c.object || a.opposite != c.opposite || p.r.dot(c.normal) <= 0) continue;
        const bool other = a.count != static_cast<int>(c.vertices.size()) || !std::equal(c.vertices.begin(), c.vertices.end(), a.vertices.begin());
        const std::pair<bool, double> distance{other, (p.position - position).squaredNorm()};
        if (distance < least) least = distance, closest = &p;
      }
    if (!closest) return;
    c.elastic = c.tangents.transpose() * closest->slip;
    if (const double size = c.elastic.norm(); size > longest) c.elastic *= longest / size;
  });
}

void StickAnchors::write(const ContactPoints& points, const PairTable& pairs, const SurfaceTopology& topology, const CollisionMesh& mesh, const VecX& start, const VecX& x,
                         History& history) {
  std::vector<Anchor> anchors;
  for_each_arity(points, [&]<int K>(const std::vector<ContactPoint<K>>& list) {
    for (const ContactPoint<K>& c : list) {
      const double longest = pairs.tangential(c.law).elastic_slip;
      if (longest == 0) continue;
      Anchor a{K, c.own_vertex_count, {}, {}, {-1, -1, -1}, Vec3::Zero(), c.object, c.opposite};
      a.vertices.fill(-1);
      for (int i = 0; i < K; ++i) a.vertices[i] = c.vertices[i], a.c[i] = c.coefficients[i];
      // A triangle of the opposite feature, or else of the point.
      for (const int i : {c.own_vertex_count, 0})
        if (const auto triangles = topology.triangles_at(c.vertices[i]); a.triangle[0] < 0 && !triangles.empty()) a.triangle = mesh.triangles[triangles.front()];
      if (K - c.own_vertex_count == 3) a.triangle = {c.vertices[K - 3], c.vertices[K - 2], c.vertices[K - 1]};
      const Vec2 u = c.elastic + c.tangents.transpose() * c.moved(x, start);
      const double y = u.norm();
      // The elastic slip stays, the rest of u moves the anchor. Tangents may be scaled.
      const Vec2 scale(c.tangents.col(0).squaredNorm(), c.tangents.col(1).squaredNorm());
      const Vec2 plastic = y > longest ? Vec2((1 - longest / y) * u) : Vec2::Zero();
      const Vec3 slip = c.tangents * (c.elastic - plastic).cwiseQuotient(scale);
      a.w = frame_of(a.triangle, start).transpose() * (separation(a.c, K, a.vertices, start) - slip);
      anchors.push_back(a);
    }
  });
  std::stable_sort(anchors.begin(), anchors.end(), [](const Anchor& a, const Anchor& b) { return std::array{a.vertices[0], a.opposite} < std::array{b.vertices[0], b.opposite}; });
  HistoryArray array{width, {}, {}};
  for (const Anchor& a : anchors) {
    array.keys.push_back({a.vertices[0], a.opposite});
    array.values.insert(array.values.end(), {double(a.count), double(a.own_count), double(a.object)});
    array.values.insert(array.values.end(), a.vertices.begin(), a.vertices.end());
    array.values.insert(array.values.end(), a.c.begin(), a.c.end());
    array.values.insert(array.values.end(), a.triangle.begin(), a.triangle.end());
    array.values.insert(array.values.end(), a.w.begin(), a.w.end());
  }
  history[history_name] = std::move(array);
}

}  // namespace tack
