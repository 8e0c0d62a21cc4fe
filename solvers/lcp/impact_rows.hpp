// Contacts that are no nearest features at the start of a step but are met on the linear
// trajectories of the step: found by continuous collision detection, with the normals and positions
// at the time of impact (Otaduy et al. 2009). Linearised at the start of the step, a body that
// moves by several of its sizes in a step would be kept off planes that it never reaches.
#pragma once

#include <array>
#include <set>

#include "geometry/broad_phase/broad_phase.hpp"
#include "solvers/lcp/contact_rows.hpp"

namespace tack {

class ImpactFinder {
 public:
  // Both must outlive it. margin: as of ContactFinder [m].
  ImpactFinder(const ContactSystem& system, double margin);

  // A step begins; near: who has rows already.
  void begin(const HeldContacts& near);
  // Adds the rows of what meets between x and end (3n) and was not found before, in the order of
  // candidates, and what the next step is to know of it.
  void find(const VecX& x, const VecX& end, ContactRows& out);

 private:
  struct Impact {
    bool of_edges;
    std::array<int, 2> who;  // point and triangle, or two edges
    ContactRow row;
    double side = 0;
  };
  bool meets(int point, int triangle, const VecX& x, const VecX& way, Impact& out) const;
  bool edges_meet(int a, int b, const VecX& x, const VecX& way, Impact& out) const;
  void finish(ContactRow& row, int object, int opposite, const VecX& x, double margin) const;

  const ContactSystem& system_;
  const ContactSurface& surface_;
  double margin_;
  BroadPhase broad_phase_;
  std::set<std::array<int, 2>> found_points_, found_edges_;
};

}  // namespace tack
