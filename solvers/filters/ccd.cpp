// Continuous collision detection as a step filter: no pair of primitives may lose more than 90% of
// its gap, the distance less the pair's contact offset, in a step. A pair is skipped if its motion
// is shorter than a lower bound of its gap: its distance bound, the gap of its boxes, or its
// reference distance less its displacement bounds. The others go to additive CCD.
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/stencils/rest_neighbours.hpp"
#include "framework/core/step_filter.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/broad_phase/displacement_bounds.hpp"
#include "geometry/ccd/accd.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/parallel.hpp"
#include "geometry/vertex_items.hpp"
#include "solvers/filters/separating_planes.hpp"

namespace tack {
namespace {

constexpr double gap_fraction_min = 0.1;      // fraction of each gap that must remain
// Reserve of distance bounds, as a fraction of the motion: additive CCD stops 1-2% short.
constexpr double stop_short_fraction = 0.02;
// Factor on motions compared with distance bounds.
constexpr double motion_factor = 1 / ((1 - gap_fraction_min) * (1 - stop_short_fraction));
// Least gap over the motion for which the whole motion passes, with a reserve.
constexpr double free_gap_fraction = gap_fraction_min + 2 * stop_short_fraction;
constexpr double stage_growth = 4;  // length of a stage of a fast step over the last one

// Returns an upper bound of the largest relative displacement of two vertices, through the mean
// displacement of all.
template <size_t A, size_t B>
double relative_displacement(const std::array<Vec3, A>& da, const std::array<Vec3, B>& db) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& d : da) mean += d;
  for (const Vec3& d : db) mean += d;
  mean /= static_cast<double>(A + B);
  double a = 0, b = 0;
  for (const Vec3& d : da) a = std::max(a, (d - mean).squaredNorm());
  for (const Vec3& d : db) b = std::max(b, (d - mean).squaredNorm());
  return std::sqrt(a) + std::sqrt(b);
}

// Two configurations and the path from the second one.
struct StepMotion {
  const VecX& reference;  // of the stored distances [m]
  const VecX& x;
  const VecX& p;
};

// Returns the largest step up to t that a pair allows. distance_bound: lower bound of its distance;
// distance: its reference distance; offset: of the pair [m].
template <size_t A, size_t B>
double bounded(const std::array<int, A>& va, const std::array<int, B>& vb, double distance_bound, double distance, double offset,
               const StepMotion& step, double t) {
  const auto da = corners(step.p, va);
  const auto db = corners(step.p, vb);
  const double motion = t * relative_displacement(da, db) / (1 - gap_fraction_min);
  if (motion < (1 - stop_short_fraction) * (distance_bound - offset)) return t;
  const auto a = corners(step.x, va);
  const auto b = corners(step.x, vb);
  const double reach = motion + offset;
  if (reach * reach < box_gaps(a, b).cwiseMax(0.0).squaredNorm()) return t;
  if (distance - offset > motion) {
    // Displacements since then.
    auto ua = corners(step.reference, va);
    auto ub = corners(step.reference, vb);
    for (size_t i = 0; i < A; ++i) ua[i] = a[i] - ua[i];
    for (size_t i = 0; i < B; ++i) ub[i] = b[i] - ub[i];
    const double before = relative_displacement(ua, ub);
    for (size_t i = 0; i < A; ++i) ua[i] += t * da[i];
    for (size_t i = 0; i < B; ++i) ub[i] += t * db[i];
    // Lower bound of the gap along the path.
    const double gap = distance - std::max(before, relative_displacement(ua, ub)) - offset;
    if (free_gap_fraction * motion < gap) return t;
  }
  return std::min(t, accd(a, b, da, db, gap_fraction_min, t, offset));
}

// Returns the largest displacement of a vertex [m].
double largest_motion(const VecX& p) {
  return std::sqrt(Eigen::Map<const Eigen::Matrix3Xd>(p.data(), 3, p.size() / 3).colwise().squaredNorm().maxCoeff());
}

class Ccd : public StepFilter {
 public:
  bool attach(const FeasibilityContext& context) override {
    contact_ = context.contact;
    clock_ = &context.clock;
    deadline_ = &context.clock.deadline();
    largest_offset_ = contact_ ? contact_->pairs().largest_offset() : 0;
    return contact_ != nullptr;
  }

  // Searches in stages. The swept AABBs of a fast step would overlap nearly everything, while
  // nearby obstacles truncate most of the path. Each stage searches its interval of the path
  // completely, so that the result is that of one search.
  double largest_step(const VecX& x, const VecX& p, double t_max) override {
    const double reach = contact_->search_displacement_max() / std::max(p.lpNorm<Eigen::Infinity>(), 1e-300);
    for (double stage = reach;; stage *= stage_growth) {
      const double end = std::min(stage, t_max);
      const double t = search(x, p, end);
      if (t < end || end == t_max || out_of_time()) return t;
    }
  }

