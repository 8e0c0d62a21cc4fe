#include "framework/contact/sample_pieces.hpp"

#include <algorithm>

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

SamplePieces make_sample_pieces(const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                                const HeldSurface& held, const BroadPhase& broad_phase) {
  const int n = static_cast<int>(samples.size());
  std::vector<std::vector<int>> kept(chunk_count(n, chunk));
  SamplePieces pieces;
  pieces.begin.assign(n + 1, 0);
  for_each_chunk(n, [&](int c, int first, int last) {
    PieceFinder finder(mesh, held, broad_phase);
    for (int i = first; i < last; ++i) pieces.begin[i + 1] = finder.find(samples[i], kept[c]);
  }, chunk);
  for (int i = 0; i < n; ++i) pieces.begin[i + 1] += pieces.begin[i];
  pieces.triangles.reserve(pieces.begin.back());
  for (const auto& list : kept) pieces.triangles.insert(pieces.triangles.end(), list.begin(), list.end());
  return pieces;
}

}  // namespace tack
