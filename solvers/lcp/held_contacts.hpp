// History of contacts between steps: the side of the other surface, the distance at the start, and
// the pressure. Keyed by (point, object), where a point may be near several features of the object,
// and by pairs of edges.
#pragma once

#include <vector>

#include "framework/contact/contact_set.hpp"
#include "framework/core/history.hpp"

namespace tack {

struct HeldPoint {
  int point, object;
  int triangle;        // of the mesh, that it was nearest to
  // 1: where the triangle's normal points; -1: behind it; 0: it has none (beside a boundary).
  double side;
  double gap;          // that is kept [m]: the margin, or less of what started closer
  double depth;        // that it is behind where it belongs; 0 in front [m]
  Vec3 force;          // on the point [N]
};

struct HeldEdges {
  int a, b;            // edges of the mesh, ascending
  Vec3 normal;         // from b to a, while they were on their sides
  double gap, depth;
  Vec3 force;          // on a [N]
};

struct HeldContacts {
  std::vector<HeldPoint> points;  // by (point, object), then triangle
  std::vector<HeldEdges> edges;   // by (a, b)
  bool begun = false;             // the run has

  void sort();  // after entries were added
  // Throws InputError for what was remembered of another scene.
  static HeldContacts read(const History& history, const ContactSurface& surface);
  void write(History& history, const ContactSurface& surface) const;
  static void forget(History& history);
};

}  // namespace tack
