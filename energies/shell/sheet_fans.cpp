#include "energies/shell/sheet_fans.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "geometry/errors.hpp"

namespace tack {
namespace {

struct HalfEdge {
  Edge key;
  int triangle, edge;
};

// A triangle at a vertex: it lies between two others, from the one to the next.
struct Corner {
  int triangle, from, to;
};

int place_of(const SheetTriangle& t, int vertex) {
  return static_cast<int>(std::find(t.vertices.begin(), t.vertices.end(), vertex) - t.vertices.begin());
}

// Across the edge to `to`; the triangle is -1 at a border.
Corner next(const std::vector<SheetTriangle>& sheet, int middle, const Corner& c) {
  const SheetTriangle& t = sheet[static_cast<size_t>(c.triangle)];
  const int n = t.neighbour[place_of(t, c.from)];
  if (n < 0) return {-1, c.to, -1};
  const auto& v = sheet[static_cast<size_t>(n)].vertices;
  return {n, c.to, v[0] + v[1] + v[2] - middle - c.to};
}

void add_fan(bool closed, int middle, const std::vector<Corner>& corners, int first, int edge_count, std::vector<DihedralFan>& out) {
  DihedralFan fan{{closed, edge_count}, {middle}, {}};
  const int n = static_cast<int>(corners.size());
  for (int j = 0; j < fan.shape.triangles(); ++j) {
    const Corner& c = corners[static_cast<size_t>((first + j) % n)];
    fan.vertices.push_back(c.from);
    fan.triangles.push_back(c.triangle);
    if (!closed && j == edge_count) fan.vertices.push_back(c.to);
  }
  out.push_back(std::move(fan));
}

}  // namespace

std::vector<SheetTriangle> connect_sheet(const std::vector<Triangle>& sheet, const std::string& who) {
  std::vector<HalfEdge> edges;
  std::vector<SheetTriangle> out;
  for (size_t t = 0; t < sheet.size(); ++t) {
    out.push_back({sheet[t], {-1, -1, -1}});
    for (int i = 0; i < 3; ++i) {
      const int a = sheet[t][(i + 1) % 3], b = sheet[t][(i + 2) % 3];
      edges.push_back({{std::min(a, b), std::max(a, b)}, static_cast<int>(t), i});
    }
  }
  std::sort(edges.begin(), edges.end(), [](const HalfEdge& a, const HalfEdge& b) {
    return std::tie(a.key, a.triangle, a.edge) < std::tie(b.key, b.triangle, b.edge);
  });
  for (size_t first = 0, last = 0; first < edges.size(); first = last) {
    while (last < edges.size() && edges[last].key == edges[first].key) ++last;
    if (last - first > 2)
      throw InputError(fmt::format("{}{} triangles of its sheet share an edge (triangles {}, {} and {} among them), and a hinge joins "
                                   "two; divide the sheet, or select a part of it", who, last - first, edges[first].triangle,
                                   edges[first + 1].triangle, edges[first + 2].triangle));
    if (last - first < 2) continue;
    out[static_cast<size_t>(edges[first].triangle)].neighbour[edges[first].edge] = edges[first + 1].triangle;
    out[static_cast<size_t>(edges[first + 1].triangle)].neighbour[edges[first + 1].edge] = edges[first].triangle;
  }
  return out;
}

std::vector<DihedralFan> dihedral_fans(const std::vector<SheetTriangle>& sheet, int most) {
  std::vector<DihedralFan> out;
  std::vector<char> seen(3 * sheet.size(), 0);
  std::vector<Corner> corners;
  for (size_t t = 0; t < sheet.size(); ++t) {
    for (int i = 0; i < 3; ++i) {
      if (seen[3 * t + static_cast<size_t>(i)]) continue;
      const auto& v = sheet[t].vertices;
      const int middle = v[i];
      // Back to a border, or once around; then forth.
      const Corner begin{static_cast<int>(t), v[(i + 1) % 3], v[(i + 2) % 3]};
      Corner first = begin;
      bool closed = false;
      while (!closed) {
        const Corner before = next(sheet, middle, {first.triangle, first.to, first.from});
        if (before.triangle < 0) break;
        first = {before.triangle, before.to, before.from};
        closed = first.triangle == begin.triangle;
      }
      if (closed) first = begin;
      corners.clear();
      for (Corner c = first; c.triangle >= 0 && (corners.empty() || c.triangle != first.triangle); c = next(sheet, middle, c)) {
        corners.push_back(c);
        seen[3 * static_cast<size_t>(c.triangle) + static_cast<size_t>(place_of(sheet[static_cast<size_t>(c.triangle)], middle))] = 1;
      }
      const int n = static_cast<int>(corners.size()), edge_count = closed ? n : n - 1;
      if (edge_count == 0) continue;
      if (closed && edge_count <= most) {
        add_fan(true, middle, corners, 0, edge_count, out);
        continue;
      }
      const int parts = (edge_count + most - 3) / (most - 2);
      for (int p = 0; p < parts; ++p)
        add_fan(false, middle, corners, edge_count * p / parts, edge_count * (p + 1) / parts - edge_count * p / parts, out);
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const DihedralFan& a, const DihedralFan& b) {
    return std::tuple(a.shape.closed, a.shape.edge_count, a.vertices[0]) < std::tuple(b.shape.closed, b.shape.edge_count, b.vertices[0]);
  });
  return out;
}

}  // namespace tack
