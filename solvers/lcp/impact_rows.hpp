// Contacts that are not near at the start of a step but meet on the linear trajectories to its end.
// Continuous collision detection finds them, and rows take the normals and features at the time of
// impact (Otaduy et al. 2009). Linearising at the start of the step instead would keep fast bodies,
// which move by several of their own sizes, off planes that they never reach.
#pragma once

#include <array>
#include <set>

#include "geometry/broad_phase/broad_phase.hpp"
#include "solvers/lcp/contact_rows.hpp"

namespace tack {

class ImpactFinder {
 public:
  // Both arguments must outlive the finder. margin: gap as in ContactFinder [m].
  ImpactFinder(const ContactSystem& system, double margin);

  // Begins a step. near: contacts that have rows already.
  void begin(const StoredContacts& near);
  // Appends the rows and stored entries of contacts that meet between x and end (3n) and were not
  // found before, in the order of candidates.
  void find(const VecX& x, const VecX& end, ContactRows& out);

 private:
  struct Impact {
    bool of_edges;
    std::array<int, 2> who;  // point and triangle, or two edges
    ContactRow row;
    double side = 0;
  };
  bool meets(int point, int triangle, const VecX& x, const VecX& displacement, Impact& out) const;
  bool edges_meet(int a, int b, const VecX& x, const VecX& displacement, Impact& out) const;
  void finish(ContactRow& row, int object, int opposite, const VecX& x, double margin) const;

  const ContactSystem& system_;
  const ContactSurface& surface_;
  double margin_;
  BroadPhase broad_phase_;
  std::set<std::array<int, 2>> found_points_, found_edges_;
};

}  // namespace tack
