#include "framework/contact/clipped/clipped_adhesion_term.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/assembly/stencil_blocks.hpp"
#include "framework/contact/clipped/clip_pack.hpp"
#include "framework/contact/clipped/close_triangles.hpp"
#include "framework/contact/laws/law_debonding.hpp"
#include "framework/core/concurrent_maximum.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Step of the differences of the exact Hessian, per length of the first edge of b: the error is least
// between 3e-6 and 3e-5 (docs/decisions/78-clipped-integral.md).
constexpr double difference_step = 1e-5;
// Pairs of a chunk: one pair takes 0.05 to 0.4 microseconds.
constexpr int pairs_per_chunk = 128;
static_assert(pairs_per_chunk % pack_width == 0);

double lane_sum(const Pack& pack, int lanes, unsigned wanted) {
  double sum = 0;
  for (int l = 0; l < lanes; ++l)
    if (wanted >> l & 1u) sum += pack[l];
  return sum;
}

Vec3 area_vector(const std::array<Vec3, 3>& x) { return 0.5 * (x[1] - x[0]).cross(x[2] - x[0]); }

}  // namespace

// A pair whose two-sided triangles face each other. Corners 1 and 2 are swapped if they do not in the
// order of the close pair.
struct ClippedAdhesionTerm::Oriented : ClippedPair {
  bool swapped_a = false, swapped_b = false;

  bool swapped() const { return swapped_a || swapped_b; }
  void swap_back(Vec18& gradient) const {
    if (swapped_a) gradient.segment<3>(3).swap(gradient.segment<3>(6));
    if (swapped_b) gradient.segment<3>(12).swap(gradient.segment<3>(15));
  }
  void swap_back(Mat18& hessian) const {
    for (const int first : {swapped_a ? 3 : -1, swapped_b ? 12 : -1}) {
      if (first < 0) continue;
      hessian.middleRows<3>(first).swap(hessian.middleRows<3>(first + 3));
      hessian.middleCols<3>(first).swap(hessian.middleCols<3>(first + 3));
    }
  }
};

ClippedAdhesionTerm::ClippedAdhesionTerm(const ContactSystem& system, ClippedLaws laws)
    : Term("clipped_adhesion"), system_(system), laws_(std::move(laws)), topology_(system.surface()), edges_(system.surface(), topology_),
      finder_(system_, laws_, edges_) {
  margin_ = std::numeric_limits<double>::infinity();
  for (const ClippedLaw& law : laws_.laws()) margin_ = std::min(margin_, ClippedLaws::margin_per_range * law.range);
}

void ClippedAdhesionTerm::find_pairs() {
  const CollisionMesh& mesh = system_.surface().mesh;
  const std::vector<TrianglePair> found = finder_.find();
  pairs_.resize(found.size());
  for_each(static_cast<int>(found.size()), [&](int i) { pairs_[i] = with_edges(found[i]); });
  std::stable_sort(pairs_.begin(), pairs_.end(), [](const ClosePair& p, const ClosePair& q) { return p.kind() < q.kind(); });
  std::vector<char> in_pair(mesh.vertex_object.size(), 0);
  for (const ClosePair& pair : pairs_)
    for (const int v : pair.vertices) in_pair[v] = 1;
  pair_vertices_.clear();
  for (const int v : mesh.vertices)
    if (in_pair[v]) pair_vertices_.push_back(v);
}

ClippedAdhesionTerm::ClosePair ClippedAdhesionTerm::with_edges(const TrianglePair& pair) const {
  const std::vector<Triangle>& triangles = system_.surface().mesh.triangles;
  const Triangle &ta = triangles[pair.a], &tb = triangles[pair.b];
  ClosePair close{pair, {ta[0], ta[1], ta[2], tb[0], tb[1], tb[2]}, topology_.two_sided(pair.a) || topology_.two_sided(pair.b), topology_.two_sided(pair.b)};
  const double strip = laws_.laws()[pair.law].strip;
  for (int k = 0; k < 3; ++k) {
    close.boundary_a[k] = !edges_.smooth(pair.a, k) || (pair.interfaces_a >> k & 1) != 0;
    close.owns_b[k] = tb[k] < tb[(k + 1) % 3];
    if (!edges_.smooth(pair.b, k) || (pair.interfaces_b >> k & 1) != 0) close.strip_b[k] = edges_.width(pair.b, k, strip);
  }
  return close;
}

