// Contact of an object with itself where it is close to itself at rest. A body alone is free of
// stress, so no pair of its primitives presses at rest. A pair presses once it is closer than at
// rest.
// Two kinds of pairs are close at rest:
//  * Pairs with a *gap* between them: the layers of a folded sheet, the windings of a spring, the
//    sides of a slit. The line between their closest points leaves one of them at more than 45
//    degrees, and the path over the mesh is more than three times as long as the distance. Their
//    law is cut down to their distance D at rest (PairLaw::from_rest): the offset o becomes min(o,
//    0.95 D), and the barrier is shortened to the remaining gap up to D.
//  * *Neighbours*: all other pairs, along the surface, over a crease or through a thin solid. They
//    do not press, and the offset of the object does not count between them. Exception: on a
//    surface without offset, neighbours that face each other press below their smallest D.
// A vertex has one distance D to its own object, the smallest at rest over a gap. It therefore has
// one law towards its object: the inclusion-exclusion of point_features.hpp needs one law for all
// triangles, and the law does not change as the vertex slides from one triangle to the next. A pair
// of edges has its own D. Distances are rounded down to powers of 0.98, which limits the number of
// laws.
#pragma once

#include <algorithm>
#include <array>
#include <vector>

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/laws/pair_table.hpp"

namespace tack {

class RestGaps {
 public:
  // Adds the cut-down laws to the table. The surface must outlive this.
  RestGaps(const ContactSurface& surface, PairTable& pairs);

  // Returns the law that replaces `law` between a vertex and its own object, or between two edges
  // of one object; `law` itself without a gap.
  int law_of_point(int law, int vertex_index) const {
    return levels_.empty() ? law : cut_down(law, level_of_point_[vertex_index]);
  }
  int law_of_edges(int law, const Edge& a, const Edge& b) const;
  double range(int law) const { return ranges_[law]; }  // of a law of the table [m]

  // Returns whether there is a gap between two primitives of one object that are close at rest.
  bool gap_between(const std::array<int, 1>& p, const Triangle& t) const {
    return has(point_gaps_, {p[0], t[0], t[1], t[2]});
  }
  bool gap_between(const std::array<int, 1>& p, const Edge& rod) const {
    return has(point_gaps_, {p[0], rod[0], rod[1], -1});
  }
  bool gap_between(const std::array<int, 1>&, const std::array<int, 1>&) const { return true; }
  bool gap_between(const Edge& a, const Edge& b) const {
    return has(edge_gaps_, {a[0], a[1], b[0], b[1]});
  }

  // Returns the reduced offset of two primitives of one object that are not neighbours [m].
  template <std::size_t B>
  double offset(double o, const std::array<int, 1>& p, const std::array<int, B>&) const {
    return levels_.empty() ? o : offset_at(o, level_of_point_[p[0]]);
  }
  double offset(double o, const Edge& a, const Edge& b) const;

 private:
  using Keys = std::vector<std::array<int, 4>>;  // global vertices of two primitives, sorted
  class Finder;

  void find_levels(const PairTable& pairs);
  void add_laws(PairTable& pairs);
  int level_below(double distance) const;
  int level_of(const Edge& a, const Edge& b) const;
  int cut_down(int law, int level) const {
    return level < 0 || law >= laws_ ? law : cut_down_[law * levels_.size() + level];
  }
  double offset_at(double o, int level) const;
  static bool has(const Keys& gaps, const std::array<int, 4>& pair) {
    return std::binary_search(gaps.begin(), gaps.end(), pair);
  }

  const ContactSurface& surface_;
  int laws_;                           // of the table, without those cut down
  std::vector<double> search_radius_;  // per object: of its laws with itself [m]; 0: it has none
  Keys point_gaps_, edge_gaps_;  // pairs with a gap between, closer at rest than the search radius
  std::vector<double> levels_;   // distances, ascending [m]; empty: no gap at rest
  std::vector<int> level_of_point_;  // per global vertex; -1: none
  std::vector<int> cut_down_;        // per law and level
  std::vector<double> ranges_;       // per law of the table [m]
};

}  // namespace tack
