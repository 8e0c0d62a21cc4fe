// Single changes of tets, each of which is made if the worst tet of those that result is better
// than the worst of those that it replaces. The surface stays. Each function returns whether it
// made the change. Source: Klingner and Shewchuk 2007, Aggressive Tetrahedral Mesh Improvement; the
// best filling of a ring is Klincsek's, 1980.
#pragma once

#include "geometry/tets/tet_editor.hpp"

namespace tack {

// The tets around an edge for others without it.
bool remove_edge(TetEditor& mesh, int a, int b);
// Two tets that share a face for three around the edge that joins their tips.
bool remove_face(TetEditor& mesh, int tet, int corner);
// A vertex inside onto a neighbour.
bool collapse(TetEditor& mesh, int vertex, int onto);
// A vertex inside to where the worst tet around it is better.
bool smooth(TetEditor& mesh, int vertex);
// A new vertex in an edge, which is then smoothed.
bool split_edge(TetEditor& mesh, int a, int b);
// A new vertex in a tet, instead of it and those neighbours that are then replaced as well.
bool insert(TetEditor& mesh, int tet);

}  // namespace tack
