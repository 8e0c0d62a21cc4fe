// One-rings of a triangulated surface, constant through the run: the neighbours and the triangles
// of each vertex, and the vertices opposite each edge. Contact models with feasible cones (gcp/,
// ogc/) read the directions of a surface at a vertex or an edge from them.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/stencils/contact_set.hpp"

namespace tack {

// A triangle at an edge.
struct OppositeVertex {
  int vertex;  // global; the corner of the triangle that is not on the edge
  // The outward normal of the triangle is orientation (e1 - e0) x (vertex - e0).
  int orientation;  // 1 or -1
};

class SurfaceRings {
 public:
  explicit SurfaceRings(const ContactSurface& surface);

  // Vertices that share an edge with a global vertex, ascending.
  std::span<const int> neighbours(int vertex_index) const { return neighbours_.of(vertex_index); }
  // The two other corners of each triangle at a global vertex, in the triangle's orientation.
  std::span<const Edge> fan(int vertex_index) const { return fans_.of(vertex_index); }
  // The triangles at an edge of the mesh.
  std::span<const OppositeVertex> opposite(int edge) const { return opposite_.of(edge); }
  // Edges of a triangle: edge i joins its corner i to the next one.
  const std::array<int, 3>& edges_of(int triangle) const { return edges_of_[triangle]; }
  // Returns whether a triangle at the vertex belongs to a sheet, which has two sides.
  bool two_sided(int vertex_index) const { return two_sided_[vertex_index] != 0; }
  // A third of the area at rest of the triangles at a vertex, or at an edge [m^2].
  double vertex_area(int vertex_index) const { return vertex_area_[vertex_index]; }
  double edge_area(int edge) const { return edge_area_[edge]; }
  // Largest number of neighbours of any vertex.
  int valence_max() const { return valence_max_; }

 private:
  // Lists of items, one list per key.
  template <class Item>
  struct Lists {
    std::vector<int> begin;  // per key, and the end
    std::vector<Item> items;
    std::span<const Item> of(int key) const {
      return {items.data() + begin[key], items.data() + begin[key + 1]};
    }
    void fill(std::vector<std::pair<int, Item>> pairs, int keys);
  };

  Lists<int> neighbours_;
  Lists<Edge> fans_;
  Lists<OppositeVertex> opposite_;
  std::vector<std::array<int, 3>> edges_of_;     // per triangle
  std::vector<char> two_sided_;                  // per global vertex
  std::vector<double> vertex_area_, edge_area_;  // m^2
  int valence_max_ = 0;
};

}  // namespace tack