  std::optional<Blocker> blocker(const VecX& x, const VecX& p) override {
    // The diagnosis runs after the deadline.
    const Deadline* const limit = std::exchange(deadline_, nullptr);
    double t = largest_step(x, p, 1);
    deadline_ = limit;
    if (t == 1) return std::nullopt;
    t = std::min(2 * t + 1e-300, 1.0);  // the candidates are those of the stage in which the pair was found
    const PhaseScope scope(*clock_, Phase::ccd);
    std::optional<Blocker> worst;
    const VecX& reference = contact_->candidates().reference;
    for_each_kind([&](const auto& kind) {
      for (size_t i = 0; i < kind.pairs.size(); ++i) {
        const auto& a = kind.first(kind.pairs[i]);
        const auto& b = kind.second(kind.pairs[i]);
        const double bound = bounded(a, b, kind.distance_bounds[i], kind.reference_distances[i], offset_of(a, b), {reference, x, p}, t);
        if (bound < t) worst = Blocker{{a.begin(), a.end()}, {b.begin(), b.end()}, std::sqrt(squared_distance(corners(x, a), corners(x, b))), t = bound};
      }
    });
    return worst;
  }

  std::optional<double> largest_local_step(const VecX& x, const VecX& p, std::span<const int> moved, double t_max) override {
    double motion = 0;
    for (const int v : moved) motion = std::max(motion, vertex(p, v).lpNorm<Eigen::Infinity>());
    const double reach = contact_->search_displacement_max() / std::max(motion, 1e-300);
    for (double stage = reach;; stage *= stage_growth) {
      const double end = std::min(stage, t_max), t = local_search(x, p, moved, end);
      if (t < end || end == t_max || out_of_time()) return t;
    }
  }

  void add_cuts(const VecX& x, const VecX& p, double below, std::vector<StepCut>& cuts) override {
    contact_->cover(x, below * p);
    const PhaseScope scope(*clock_, Phase::ccd);
    const double most = 2 * below * largest_motion(p) * motion_factor;  // bound of the relative displacement of two vertices
    const VecX& reference = contact_->candidates().reference;
    for_each_kind([&](const auto& kind) {
      const int n = static_cast<int>(kind.pairs.size());
      std::vector<std::vector<StepCut>> chunks(chunk_count(n));
      for_each_chunk(n, [&](int c, int first, int last) {
        for (int i = first; i < last; ++i) {
          if (most < kind.distance_bounds[i] - largest_offset_) continue;
          const auto& a = kind.first(kind.pairs[i]);
          const auto& b = kind.second(kind.pairs[i]);
          const double bound = bounded(a, b, kind.distance_bounds[i], kind.reference_distances[i], offset_of(a, b), {reference, x, p}, below);
          if (bound < below) chunks[c].push_back(step_cut(cut_kind(a.size(), b.size()), a, b, bound));
        }
      });
      for (const auto& chunk : chunks) cuts.insert(cuts.end(), chunk.begin(), chunk.end());
    });
  }

  bool bound_units(const VecX& x, const VecX& p, const MotionUnits& units, BlockBound kind_of_bound, std::vector<double>& bounds) override {
    contact_->cover(x, p);
    const PhaseScope scope(*clock_, Phase::ccd);
    for_each_kind([&](const auto& kind) {
      const int n = static_cast<int>(kind.pairs.size());
      std::vector<std::vector<UnitBound>> chunks(chunk_count(n));
      for_each_chunk(n, [&](int c, int first, int last) {
        for (int i = first; i < last; ++i) bound_units_of(kind, i, x, p, units, kind_of_bound, chunks[c]);
      });
      for (const std::vector<UnitBound>& chunk : chunks) lower(chunk, bounds);
    });
    return true;
  }

  bool bound_local_units(const VecX& x, const VecX& p, std::span<const int> moved, const MotionUnits& units, std::vector<double>& bounds) override {
    cover(x, p, moved, 1);
    const PhaseScope scope(*clock_, Phase::ccd);
    map_candidates();
    std::vector<UnitBound> found;
    size_t map = 0;
    for_each_kind([&](const auto& kind) {
      for (const int i : by_vertex_[map++].touching(moved)) bound_units_of(kind, i, x, p, units, BlockBound::together, found);
    });
    lower(found, bounds);
    return true;
  }

