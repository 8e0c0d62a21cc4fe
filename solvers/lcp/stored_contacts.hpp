// History of contacts from step to step: the side of the surface, the gap of the constraint and the
// force. Entries are keyed by (point, object), with several entries where a point is near several
// features of the object, and by pairs of edges.
#pragma once

#include <vector>

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/core/history.hpp"

namespace tack {

struct StoredPoint {
  int point, object;
  int triangle;  // of the mesh: the nearest one
  double side;   // 1: in front of the triangle; -1: behind it; 0: none (beside a boundary)
  double gap;    // gap of the constraint [m]: the margin, or less for a contact that started closer
  double depth;  // depth behind the side it belongs to; 0 in front [m]
  Vec3 force;    // on the point [N]
};

struct StoredEdges {
  int a, b;     // edges of the mesh, ascending
  Vec3 normal;  // from b to a, before any crossing
  double gap, depth;
  Vec3 force;  // on a [N]
};

struct StoredContacts {
  std::vector<StoredPoint> points;  // sorted by (point, object), then triangle
  std::vector<StoredEdges> edges;   // sorted by (a, b)
  bool begun = false;               // a step has been stored

  void sort();  // required after entries were added
  // Throws InputError if the history was stored by another scene.
  static StoredContacts read(const History& history, const ContactSurface& surface);
  void write(History& history, const ContactSurface& surface) const;
  static void erase(History& history);
};

}  // namespace tack
