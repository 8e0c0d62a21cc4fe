#include "geometry/mesh/overlap_depth.hpp"

#include <bit>
#include <cmath>
#include <map>

#include "geometry/broad_phase/overlap_pairs.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

constexpr int samples_across = 8;  // samples across the intersection of two boxes

double angle_at(const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 u = b - a, v = c - a;
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

Aabb moved(Aabb box, const Vec3& by) {
  box.lo += by;
  box.hi += by;
  return box;
}

// Returns the parameters of the segment inside the box; none if it misses the box.
std::optional<std::pair<double, double>> clipped(const Vec3& p, const Vec3& q, const Aabb& box) {
  double first = 0, last = 1;
  for (int k = 0; k < 3; ++k) {
    const double d = q[k] - p[k];
    if (d == 0) {
      if (p[k] < box.lo[k] || p[k] > box.hi[k]) return std::nullopt;
      continue;
    }
    const double a = (box.lo[k] - p[k]) / d, b = (box.hi[k] - p[k]) / d;
    first = std::max(first, std::min(a, b));
    last = std::min(last, std::max(a, b));
  }
  if (first > last) return std::nullopt;
  return std::pair(first, last);
}

}  // namespace

SurfaceDistance::SurfaceDistance(const Mesh& mesh) : vertices_(mesh.vertices) {
  const Surface surface = extract_surface(mesh);
  used_ = surface.vertices;
  edges_ = surface.edges;
  triangles_ = surface.triangles;
  for (const int v : used_) box_.include(vertices_[v]);
  corner_.assign(vertices_.size(), Vec3::Zero());
  std::vector<Aabb> boxes;
  std::map<Edge, std::pair<Vec3, int>> sums;  // per edge: sum of normals, and uses along minus uses against its direction
  const auto edge = [](int a, int b) { return Edge{std::min(a, b), std::max(a, b)}; };
  double sixfold = 0;
  for (const Triangle& t : triangles_) {
    const Vec3 &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
    const Vec3 normal = (b - a).cross(c - a).normalized();
    face_.push_back(normal);
    sixfold += (a - box_.lo).dot((b - a).cross(c - a));
    Aabb& box = boxes.emplace_back();
    for (int i = 0; i < 3; ++i) {
      const int v = t[i], w = t[(i + 1) % 3];
      box.include(vertices_[v]);
      corner_[v] += angle_at(vertices_[v], vertices_[w], vertices_[t[(i + 2) % 3]]) * normal;
      auto [at, is_new] = sums.try_emplace(edge(v, w), Vec3::Zero(), 0);
      at->second.first += normal;
      at->second.second += v < w ? 1 : -1;
    }
  }
  for (const Triangle& t : triangles_)
    side_.push_back({sums[edge(t[0], t[1])].first, sums[edge(t[1], t[2])].first, sums[edge(t[2], t[0])].first});
  for (const Edge& e : edges_) {
    const auto sum = sums.find(edge(e[0], e[1]));
    edge_.push_back(sum == sums.end() ? Vec3(Vec3::Zero()) : sum->second.first);
  }
  closed_ = !triangles_.empty() && sixfold > 0 &&
            std::all_of(sums.begin(), sums.end(), [](const auto& sum) { return sum.second.second == 0; });
  volume_ = closed_ ? sixfold / 6 : M_PI / 6 * std::pow((box_.hi - box_.lo).norm(), 3);
  tree_ = Bvh(boxes);
}

std::optional<SurfaceDistance::Closest> SurfaceDistance::at(const Vec3& x, double range) const {
  // Most points are near the surface: small ranges are searched first.
  for (double r = (box_.hi - box_.lo).norm() / 64; r < range; r *= 4)
    if (auto found = within(x, r)) return found;
  return within(x, range);
}

std::optional<SurfaceDistance::Closest> SurfaceDistance::within(const Vec3& x, double range) const {
  if (triangles_.empty()) return std::nullopt;
  Aabb box;
  box.include(x);
  box.inflate(range);
  double least = range * range;
  Vec3 closest, normal;
  int nearest = -1;
  detail::visit_groups(tree_, box, false, -1, [&](int group) {
    for (unsigned lanes = tree_.boxes(0, group).overlap_mask(box); lanes != 0; lanes &= lanes - 1) {
      const int i = tree_.primitives(group)[std::countr_zero(lanes)];
      const Triangle& t = triangles_[i];
      const Vec3 &a = vertices_[t[0]], &b = vertices_[t[1]], &c = vertices_[t[2]];
      const PointTriangleType type = point_triangle_type(x, a, b, c);
      const Vec3 w = point_triangle_barycentric(x, a, b, c, type);
      const Vec3 there = w[0] * a + w[1] * b + w[2] * c;
      const double s = (x - there).squaredNorm();
      if (s > least || (s == least && nearest >= 0 && i > nearest)) continue;
      least = s;
      closest = there;
      nearest = i;
      const int feature = static_cast<int>(type);  // three vertices, three edges, the face
      normal = feature < 3 ? corner_[t[feature]] : feature < 6 ? side_[i][feature - 3] : face_[i];
    }
  });
  if (nearest < 0) return std::nullopt;
  const Vec3 offset = x - closest;
  const double distance = std::sqrt(least);
  if (!closed_) {
    if (distance == 0) return std::nullopt;
    return Closest{distance, offset / distance};
  }
  const bool inside = offset.dot(normal) < 0;
  // On the surface, the direction of the offset is round-off.
  if (distance <= 1e-9 * (box_.hi - box_.lo).norm()) return Closest{inside ? -distance : distance, normal.normalized()};
  return Closest{inside ? -distance : distance, offset / (inside ? -distance : distance)};
}