 private:
  // Appends the bounds of the units that move a pair.
  template <class Kind>
  void bound_units_of(const Kind& kind, int i, const VecX& x, const VecX& p, const MotionUnits& units, BlockBound kind_of_bound, std::vector<UnitBound>& bounds) const {
    const auto& a = kind.first(kind.pairs[i]);
    const auto& b = kind.second(kind.pairs[i]);
    const double offset = offset_of(a, b);
    const auto da = corners(p, a);
    const auto db = corners(p, b);
    if (largest_norm(da) + largest_norm(db) < (1 - gap_fraction_min) * (kind.distance_bounds[i] - offset)) return;
    const auto ca = corners(x, a);
    const auto cb = corners(x, b);
    const auto ua = moving_units(units, a, da);
    const auto ub = moving_units(units, b, db);
    // A single moving unit follows its path, whatever the fraction: the bound is that of CCD.
    if (kind_of_bound == BlockBound::together && !same_unit(ua, ub)) bound_by_planes(ca, cb, da, db, ua, ub, offset, gap_fraction_min, bounds);
    else bound_alone(da, db, ua, ub, [&](const auto& ea, const auto& eb) { return accd(ca, cb, ea, eb, gap_fraction_min, 1.0, offset); }, bounds);
  }
  static void lower(const std::vector<UnitBound>& found, std::vector<double>& bounds) {
    for (const UnitBound& bound : found) bounds[bound.unit] = std::min(bounds[bound.unit], bound.step);
  }
  // Has the candidates cover the path from x to x + t p.
  void cover(const VecX& x, const VecX& p, std::span<const int> moved, double t) {
    bool covered = contact_->covers(x, moved);
    for (size_t i = 0; covered && i < moved.size(); ++i) covered = contact_->covers_displaced(moved[i], vertex(x, moved[i]) + t * vertex(p, moved[i]));
    if (!covered) contact_->cover(x, t * p);
  }

  double search(const VecX& x, const VecX& p, double t_max) {
    contact_->cover(x, t_max * p);
    const PhaseScope scope(*clock_, Phase::ccd);
    double t = t_max;
    // Bound of the relative displacement of two vertices.
    const double most = 2 * largest_motion(p) * motion_factor;
    const VecX& reference = contact_->candidates().reference;
    const DisplacementBounds displacements(contact_->surface().mesh, [&](int v) {
      return (vertex(x, v) - vertex(reference, v)).norm() + motion_factor * t * vertex(p, v).norm();
    });
    for_each_kind([&](const auto& kind) {
      t = min_chunks(static_cast<int>(kind.pairs.size()), t, [&, limit = t](int first, int last) {
        double least = limit;
        if (out_of_time()) return 0.0;
        for (int i = first; i < last; ++i) {
          if (least * most < kind.distance_bounds[i] - largest_offset_) continue;
          if (kind.distance_change(displacements, kind.pairs[i]) < kind.reference_distances[i] - largest_offset_) continue;
          const auto& a = kind.first(kind.pairs[i]);
          const auto& b = kind.second(kind.pairs[i]);
          least = bounded(a, b, kind.distance_bounds[i], kind.reference_distances[i], offset_of(a, b), {reference, x, p}, least);
        }
        return least;
      });
    });
    return t;
  }

  // Returns the largest step up to t_max of the pairs that the moved vertices touch.
  double local_search(const VecX& x, const VecX& p, std::span<const int> moved, double t_max) {
    cover(x, p, moved, t_max);
    const PhaseScope scope(*clock_, Phase::ccd);
    map_candidates();
    double t = t_max;
    size_t map = 0;
    for_each_kind([&](const auto& kind) {
      for (const int i : by_vertex_[map++].touching(moved)) {
        const auto& a = kind.first(kind.pairs[i]);
        const auto& b = kind.second(kind.pairs[i]);
        t = bounded(a, b, kind.distance_bounds[i], kind.reference_distances[i], offset_of(a, b), {contact_->candidates().reference, x, p}, t);
      }
    });
    return t;
  }

  // Makes the maps from vertices to candidates of each kind, unless they are for these candidates.
  void map_candidates() {
    if (mapped_version_ == contact_->candidates_version() && !by_vertex_.empty()) return;
    mapped_version_ = contact_->candidates_version();
    by_vertex_.clear();
    const int vertices = static_cast<int>(contact_->surface().mesh.vertex_object.size());
    for_each_kind([&](const auto& kind) {
      by_vertex_.emplace_back(vertices, [&](const auto& act) {
        for (size_t i = 0; i < kind.pairs.size(); ++i) {
          const auto& a = kind.first(kind.pairs[i]);
          const auto& b = kind.second(kind.pairs[i]);
          for (const int v : a) act(static_cast<int>(i), v);
          for (const int v : b) act(static_cast<int>(i), v);
        }
      });
    });
  }

  // Calls visit for each kind of candidates.
  template <class Visit>
  void for_each_kind(const Visit& visit) const {
    tack::for_each_kind(contact_->surface().mesh, contact_->candidates(), visit);
  }

  // Returns how much of the distance between two primitives their contact offsets fill [m].
  template <size_t A, size_t B>
  double offset_of(const std::array<int, A>& a, const std::array<int, B>& b) const {
    return largest_offset_ == 0 ? 0 : offset_between(contact_->surface(), contact_->pairs(), a, b);
  }

  bool out_of_time() const { return deadline_ && deadline_->passed(); }

  ContactSystem* contact_ = nullptr;
  PhaseClock* clock_ = nullptr;
  const Deadline* deadline_ = nullptr;
  double largest_offset_ = 0;  // m
  std::vector<VertexItems> by_vertex_;  // candidates of each kind, made for the first local step
  long mapped_version_ = 0;             // of the candidates that they are for
};

TACK_REGISTER(StepFilter, Ccd, "ccd", "No collision along the step (continuous collision detection).",
              "Li et al. 2021, Codimensional Incremental Potential Contact (additive CCD)");

}  // namespace
}  // namespace tack
