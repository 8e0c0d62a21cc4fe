#include "geometry/shapes/kuhn.hpp"

#include <utility>

#include "geometry/shapes/checks.hpp"

namespace tack {
namespace {

// Orders of the axes, even permutations first: the parity is the sign of the tet.
constexpr std::array<std::array<int, 3>, 6> walks = {
    {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};

using Index3 = std::array<int, 3>;

void check(const char* shape, const Index3& cells, const std::array<bool, 3>& mirrored) {
  double vertices = 1;
  for (int axis = 0; axis < 3; ++axis) {
    require_at_least(shape, "the number of cells", cells[axis], 1);
    if (mirrored[axis]) require_even(shape, "the number of cells", cells[axis]);
    vertices *= cells[axis] + 1.0;
  }
  require_count(shape, vertices);
}

void add_cell(Mesh& mesh, const Index3& nodes, const Index3& start, const Index3& step) {
  const auto number = [&](const Index3& p) { return p[0] + nodes[0] * (p[1] + nodes[1] * p[2]); };
  const bool reflected = step[0] * step[1] * step[2] < 0;
  for (std::size_t w = 0; w < walks.size(); ++w) {
    Index3 at = start;
    Tet tet{number(at)};
    for (int corner = 0; corner < 3; ++corner) {
      const int axis = walks[w][corner];
      at[axis] += step[axis];
      tet[corner + 1] = number(at);
    }
    if ((w >= 3) != reflected) std::swap(tet[1], tet[2]);
    mesh.tets.push_back(tet);
  }
}

}  // namespace

Mesh kuhn_cube(const char* shape, const Index3& cells, const std::array<bool, 3>& mirrored) {
  check(shape, cells, mirrored);
  const Index3 nodes = {cells[0] + 1, cells[1] + 1, cells[2] + 1};
  Mesh mesh;
  for (int k = 0; k < nodes[2]; ++k) {
    for (int j = 0; j < nodes[1]; ++j) {
      for (int i = 0; i < nodes[0]; ++i) {
        mesh.vertices.emplace_back(-1 + 2.0 * i / cells[0], -1 + 2.0 * j / cells[1],
                                   -1 + 2.0 * k / cells[2]);
      }
    }
  }
  for (int k = 0; k < cells[2]; ++k) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) {
        Index3 start = {i, j, k}, step = {1, 1, 1};
        for (int axis = 0; axis < 3; ++axis) {
          if (!mirrored[axis] || 2 * start[axis] >= cells[axis]) continue;
          ++start[axis];
          step[axis] = -1;
        }
        add_cell(mesh, nodes, start, step);
      }
    }
  }
  return mesh;
}

}  // namespace tack
