// Tets that are being changed a few at a time, with who is around each vertex and how good each tet
// is. What fills a cavity may be replaced by what fills it otherwise; vertices of the surface and
// its triangles stay.
#pragma once

#include <vector>

#include "geometry/types.hpp"

namespace tack {

class TetEditor {
 public:
  // Positive tets that fill a volume, each face of at most two.
  TetEditor(std::vector<Vec3> places, std::vector<Tet> tets);

  // Number of tets, removed ones included.
  int count() const { return static_cast<int>(tets_.size()); }
  bool alive(int tet) const { return alive_[tet] != 0; }
  const Tet& tet(int t) const { return tets_[t]; }
  double quality(int tet) const { return quality_[tet]; }       // its mean ratio
  // Positions of vertices, removed ones included [m].
  const std::vector<Vec3>& places() const { return places_; }
  const Vec3& place(int vertex) const { return places_[vertex]; }
  bool on_surface(int vertex) const { return on_surface_[vertex] != 0; }
  const std::vector<int>& around(int vertex) const { return around_[vertex]; }  // its tets

  double quality_of(const Tet& tet) const;
  double worst_of(const std::vector<int>& tets) const;
  double worst_of(const std::vector<Tet>& tets) const;

  // Returns the tets that have both vertices.
  std::vector<int> around_edge(int a, int b) const;
  // Returns the vertices opposite the edge in the tets around it, in order: each two that follow
  // each other, the last and the first as well, make a positive tet (a, b, one, next). Empty if the
  // edge is one of the surface.
  std::vector<int> ring(int a, int b, const std::vector<int>& around) const;
  // The tet on the other side of the face opposite `corner`; -1: there is none.
  int across(int tet, int corner) const;

  void replace(const std::vector<int>& tets, const std::vector<Tet>& by);
  int add_vertex(const Vec3& place);
  void move(int vertex, const Vec3& place);

  int changes() const { return changes_; }  // so far
  // Which of them was the last to one of the tets around any corner of a tet.
  int last_change_near(int tet) const;

 private:
  void note_change(const Tet& tet);

  std::vector<Vec3> places_;
  std::vector<Tet> tets_;
  std::vector<char> alive_, on_surface_;
  std::vector<double> quality_;
  std::vector<std::vector<int>> around_;
  int changes_ = 0;
  std::vector<int> changed_;  // per vertex: the last change around it
};

// The corners of a positive tet in another order, also positive, with two of them first.
Tet beginning_with(const Tet& tet, int a, int b);

}  // namespace tack