void SurfaceDistance::sample(const Aabb& box, double spacing, std::vector<Sample>& samples) const {
  const double outwards = closed_ ? 1 : 0;
  for (const int v : used_)
    if (box.contains(vertices_[v])) samples.push_back({vertices_[v], outwards * corner_[v]});
  for (size_t e = 0; e < edges_.size(); ++e) {
    const auto& [v, w] = edges_[e];
    const Vec3 &p = vertices_[v], &q = vertices_[w];
    const bool is_short = (q - p).norm() < spacing;  // its vertices suffice
    const auto clip = is_short ? std::nullopt : clipped(p, q, box);
    if (!clip) continue;
    const int n = static_cast<int>((q - p).norm() * (clip->second - clip->first) / spacing) + 1;
    for (int i = 0; i <= n; ++i) {
      const double u = clip->first + (clip->second - clip->first) * i / n;
      samples.push_back({p + u * (q - p), outwards * edge_[e]});
    }
  }
  // Interiors of triangles: points of a grid in the coordinate plane that is most parallel to the triangle.
  for (size_t i = 0; i < triangles_.size(); ++i) {
    const Vec3 &a = vertices_[triangles_[i][0]], &b = vertices_[triangles_[i][1]], &c = vertices_[triangles_[i][2]];
    Aabb clip;
    clip.include(a);
    clip.include(b);
    clip.include(c);
    if (!clip.overlaps(box)) continue;
    clip.lo = clip.lo.cwiseMax(box.lo);
    clip.hi = clip.hi.cwiseMin(box.hi);
    if ((clip.hi - clip.lo).maxCoeff() < spacing) continue;  // its vertices suffice
    int z = 0;
    face_[i].cwiseAbs().maxCoeff(&z);
    if (face_[i][z] == 0) continue;
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    const auto first = [&](int k) { return std::ceil((clip.lo[k] - box.lo[k]) / spacing); };
    for (double m = first(x); box.lo[x] + m * spacing <= clip.hi[x]; ++m)
      for (double n = first(y); box.lo[y] + n * spacing <= clip.hi[y]; ++n) {
        Vec3 at;
        at[x] = box.lo[x] + m * spacing;
        at[y] = box.lo[y] + n * spacing;
        at[z] = a[z] - (face_[i][x] * (at[x] - a[x]) + face_[i][y] * (at[y] - a[y])) / face_[i][z];
        const auto left_of = [&](const Vec3& p, const Vec3& q) { return (q - p).cross(at - p).dot(face_[i]) >= 0; };
        if (at[z] >= box.lo[z] && at[z] <= box.hi[z] && left_of(a, b) && left_of(b, c) && left_of(c, a)) samples.push_back({at, outwards * face_[i]});
      }
  }
}

std::optional<OverlapDepth> overlap_depth(const SurfaceDistance& first, const Vec3& a, const SurfaceDistance& second, const Vec3& b, double range,
                                          double deepest) {
  Aabb box = moved(first.box(), a), other = moved(second.box(), b);
  box.inflate(range);
  other.inflate(range);
  if (!box.overlaps(other)) return std::nullopt;
  box.lo = box.lo.cwiseMax(other.lo);
  box.hi = box.hi.cwiseMin(other.hi);
  const double spacing = (box.hi - box.lo).maxCoeff() / samples_across;
  std::optional<OverlapDepth> worst, beyond;
  std::vector<SurfaceDistance::Sample> samples;
  const auto examine = [&](const SurfaceDistance& of, const Vec3& by, const SurfaceDistance& in, const Vec3& around, double sign) {
    samples.clear();
    of.sample(moved(box, -by), spacing, samples);
    for (const auto& [p, normal] : samples) {
      const auto closest = in.at(p + by - around, std::max(range, deepest));
      if (!closest || closest->distance >= range) continue;
      auto& found = normal.dot(closest->away) <= 0 ? worst : beyond;
      if (!(found && found->distance <= closest->distance)) found = OverlapDepth{closest->distance, p + by, sign * closest->away};
    }
  };
  examine(first, a, second, b, 1);
  examine(second, b, first, a, -1);
  if (beyond && beyond->distance < 0 && !(worst && worst->distance < 0)) {
    const Vec3 between = first.middle() + a - second.middle() - b;
    const double length = between.norm();
    worst = {beyond->distance, beyond->at, length > 0 ? Vec3(between / length) : Vec3(Vec3::UnitY())};
  }
  return worst;
}

}  // namespace tack
