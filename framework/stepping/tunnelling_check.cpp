#include "framework/stepping/tunnelling_check.hpp"

#include <algorithm>
#include <cmath>

#include "framework/contact/contact_system.hpp"
#include "geometry/broad_phase/candidate_finder.hpp"
#include "geometry/ccd/accd.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int most_stages = 256;       // of a way; the boxes that all of it sweeps would overlap nearly everything
constexpr int most_restarts = 32;      // of additive CCD, which stops where 2% of the gap that it started from is left
constexpr double nothing_left = 1e-3;  // of the smaller of the gaps at both ends: blocked

double part_free(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b, const std::array<Vec3, 2>& da, const std::array<Vec3, 2>& db, double end) {
  return edge_edge_accd(a[0], a[1], b[0], b[1], da[0], da[1], db[0], db[1], 0, end);
}
double part_free(const std::array<Vec3, 1>& a, const std::array<Vec3, 3>& b, const std::array<Vec3, 1>& da, const std::array<Vec3, 3>& db, double end) {
  return point_triangle_accd(a[0], b[0], b[1], b[2], da[0], db[0], db[1], db[2], 0, end);
}
double part_free(const std::array<Vec3, 1>& a, const std::array<Vec3, 2>& b, const std::array<Vec3, 1>& da, const std::array<Vec3, 2>& db, double end) {
  return point_edge_accd(a[0], b[0], b[1], da[0], db[0], db[1], 0, end);
}
double part_free(const std::array<Vec3, 1>& a, const std::array<Vec3, 1>& b, const std::array<Vec3, 1>& da, const std::array<Vec3, 1>& db, double end) {
  return point_point_accd(a[0], b[0], da[0], db[0], 0, end);
}

template <size_t N>
std::array<Vec3, N> moved(std::array<Vec3, N> at, const std::array<Vec3, N>& way, double t) {
  for (size_t i = 0; i < N; ++i) at[i] += t * way[i];
  return at;
}

// Start and displacement of the step, and the fraction of it that is examined.
struct Stage {
  const VecX& x;
  const VecX& way;
  double begin, end;
};

template <size_t N>
Vec3 mean(const std::array<Vec3, N>& ways) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& way : ways) sum += way;
  return sum / static_cast<double>(N);
}

// Criterion of tunnelling for two components: they meet before the relative displacement reaches
// `approach`, and go on by `rest` [m].
struct Pass {
  double approach = 0, rest = 0;
};

// Returns whether two primitives meet in the stage, and tunnel.
template <size_t A, size_t B>
bool meet(const std::array<int, A>& va, const std::array<int, B>& vb, const Stage& stage, const Pass& pass) {
  const double way = (mean(corners(stage.way, va)) - mean(corners(stage.way, vb))).norm(), approach = std::min(pass.approach, way - pass.rest);
  if (way * stage.begin >= approach) return false;
  const auto a = corners(stage.x, va);
  const auto b = corners(stage.x, vb);
  const auto da = corners(stage.way, va);
  const auto db = corners(stage.way, vb);
  double t = stage.begin, smallest = -1;
  for (int restart = 0; restart < most_restarts; ++restart) {
    const auto at = moved(a, da, t);
    const auto bt = moved(b, db, t);
    if (restart > 0) {
      if (smallest < 0) smallest = std::min(squared_distance(a, b), squared_distance(moved(a, da, 1), moved(b, db, 1)));
      if (squared_distance(at, bt) <= nothing_left * nothing_left * smallest) break;
    }
    const double left = stage.end - t, free = part_free(at, bt, da, db, left);
    if (free >= left) return false;
    t += free;
  }
  return way * t < approach;
}

}  // namespace

// The pairs that are looked at, and what meets of them.
struct TunnellingCheck::Search {
  const CollisionMesh& mesh;
  const MovingComponents& parts;
  const std::vector<std::array<int, 2>>& pairs;  // ascending

  const double least;                             // the size of what has none [m]

  // Criterion for two components; approach 0 if they are not examined.
  Pass pass(int part, int other) const {
    if (!std::binary_search(pairs.begin(), pairs.end(), std::array{std::min(part, other), std::max(part, other)})) return {};
    const MovingComponent &a = parts[part], &b = parts[other];
    const double size = smaller_size(a, b, least), rest = TunnellingCheck::tolerated * size;
    return {a.displacement_against(b, size) - rest, rest};
  }

