// Single changes of tets. A change is made if the worst of the new tets is better than the worst of
// the replaced ones. The surface stays. Each function returns true if it made the change.
// Source: Klingner and Shewchuk 2007, Aggressive Tetrahedral Mesh Improvement; optimal filling of a
// ring: Klincsek 1980.
#pragma once

#include "geometry/tets/tet_editor.hpp"

namespace tack {

// Replaces the tets around an edge by others without it.
bool remove_edge(TetEditor& mesh, int a, int b);
// Replaces two tets that share a face by three around the edge between their tips.
bool remove_face(TetEditor& mesh, int tet, int corner);
// Merges an interior vertex with a neighbour.
bool collapse(TetEditor& mesh, int vertex, int onto);
// Moves an interior vertex to a position where the worst tet around it is better.
bool smooth(TetEditor& mesh, int vertex);
// Inserts a vertex in an edge, and smooths it.
bool split_edge(TetEditor& mesh, int a, int b);
// Replaces a tet, and some of its neighbours, by tets around a new vertex.
bool insert(TetEditor& mesh, int tet);

}  // namespace tack
