// Topology of a sheet: neighbours across edges, and fans of dihedral edges about vertices.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

// A triangle with its neighbours; edge i is opposite vertex i, from vertex i + 1 to i + 2.
struct SheetTriangle {
  std::array<int, 3> vertices;
  std::array<int, 3> neighbour;  // triangle index; -1: a border
};

// Throws InputError, with `who` in front, if more than two triangles share an edge.
std::vector<SheetTriangle> connect_sheet(const std::vector<Triangle>& sheet,
                                         const std::string& who);

// Shape of a fan: triangles j = 0 ... about a vertex, each with that vertex and the vertices j and
// j + 1 of the ring. Its dihedral edges are those edges from the vertex to the ring that two
// triangles share. In a closed fan every vertex of the ring has a dihedral edge; in an open fan the
// first and the last vertex have none.
struct FanShape {
  bool closed;
  int edge_count;

  int ring() const { return closed ? edge_count : edge_count + 2; }
  int arity() const { return 1 + ring(); }
  int triangles() const { return closed ? edge_count : edge_count + 1; }
  // Return the end of dihedral edge i and the apexes of its sides, as indices into the vertices of
  // the fan (0: the centre). The left side is the later triangle.
  int tip(int i) const { return closed ? 1 + i : 2 + i; }
  int left(int i) const { return closed ? 1 + (i + 1) % edge_count : 3 + i; }
  int right(int i) const { return closed ? 1 + (i + edge_count - 1) % edge_count : 1 + i; }
  // Return the sides of dihedral edge i, as indices into the triangles of the fan.
  int left_triangle(int i) const { return closed ? i : i + 1; }
  int right_triangle(int i) const { return closed ? (i + edge_count - 1) % edge_count : i; }

  friend bool operator==(const FanShape&, const FanShape&) = default;
};

inline constexpr int fan_edges_max = 8, ring_max = 8;  // of a fan

struct DihedralFan {
  FanShape shape;
  std::vector<int> vertices;   // centre, then ring
  std::vector<int> triangles;  // of the sheet
};

// Returns the fans of a sheet, ordered by shape, then by vertices. Every dihedral edge is in two
// fans, those of its ends. A vertex has several fans if it has more than `most` (<= fan_edges_max)
// dihedral edges, or lies at a border and has more than most - 2.
std::vector<DihedralFan> dihedral_fans(const std::vector<SheetTriangle>& sheet, int most);

}  // namespace tack