  // The parts of the first of the candidates that meet.
  template <class Primitives>
  std::optional<std::array<int, 2>> first_met(const std::vector<std::array<int, 2>>& candidates, const Stage& stage,
                                              const Primitives& primitives) const {
    const int n = static_cast<int>(candidates.size());
    const double first = min_chunks(n, n, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto [a, b] = primitives(candidates[i]);
        if (meet(a, b, stage, pass(parts.part_of(a[0]), parts.part_of(b[0])))) return double(i);
      }
      return double(n);
    });
    if (first == n) return std::nullopt;
    const auto [a, b] = primitives(candidates[static_cast<size_t>(first)]);
    return std::array{parts.part_of(a[0]), parts.part_of(b[0])};
  }

  std::optional<std::array<int, 2>> met(const Candidates& c, const Stage& stage) const {
    const auto point = [](int v) { return std::array{v}; };
    if (auto found = first_met(c.point_triangle, stage, [&](const auto& p) { return std::pair{point(p[0]), mesh.triangles[p[1]]}; })) return found;
    if (auto found = first_met(c.edge_edge, stage, [&](const auto& p) { return std::pair{mesh.edges[p[0]], mesh.edges[p[1]]}; })) return found;
    if (auto found = first_met(c.point_edge, stage, [&](const auto& p) { return std::pair{point(p[0]), mesh.edges[p[1]]}; })) return found;
    return first_met(c.point_point, stage, [&](const auto& p) { return std::pair{point(p[0]), point(p[1])}; });
  }
};

TunnellingCheck::TunnellingCheck(const World& world) : world_(world), parts_(world) {}

TunnellingCheck::~TunnellingCheck() = default;

std::optional<std::array<int, 2>> TunnellingCheck::blocked_components(const VecX& x, const VecX& y, const std::vector<std::array<int, 2>>& pairs) {
  const ContactSystem& contact = *world_.contact;
  const CollisionMesh& mesh = contact.surface().mesh;
  if (!finder_) finder_ = std::make_unique<CandidateFinder>(mesh, contact.colliding());
  std::vector<char> concerned(parts_.count(), 0);
  for (const auto& [a, b] : pairs) concerned[a] = concerned[b] = 1;
  const VecX way = y - x;
  const double stages = std::clamp(std::ceil(way.lpNorm<Eigen::Infinity>() / contact.stride()), 1.0, double(most_stages));
  const Search search{mesh, parts_, pairs, contact.range()};
  std::vector<Aabb> boxes(mesh.vertex_object.size());
  Candidates candidates;
  const InflationRadii touching = InflationRadii::uniform(mesh, 0, 0);
  for (int i = 0; i < stages; ++i) {
    const Stage stage{x, way, i / stages, i + 1 < stages ? (i + 1) / stages : 1};
    for (const int v : mesh.vertices) {
      boxes[v] = {};
      boxes[v].include(vertex(x, v) + stage.begin * vertex(way, v));
      if (concerned[parts_.part_of(v)]) boxes[v].include(vertex(x, v) + stage.end * vertex(way, v));
    }
    finder_->find(boxes, touching, candidates);
    if (auto found = search.met(candidates, stage)) return found;
  }
  return std::nullopt;
}

std::optional<Tunnelling> TunnellingCheck::blocked(const VecX& x, const VecX& y) {
  parts_.move(x, y);
  const double least = world_.contact->range();
  const auto pairs = parts_.tunnelling_pairs(tolerated, least);
  if (pairs.empty()) return std::nullopt;
  const auto found = blocked_components(x, y, pairs);
  if (!found) return std::nullopt;
  const MovingComponent &a = parts_[(*found)[0]], &b = parts_[(*found)[1]];
  const auto furthest = [](const MovingComponent& part) { return part.way.lo.cwiseAbs().cwiseMax(part.way.hi.cwiseAbs()).norm(); };
  const bool first = furthest(a) >= furthest(b);
  const double size = smaller_size(a, b, least);
  Tunnelling blocked{first ? a.object : b.object, first ? b.object : a.object, a.displacement_against(b, size), size};
  while (blocked.way > blocked.parts * tolerated * blocked.size) blocked.parts *= 2;
  return blocked;
}

}  // namespace tack
