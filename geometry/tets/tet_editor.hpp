// Tets under local changes, with the tets around each vertex and the quality of each tet. The tets
// of a cavity may be replaced by others that fill it; surface vertices and triangles stay.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

class TetEditor {
 public:
  // tets: positive, fill a volume; at most two share a face.
  TetEditor(std::vector<Vec3> positions, std::vector<Tet> tets);

  // Number of tets, removed ones included.
  int count() const { return static_cast<int>(tets_.size()); }
  bool alive(int tet) const { return alive_[tet] != 0; }
  const Tet& tet(int t) const { return tets_[t]; }
  double quality(int tet) const { return quality_[tet]; }  // mean ratio
  // Positions of vertices, removed ones included [m].
  const std::vector<Vec3>& positions() const { return positions_; }
  const Vec3& position(int vertex) const { return positions_[vertex]; }
  bool on_surface(int vertex) const { return on_surface_[vertex] != 0; }
  // Returns the tets around a vertex.
  const std::vector<int>& around(int vertex) const { return around_[vertex]; }

  double quality_of(const Tet& tet) const;
  double worst_of(const std::vector<int>& tets) const;
  double worst_of(const std::vector<Tet>& tets) const;

  // Returns the tets that have both vertices.
  std::vector<int> around_edge(int a, int b) const;
  // Returns the vertices opposite the edge in the tets around it, in cyclic order: consecutive
  // vertices c, d make a positive tet (a, b, c, d). Empty if the edge is on the surface.
  std::vector<int> ring(int a, int b, const std::vector<int>& around) const;
  // Returns the tet on the other side of the face opposite `corner`; -1: there is none.
  int across(int tet, int corner) const;

  void replace(const std::vector<int>& tets, const std::vector<Tet>& by);
  int add_vertex(const Vec3& position);
  void move(int vertex, const Vec3& position);

  int changes() const { return changes_; }  // number of changes so far
  // Returns the number of the last change of a tet around any corner of a tet.
  int last_change_near(int tet) const;

 private:
  void record_change(const Tet& tet);

  std::vector<Vec3> positions_;
  std::vector<Tet> tets_;
  std::vector<char> alive_, on_surface_;
  std::vector<double> quality_;
  std::vector<std::vector<int>> around_;
  int changes_ = 0;
  std::vector<int> changed_;  // per vertex: the last change around it
};

// Returns the corners of a positive tet in another positive order that begins with a, b.
Tet reordered(const Tet& tet, int a, int b);

}  // namespace tack
