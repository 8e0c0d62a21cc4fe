// Division of tets into eight (red refinement): midpoints of edges become vertices, which cut off
// the four corners; the remaining octahedron is cut along its shortest diagonal (Bey 1995,
// Tetrahedral Grid Refinement).
#pragma once

#include <array>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Nodes of a divided tet: its corners 0 to 3, then the midpoints of these edges. The diagonal joins
// the midpoints of the first and the last edge.
inline constexpr int composite_nodes = 10, composite_parts = 8;
inline constexpr std::array<std::array<int, 2>, 6> composite_edges = {
    {{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};
// The eight small tets, by nodes: those at the corners in order, then the four around the diagonal.
inline constexpr std::array<std::array<int, 4>, composite_parts> composite_tets = {{{0, 4, 5, 6},
                                                                                    {4, 1, 7, 8},
                                                                                    {5, 7, 2, 9},
                                                                                    {6, 8, 9, 3},
                                                                                    {4, 9, 5, 6},
                                                                                    {4, 9, 6, 8},
                                                                                    {4, 9, 8, 7},
                                                                                    {4, 9, 7, 5}}};

using CompositeTet = std::array<int, composite_nodes>;

// Divides every tet, triangle and edge at the midpoints of its edges. Tets 8 t to 8 t + 7 are those
// of tet t; the old vertices come first. A midpoint belongs to the groups of both ends.
Mesh divide_tets(const Mesh& mesh);

// Returns the nodes of composite tets, each of eight small tets in the order of divide_tets.
std::vector<CompositeTet> composite_tets_of(const std::vector<Tet>& parts);

}  // namespace tack
