#include "framework/contact/sample_pieces.hpp"

#include <algorithm>
#include <numeric>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int chunk = 64;

// Of samples next to each other; those inside one triangle ask once what is near that.
class PieceFinder {
 public:
  PieceFinder(const CollisionMesh& mesh, const HeldSurface& held, const BroadPhase& broad_phase)
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
  const HeldSurface& held_;
  const BroadPhase& broad_phase_;
  FacingViewer viewer_;
  int triangle_ = -1, object_ = -1;  // of near_
  std::vector<int> near_;
};

}  // namespace

void add_sample_pieces(const std::vector<int>& numbers, const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                       const HeldSurface& held, const BroadPhase& broad_phase, SamplePieces& pieces) {
  const int n = static_cast<int>(numbers.size());
  std::vector<std::vector<int>> kept(chunk_count(n, chunk));
  std::vector<int> found(n);
  for_each_chunk(n, [&](int c, int first, int last) {
    PieceFinder finder(mesh, held, broad_phase);
    for (int i = first; i < last; ++i) found[i] = finder.find(samples[numbers[i]], kept[c]);
  }, chunk);
  std::vector<SamplePieces::Piece> all;
  all.reserve(samples.size());
  auto known = pieces.pieces.begin();
  int end = static_cast<int>(pieces.triangles.size());
  for (int i = 0; i < n; ++i) {
    const auto before = numbers[i] - static_cast<std::ptrdiff_t>(all.size());
    all.insert(all.end(), known, known + before);
    known += before;
    all.push_back({end, end + found[i]});
    end += found[i];
  }
  all.insert(all.end(), known, pieces.pieces.end());
  pieces.pieces = std::move(all);
  pieces.triangles.reserve(end);
  for (const auto& list : kept) pieces.triangles.insert(pieces.triangles.end(), list.begin(), list.end());
}

SamplePieces make_sample_pieces(const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                                const HeldSurface& held, const BroadPhase& broad_phase) {
  std::vector<int> all(samples.size());
  std::iota(all.begin(), all.end(), 0);
  SamplePieces pieces;
  add_sample_pieces(all, samples, mesh, held, broad_phase, pieces);
  return pieces;
}

}  // namespace tack
