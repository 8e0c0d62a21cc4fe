// Topology of a sheet: neighbours across edges, and fans of hinges about vertices.
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

// Triangles j = 0 ... about a vertex, each with the vertex and ring j and j + 1; hinges are the
// edges from the vertex to the ring that two of them share. Closed, the last ends where the first
// begins, and every vertex of the ring has a hinge; else the first and the last have none.
struct FanShape {
  bool closed;
  int hinges;

  int ring() const { return closed ? hinges : hinges + 2; }
  int arity() const { return 1 + ring(); }
  int triangles() const { return closed ? hinges : hinges + 1; }
  // Return the end of hinge i and the apexes of its sides, as indices into the vertices of the fan
  // (0: the centre). The left side is the later triangle.
  int tip(int i) const { return closed ? 1 + i : 2 + i; }
  int left(int i) const { return closed ? 1 + (i + 1) % hinges : 3 + i; }
  int right(int i) const { return closed ? 1 + (i + hinges - 1) % hinges : 1 + i; }
  // Return the sides of hinge i, as indices into the triangles of the fan.
  int left_triangle(int i) const { return closed ? i : i + 1; }
  int right_triangle(int i) const { return closed ? (i + hinges - 1) % hinges : i; }

  friend bool operator==(const FanShape&, const FanShape&) = default;
};

inline constexpr int most_hinges = 8, most_ring = 8;  // of a fan

struct HingeFan {
  FanShape shape;
  std::vector<int> vertices;   // centre, then ring
  std::vector<int> triangles;  // of the sheet
};

// Every hinge is in two fans, those of its ends. Vertices with more than `most` hinges (<=
// most_hinges), or without a triangle at a side and more than two less, have several. In the order
// of the shape, then of the vertices.
std::vector<HingeFan> hinge_fans(const std::vector<SheetTriangle>& sheet, int most);

}  // namespace tack
