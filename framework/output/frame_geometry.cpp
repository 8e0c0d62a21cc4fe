#include "framework/output/frame_geometry.hpp"

#include "framework/world/world.hpp"

namespace tack {

FrameGeometry frame_geometry(const World& world) {
  FrameGeometry g;
  g.vertices = world.mesh_vertex_count();
  std::vector<int> of_tets, of_triangles, of_edges, of_points;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const int object = static_cast<int>(i);
    g.tets.insert(g.tets.end(), body.tets.begin(), body.tets.end());
    of_tets.insert(of_tets.end(), body.tets.size(), object);
    g.triangles.insert(g.triangles.end(), body.sheet.begin(), body.sheet.end());
    of_triangles.insert(of_triangles.end(), body.sheet.size(), object);
    g.edges.insert(g.edges.end(), body.edges.begin(), body.edges.end());
    of_edges.insert(of_edges.end(), body.edges.size(), object);
    g.points.insert(g.points.end(), body.points.begin(), body.points.end());
    of_points.insert(of_points.end(), body.points.size(), object);
  }
  for (const auto* objects : {&of_tets, &of_triangles, &of_edges, &of_points})
    g.cell_object.insert(g.cell_object.end(), objects->begin(), objects->end());
  return g;
}

}  // namespace tack