// Orders the corners of two-sided triangles so that they face each other at x.
void ClippedAdhesionTerm::orient(const VecX& x, ClosePair& close) const {
  const Oriented oriented = geometry(x, close);
  if (oriented.swapped_a) std::swap(close.vertices[1], close.vertices[2]);
  if (oriented.swapped_b) std::swap(close.vertices[4], close.vertices[5]);
  close.boundary_a = oriented.boundary_a;
  close.owns_b = oriented.owns_b;
  close.strip_b = oriented.strip_b;
}

void ClippedAdhesionTerm::find_close_pairs(const VecX& x) {
  if (version_ != system_.candidates_version()) {
    find_pairs();
    version_ = system_.candidates_version();
  }
  close_at_ = x;
  test_pairs({});
  list_close_pairs(x);
}

// Tests the pairs with a vertex that has moved (non-zero), or all if `moved` is empty. Returns whether
// any result is another one than before.
bool ClippedAdhesionTerm::test_pairs(const std::vector<char>& moved) {
  const int all = static_cast<int>(pairs_.size());
  std::vector<char> changed(chunk_count(all), 0);
  for_each_chunk(all, [&](int chunk, int first, int last) {
    CloseTriangles test(margin_);
    std::array<int, pack_width> tested;
    int lanes = 0;
    const auto finish = [&] {
      const CloseTriangles::Lanes result = test.test();
      for (int l = 0; l < lanes; ++l) {
        ClosePair& pair = pairs_[tested[l]];
        const bool close = (result.close >> l & 1u) != 0;
        if (close != pair.close) changed[chunk] = 1;
        pair.close = close;
        pair.inside = (result.inside >> l & 1u) != 0;
      }
      lanes = 0;
    };
    for (int i = first; i < last; ++i) {
      const ClosePair& pair = pairs_[i];
      if (!moved.empty() && std::none_of(pair.vertices.begin(), pair.vertices.end(), [&](int v) { return moved[v] != 0; })) continue;
      test.set(lanes, close_at_, pair.vertices, laws_.laws()[pair.pair.law].range, pair.two_sided);
      tested[lanes++] = i;
      if (lanes == pack_width) finish();
    }
    if (lanes > 0) finish();
  });
  return std::find(changed.begin(), changed.end(), 1) != changed.end();
}

// Lists the close pairs in an order for packs, which have one law, and are faster without strips, and
// where a lies inside b in every lane. An equal list keeps the value and the gradients.
void ClippedAdhesionTerm::list_close_pairs(const VecX& x) {
  std::vector<ClosePair> close;
  close.reserve(close_.size());
  for (const ClosePair& pair : pairs_)
    if (pair.close) close.push_back(pair);
  for_each(static_cast<int>(close.size()), [&](int i) {
    if (close[i].two_sided) orient(x, close[i]);
  });
  const auto by_kind = [](const ClosePair& p, const ClosePair& q) { return std::pair(p.kind(), !p.inside) < std::pair(q.kind(), !q.inside); };
  if (!std::is_sorted(close.begin(), close.end(), by_kind)) std::stable_sort(close.begin(), close.end(), by_kind);
  if (close == close_) return;
  close_ = std::move(close);
  gradients_at_.resize(0);
  value_at_.resize(0);
  if (static_cast<int>(integrators_.size()) < chunk_count(pair_count(), pairs_per_chunk)) integrators_.resize(chunk_count(pair_count(), pairs_per_chunk));
}

void ClippedAdhesionTerm::begin_step(const StepStart& start) { find_close_pairs(start.x); }

// Vertices outside of the pairs do not count: the broad phase finds new candidates before they come
// within range.
void ClippedAdhesionTerm::move_to(const VecX& x) {
  if (close_at_.size() != x.size() || version_ != system_.candidates_version()) return find_close_pairs(x);
  const int all = static_cast<int>(pair_vertices_.size());
  std::vector<char> left(chunk_count(all), 0), moved(x.size() / 3, 0);
  for_each_chunk(all, [&](int chunk, int first, int last) {
    for (int i = first; i < last; ++i) {
      const int v = pair_vertices_[i];
      if ((vertex(x, v) - vertex(close_at_, v)).squaredNorm() <= margin_ * margin_) continue;
      moved[v] = left[chunk] = 1;
      vertex(close_at_, v) = vertex(x, v);
    }
  });
  if (std::find(left.begin(), left.end(), 1) != left.end() && test_pairs(moved)) list_close_pairs(x);
}

void ClippedAdhesionTerm::clear_caches() {
  version_ = -1;
  pairs_.clear();
  pair_vertices_.clear();
  close_.clear();
  close_at_.resize(0);
  gradients_at_.resize(0);
  value_at_.resize(0);
}

