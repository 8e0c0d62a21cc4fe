// Pairs of triangles whose adhesion is integrated by clipping (clipped_adhesion_term.hpp): whose
// plane is used, by which law they adhere, and where regions with other laws begin.
//
// Object b, whose planes are used, is chosen once: the one with the larger surface at rest, if
// equal the one with the larger cells.
//
// Regions. A pair of triangles has the law L of its regions; L_0 is that of the objects, which
// holds outside of regions. Beside a region interface the pair is split in two:
//     L_0, without regard to regions;   L - L_0, with strips along the interfaces of b.
// Why: where interfaces of both bodies coincide, the force would jump by the difference of the
// energies per length, and Newton's method stall, as at boundaries (boundary_weight.hpp). With a
// strip it leaves zero linearly, and the energy of equal laws stays. Without L_0 one pair is left.
#pragma once

#include <vector>

#include "framework/contact/clipped/clipped_laws.hpp"
#include "framework/contact/clipped/rest_triangles.hpp"
#include "framework/contact/clipped/strip_edges.hpp"
#include "framework/contact/contact_system.hpp"

namespace tack {

// Indices of triangles, that of the object whose planes are used second.
struct TrianglePair {
  int a, b;
  int law;    // that is integrated
  int whole;  // of the two triangles; -1: none, or another pair stands for it
  // A bit per edge: a region interface.
  unsigned char interfaces_a, interfaces_b;
  bool operator==(const TrianglePair&) const = default;
};

class TrianglePairFinder {
 public:
  // The arguments must outlive the finder.
  TrianglePairFinder(const ContactSystem& system, const ClippedLaws& laws, const StripEdges& edges);

  // Returns the candidates of the broad phase, by b, then by a.
  std::vector<TrianglePair> find();

 private:
  bool has_planes(int object, int other) const;
  int law_of(int a, int b) const;
  void add(int a, int b, std::vector<TrianglePair>& out);
  template <class LawBeyond>
  unsigned char interfaces(int triangle, int law, const LawBeyond& law_beyond) const;

  const ContactSystem& system_;
  const ClippedLaws& laws_;
  const StripEdges& edges_;
  RestTriangles rest_;
  std::vector<double> surface_area_;  // per object, at rest [m^2]
  std::vector<char> has_planes_;      // per object: whether its planes are used towards any other
};

}  // namespace tack
