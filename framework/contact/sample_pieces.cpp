#include "framework/contact/sample_pieces.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/concatenate.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int chunk = 64;

// Finder for consecutive samples; samples inside one triangle share a search.
class PieceFinder {
 public:
  PieceFinder(const CollisionMesh& mesh, const LaggedSurface& held, const BroadPhase& broad_phase)
      : mesh_(mesh), held_(held), broad_phase_(broad_phase), viewer_(mesh, held) {}

  // Appends the triangles, and says how many.
  int find(const ContactSample& s, std::vector<int>& out) {
    const Triangle& own = mesh_.triangles[s.triangle];
    if (s.triangle != triangle_ || s.object != object_) list(s.triangle, s.object);
    const size_t before = out.size();
    broad_phase_.triangles_near(own, s.inside, near_, out);
    const Viewpoint from = viewer_.inner_view(s.triangle, point_inside(held_.x(), own, s.inside), s.area);
    FacingView view;
    view.count = 1;
    view.pieces[0] = {s.normal, s.area, 0, 0, 0, -1};
    const auto begin = out.begin() + static_cast<std::ptrdiff_t>(before);
    out.erase(std::remove_if(begin, out.end(), [&](int t) { return viewer_.piece_of(from, view, t) < 0; }), out.end());
    return static_cast<int>(out.size() - before);
  }

 private:
  void list(int triangle, int object) {
    triangle_ = triangle;
    object_ = object;
    near_.clear();
    broad_phase_.others_near(mesh_.triangles[triangle], near_);
    std::erase_if(near_, [&](int t) { return mesh_.vertex_object[mesh_.triangles[t][0]] != object; });
  }

  const CollisionMesh& mesh_;
  const LaggedSurface& held_;
  const BroadPhase& broad_phase_;
  FacingViewer viewer_;
  int triangle_ = -1, object_ = -1;  // of near_
  std::vector<int> near_;
};

// Pieces of some samples: one list of triangles per chunk, and the number of triangles per sample.
struct FoundPieces {
  std::vector<std::vector<int>> triangles;
  std::vector<int> count;
};

FoundPieces find_pieces(const std::vector<int>& numbers, const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                        const LaggedSurface& held, const BroadPhase& broad_phase) {
  const int n = static_cast<int>(numbers.size());
  FoundPieces found{std::vector<std::vector<int>>(chunk_count(n, chunk)), std::vector<int>(n)};
  for_each_chunk(n, [&](int c, int first, int last) {
    PieceFinder finder(mesh, held, broad_phase);
    for (int i = first; i < last; ++i) found.count[i] = finder.find(samples[numbers[i]], found.triangles[c]);
  }, chunk);
  return found;
}

}  // namespace

void add_sample_pieces(const std::vector<int>& numbers, const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                       const LaggedSurface& held, const BroadPhase& broad_phase, SamplePieces& pieces) {
  const int n = static_cast<int>(numbers.size());
  const FoundPieces found = find_pieces(numbers, samples, mesh, held, broad_phase);
  std::vector<SamplePieces::Piece> all;
  all.reserve(samples.size());
  auto known = pieces.pieces.begin();
  int end = static_cast<int>(pieces.triangles.size());
  for (int i = 0; i < n; ++i) {
    const auto before = numbers[i] - static_cast<std::ptrdiff_t>(all.size());
    all.insert(all.end(), known, known + before);
    known += before;
    all.push_back({end, end + found.count[i]});
    end += found.count[i];
  }
  all.insert(all.end(), known, pieces.pieces.end());
  pieces.pieces = std::move(all);
  pieces.triangles.reserve(end);
  for (const auto& list : found.triangles) pieces.triangles.insert(pieces.triangles.end(), list.begin(), list.end());
}

void renew_sample_pieces(const ChangedPrimitives& changed, const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                         const LaggedSurface& held, const BroadPhase& broad_phase, SamplePieces& pieces) {
  std::vector<int> numbers;
  for (int i = 0; i < static_cast<int>(samples.size()); ++i)
    if (changed.triangles[samples[i].triangle] || changed.objects[samples[i].object]) numbers.push_back(i);
  const FoundPieces found = find_pieces(numbers, samples, mesh, held, broad_phase);
  std::vector<int> fresh;
  concatenate(found.triangles, fresh);
  SamplePieces all;
  all.triangles.reserve(pieces.triangles.size() + fresh.size());
  auto number = numbers.begin();
  auto count = found.count.begin();
  auto next = fresh.begin();
  for (int i = 0; i < static_cast<int>(samples.size()); ++i) {
    const int begin = static_cast<int>(all.triangles.size());
    if (number != numbers.end() && *number == i) {
      all.triangles.insert(all.triangles.end(), next, next + *count);
      next += *count++;
      ++number;
    } else {
      const auto& [first, last] = pieces.pieces[i];
      all.triangles.insert(all.triangles.end(), pieces.triangles.begin() + first, pieces.triangles.begin() + last);
    }
    all.pieces.push_back({begin, static_cast<int>(all.triangles.size())});
  }
  pieces = std::move(all);
}

SamplePieces make_sample_pieces(const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                                const LaggedSurface& held, const BroadPhase& broad_phase) {
  std::vector<int> all(samples.size());
  std::iota(all.begin(), all.end(), 0);
  SamplePieces pieces;
  add_sample_pieces(all, samples, mesh, held, broad_phase, pieces);
  return pieces;
}

}  // namespace tack