// Swaps the corners of two-sided triangles so that they face each other.
ClippedAdhesionTerm::Oriented ClippedAdhesionTerm::geometry(const VecX& x, const ClosePair& close) const {
  Oriented pair;
  for (int k = 0; k < 3; ++k) {
    pair.a[k] = vertex(x, close.vertices[k]);
    pair.b[k] = vertex(x, close.vertices[3 + k]);
  }
  pair.boundary_a = close.boundary_a;
  pair.owns_b = close.owns_b;
  pair.strip_b = close.strip_b;
  if (!close.two_sided) return pair;
  const Vec3 normal_b = area_vector(pair.b);
  pair.swapped_b = topology_.two_sided(close.pair.b) && normal_b.dot(pair.a[0] + pair.a[1] + pair.a[2] - pair.b[0] - pair.b[1] - pair.b[2]) < 0;
  pair.swapped_a = topology_.two_sided(close.pair.a) && (area_vector(pair.a).dot(normal_b) > 0) != pair.swapped_b;
  // Edges 0, 1, 2 turn into 2, 1, 0, and run the other way.
  if (pair.swapped_a) {
    std::swap(pair.a[1], pair.a[2]);
    std::swap(pair.boundary_a[0], pair.boundary_a[2]);
  }
  if (pair.swapped_b) {
    std::swap(pair.b[1], pair.b[2]);
    std::swap(pair.strip_b[0], pair.strip_b[2]);
    pair.owns_b = {!close.owns_b[2], !close.owns_b[1], !close.owns_b[0]};
  }
  return pair;
}

// Calls packed(first index, lanes, pack, law, bit per lane) for the pairs whose integral a pack finds,
// then single(index, pair, law) for others, pack after pack. The pairs of a pack have one law.
template <class Packed, class Single>
void ClippedAdhesionTerm::for_each_close(const VecX& x, int first, int last, const Packed& packed, const Single& single) const {
  ClipPack pack;
  for (int at = first, lanes; at < last; at += lanes) {
    const ClippedLaw& law = laws_.laws()[close_[at].pair.law];
    lanes = 1;
    while (lanes < pack_width && at + lanes < last && close_[at + lanes].pair.law == close_[at].pair.law) ++lanes;
    for (int l = 0; l < pack_width; ++l) {
      const ClosePair& close = close_[at + std::min(l, lanes - 1)];
      pack.set(l, x, close.vertices, close.strip_b, close.boundary_a, close.owns_b, close.two_sided_b);
    }
    const unsigned found = pack.clip(law.bands) & ((1u << lanes) - 1);
    if (found != 0) packed(at, lanes, pack, law, found);
    for (int l = 0; l < lanes; ++l)
      if ((found >> l & 1u) == 0) single(at + l, geometry(x, close_[at + l]), law);
  }
}

// Minimisers and records ask for the value at one configuration several times.
double ClippedAdhesionTerm::value(const VecX& x) const {
  if (value_at_.size() == x.size() && value_at_ == x) return value_;
  std::vector<double> partial(chunk_count(pair_count(), pairs_per_chunk), 0.0);
  for_each_chunk(pair_count(), [&](int chunk, int first, int last) {
    for_each_close(x, first, last, [&](int, int lanes, const ClipPack& pack, const ClippedLaw& law, unsigned found) {
      std::array<double, 2 * pack_width> values;
      law.law.values(2 * pack_width, pack.gaps(), values.data());
      partial[chunk] += lane_sum(pack.energy(values.data()), lanes, found);
    }, [&](int, const Oriented& pair, const ClippedLaw& law) {
      partial[chunk] += integrators_[chunk].value(pair, law.law, law.bands).energy;
    });
  }, pairs_per_chunk);
  value_ = 0;
  for (const double s : partial) value_ += s;
  value_at_ = x;
  return value_;
}

std::vector<StencilBatch> ClippedAdhesionTerm::batches() const {
  batch_vertices_.clear();
  for (const ClosePair& close : close_) batch_vertices_.insert(batch_vertices_.end(), close.vertices.begin(), close.vertices.end());
  return {{6, pair_count(), batch_vertices_.data()}};
}

