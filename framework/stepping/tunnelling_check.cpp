#include "framework/stepping/tunnelling_check.hpp"

#include <algorithm>
#include <cmath>

#include "framework/contact/contact_system.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/broad_phase/candidate_finder.hpp"
#include "geometry/ccd/accd.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int max_stages = 256;       // stages of a step; AABBs swept in the whole step would overlap nearly everything
constexpr int max_restarts = 32;      // of additive CCD, which stops at 2% of the gap at its start
constexpr double gap_ratio_min = 1e-3;  // of the smaller of the gaps at both ends; a smaller gap is a hit

template <size_t N>
std::array<Vec3, N> moved(std::array<Vec3, N> at, const std::array<Vec3, N>& displacement, double t) {
  for (size_t i = 0; i < N; ++i) at[i] += t * displacement[i];
  return at;
}

// Start and displacement of a step, and the examined interval of it, as fractions.
struct Stage {
  const VecX& x;
  const VecX& displacement;
  double begin, end;
};

template <size_t N>
Vec3 mean(const std::array<Vec3, N>& displacements) {
  Vec3 sum = Vec3::Zero();
  for (const Vec3& displacement : displacements) sum += displacement;
  return sum / static_cast<double>(N);
}

// Criterion of tunnelling for two components: they meet before the relative displacement reaches
// `approach`, and move on by at least `rest` [m].
struct Criterion {
  double approach = 0, rest = 0;
};

// Returns whether two primitives meet in the stage, and tunnel.
template <size_t A, size_t B>
bool meet(const std::array<int, A>& va, const std::array<int, B>& vb, const Stage& stage, const Criterion& criterion) {
  const double displacement = (mean(corners(stage.displacement, va)) - mean(corners(stage.displacement, vb))).norm(), approach = std::min(criterion.approach, displacement - criterion.rest);
  if (displacement * stage.begin >= approach) return false;
  const auto a = corners(stage.x, va);
  const auto b = corners(stage.x, vb);
  const auto da = corners(stage.displacement, va);
  const auto db = corners(stage.displacement, vb);
  double t = stage.begin, smallest = -1;
  for (int restart = 0; restart < max_restarts; ++restart) {
    const auto at = moved(a, da, t);
    const auto bt = moved(b, db, t);
    if (restart > 0) {
      if (smallest < 0) smallest = std::min(squared_distance(a, b), squared_distance(moved(a, da, 1), moved(b, db, 1)));
      if (squared_distance(at, bt) <= gap_ratio_min * gap_ratio_min * smallest) break;
    }
    const double left = stage.end - t, free = accd(at, bt, da, db, 0, left);
    if (free >= left) return false;
    t += free;
  }
  return displacement * t < approach;
}

}  // namespace

// Search for the first pair of components that tunnels.
struct TunnellingCheck::Search {
  const CollisionMesh& mesh;
  const MovingComponents& components;
  const std::vector<std::array<int, 2>>& pairs;  // ascending

  const double least;                             // smallest size of a component [m]

  // Returns the criterion for two components; approach 0 if they are not checked.
  Criterion criterion(int component, int other) const {
    if (!std::binary_search(pairs.begin(), pairs.end(), std::array{std::min(component, other), std::max(component, other)})) return {};
    const MovingComponent &a = components[component], &b = components[other];
    const double size = smaller_size(a, b, least), rest = TunnellingCheck::tolerated * size;
    return {a.displacement_against(b, size) - rest, rest};
  }

  // Returns the components of the first candidate of a kind that meets.
  template <class Kind>
  std::optional<std::array<int, 2>> first_met(const Kind& kind, const Stage& stage) const {
    const int n = static_cast<int>(kind.pairs.size());
    const double first = min_chunks(n, n, [&](int begin, int end) {
      for (int i = begin; i < end; ++i) {
        const auto& a = kind.first(kind.pairs[i]);
        const auto& b = kind.second(kind.pairs[i]);
        if (meet(a, b, stage, criterion(components.component_of(a[0]), components.component_of(b[0])))) return double(i);
      }
      return double(n);
    });
    if (first == n) return std::nullopt;
    const auto& pair = kind.pairs[static_cast<size_t>(first)];
    return std::array{components.component_of(kind.first(pair)[0]), components.component_of(kind.second(pair)[0])};
  }

  std::optional<std::array<int, 2>> met(const Candidates& c, const Stage& stage) const {
    std::optional<std::array<int, 2>> found;
    for_each_kind(mesh, c, [&](const auto& kind) {
      if (!found) found = first_met(kind, stage);
    });
    return found;
  }
};

TunnellingCheck::TunnellingCheck(const World& world) : world_(world), components_(world) {}

TunnellingCheck::~TunnellingCheck() = default;

std::optional<std::array<int, 2>> TunnellingCheck::find_components(const VecX& x, const VecX& y, const std::vector<std::array<int, 2>>& pairs) {
  const ContactSystem& contact = *world_.contact;
  const CollisionMesh& mesh = contact.surface().mesh;
  if (!finder_) finder_ = std::make_unique<CandidateFinder>(mesh, contact.colliding());
  std::vector<char> concerned(components_.count(), 0);
  for (const auto& [a, b] : pairs) concerned[a] = concerned[b] = 1;
  const VecX displacement = y - x;
  const double stages = std::clamp(std::ceil(displacement.lpNorm<Eigen::Infinity>() / contact.search_displacement_max()), 1.0, double(max_stages));
  const Search search{mesh, components_, pairs, contact.range()};
  std::vector<Aabb> boxes(mesh.vertex_object.size());
  Candidates candidates;
  const InflationRadii touching = InflationRadii::uniform(mesh, 0, 0);
  for (int i = 0; i < stages; ++i) {
    const Stage stage{x, displacement, i / stages, i + 1 < stages ? (i + 1) / stages : 1};
    for (const int v : mesh.vertices) {
      boxes[v] = {};
      boxes[v].include(vertex(x, v) + stage.begin * vertex(displacement, v));
      if (concerned[components_.component_of(v)]) boxes[v].include(vertex(x, v) + stage.end * vertex(displacement, v));
    }
    finder_->find(boxes, touching, candidates);
    if (auto found = search.met(candidates, stage)) return found;
  }
  return std::nullopt;
}

std::optional<Tunnelling> TunnellingCheck::find(const VecX& x, const VecX& y) {
  components_.move(x, y);
  const double least = world_.contact->range();
  const auto pairs = components_.tunnelling_pairs(tolerated, least);
  if (pairs.empty()) return std::nullopt;
  const auto found = find_components(x, y, pairs);
  if (!found) return std::nullopt;
  const MovingComponent &a = components_[(*found)[0]], &b = components_[(*found)[1]];
  const auto farthest = [](const MovingComponent& component) { return component.displacement.lo.cwiseAbs().cwiseMax(component.displacement.hi.cwiseAbs()).norm(); };
  const bool first = farthest(a) >= farthest(b);
  const double size = smaller_size(a, b, least);
  Tunnelling tunnelling{first ? a.object : b.object, first ? b.object : a.object, a.displacement_against(b, size), size};
  while (tunnelling.displacement > tunnelling.substeps * tolerated * tunnelling.size) tunnelling.substeps *= 2;
  return tunnelling;
}

}  // namespace tack
