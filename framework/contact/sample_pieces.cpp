#include "framework/contact/sample_pieces.hpp"

#include "geometry/parallel.hpp"

namespace tack {

SamplePieces make_sample_pieces(const std::vector<ContactSample>& samples, const CollisionMesh& mesh,
                                const HeldSurface& held, const NearTriangles& near) {
  const int n = static_cast<int>(samples.size());
  std::vector<std::vector<int>> kept(n);
  for_each(n, [&](int i) {
    const ContactSample& s = samples[i];
    const Triangle& own = mesh.triangles[s.triangle];
    FacingViewer viewer(mesh, held);
    const Viewpoint from = viewer.inner_view(s.triangle, point_inside(held.x(), own, s.inside), s.area);
    FacingView view;
    view.count = 1;
    view.pieces[0] = {s.normal, s.area, 0, 0, 0, -1};
    near(own, &s.inside, kept[i]);
    std::erase_if(kept[i], [&](int t) {
      return mesh.vertex_object[mesh.triangles[t][0]] != s.object || viewer.piece_of(from, view, t) < 0;
    });
  }, 16);
  SamplePieces pieces;
  pieces.begin.push_back(0);
  for (const auto& list : kept) {
    pieces.triangles.insert(pieces.triangles.end(), list.begin(), list.end());
    pieces.begin.push_back(static_cast<int>(pieces.triangles.size()));
  }
  return pieces;
}

}  // namespace tack