// Writes the Hessian of a pair as a difference of the gradient.
void ClippedAdhesionTerm::exact_hessian(const ClippedPair& pair, const ClippedLaw& law, ClipIntegrator& integrator, Mat18& h) {
  const double step = difference_step * (pair.b[1] - pair.b[0]).norm();
  h.setZero();
  Vec18 g;
  for (int k = 0; k < 18; ++k) {
    ClippedPair moved = pair;
    double& coordinate = (k < 9 ? moved.a[k / 3] : moved.b[k / 3 - 3])[k % 3];
    const double at = coordinate;
    for (const auto& [steps, weight] : {std::pair{-2, 1.0}, {-1, -8.0}, {1, 8.0}, {2, -1.0}}) {
      coordinate = at + steps * step;
      integrator.derivatives(moved, law.law, law.bands, g, nullptr);
      h.col(k) += weight / (12 * step) * g;
    }
  }
  h = (0.5 * (h + h.transpose())).eval();
}

void ClippedAdhesionTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  constexpr int slots = ClipPack::hessian_slots;
  const bool exact = hessian && projection == Projection::none;
  for_each_chunk(pair_count(), [&](int chunk, int first, int last) {
    ClipIntegrator& integrator = integrators_[chunk];
    const auto packed = [&](int at, int lanes, const ClipPack& pack, const ClippedLaw& law, unsigned) {
      std::array<LawSample, 2 * pack_width> samples;
      law.law.samples(2 * pack_width, pack.gaps(), samples.data());
      std::array<Pack, 18> g;
      std::array<Pack, slots> h;
      pack.derivatives(samples.data(), g.data(), hessian ? h.data() : nullptr);
      store_lanes(g.data(), 18, gradient + 18 * static_cast<size_t>(at), lanes);
      if (hessian) store_lanes(h.data(), slots, hessian + slots * static_cast<size_t>(at), lanes);
    };
    const auto single = [&](int i, const Oriented& pair, const ClippedLaw& law) {
      Vec18 g;
      Mat18 h;
      integrator.derivatives(pair, law.law, law.bands, g, hessian && !exact ? &h : nullptr);
      pair.swap_back(g);
      Eigen::Map<Vec18>{gradient + 18 * static_cast<size_t>(i)} = g;
      if (!hessian) return;
      if (exact) exact_hessian(pair, law, integrator, h);
      pair.swap_back(h);
      store_blocks<6>(h, hessian + slots * static_cast<size_t>(i));
    };
    if (!exact) return for_each_close(x, first, last, packed, single);
    for (int i = first; i < last; ++i) single(i, geometry(x, close_[i]), laws_.laws()[close_[i].pair.law]);
  }, pairs_per_chunk);
  if (hessian || !keeps_gradients_) return;
  gradients_.resize(close_.size());
  for_each(pair_count(), [&](int i) { gradients_[i] = Eigen::Map<const Vec18>(gradient + 18 * static_cast<size_t>(i)); });
  gradients_at_ = x;
}

void ClippedAdhesionTerm::mark_debonding(const VecX& from, const VecX& to, std::vector<char>& marks) const {
  std::vector<AdhesionOfGap> adhesion;
  for (const ClippedLaw& law : laws_.laws()) adhesion.emplace_back(law.law);
  for_each(pair_count(), [&](int i) {
    const ClosePair& close = close_[i];
    if (close.pair.whole < 0) return;
    const ClippedLaw& law = laws_.laws()[close.pair.whole];
    const char found = debonding_marks(law.law, adhesion[close.pair.whole], mean_gap(from, close), mean_gap(to, close));
    if (found == 0 || !ClipIntegrator().overlaps(geometry(from, close), law.range)) return;
    for (const int v : close.vertices) mark(marks[v], found);
  });
}

// Returns the integrals of the close pairs.
std::vector<ClippedIntegral> ClippedAdhesionTerm::integrals(const VecX& x) const {
  std::vector<ClippedIntegral> all(close_.size());
  for_each_chunk(pair_count(), [&](int chunk, int first, int last) {
    for_each_close(x, first, last, [&](int at, int lanes, const ClipPack& pack, const ClippedLaw& law, unsigned found) {
      std::array<double, 2 * pack_width> values;
      law.law.values(2 * pack_width, pack.gaps(), values.data());
      const Pack energy = pack.energy(values.data());
      for (int l = 0; l < lanes; ++l)
        if (found >> l & 1u) all[at + l] = pack.integral(l, energy[l]);
    }, [&](int i, const Oriented& pair, const ClippedLaw& law) {
      all[i] = integrators_[chunk].value(pair, law.law, law.bands);
      if (pair.swapped_a) std::swap(all[i].area_a[1], all[i].area_a[2]);
      if (pair.swapped_b) std::swap(all[i].area[1], all[i].area[2]);
    });
  }, pairs_per_chunk);
  return all;
}


}  // namespace tack
