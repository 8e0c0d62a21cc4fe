// Adhesion laws of the pairs of objects, and of regions of them, whose adhesion is integrated by
// clipping (clipped_adhesion_term.hpp), their differences and widths of strips. Table over classes
// of objects.
#pragma once

#include <map>
#include <utility>
#include <vector>

#include "framework/contact/clipped/clipped_pair.hpp"
#include "framework/contact/laws/pair_law.hpp"
#include "geometry/broad_phase/object_classes.hpp"

namespace tack {

// Of two objects, the one whose normals and planes are used (b of clipped_pair.hpp). of_both: each
// in turn, with half of the law; always so within one object.
enum class ClippedPlanes { of_larger, of_coarser, of_first, of_second, of_both };

struct ClippedLaw {
  PairLaw law;       // adhesion alone
  GapBands bands;    // m
  double range;      // of the law, offsets included [m]
  double strip;      // largest width of a strip [m]
  int of_table;      // law of the pair table that its contact points have
  double share = 1;  // of the areas that a pair of triangles stands for
};

class ClippedLaws {
 public:
  // Width of a strip per range of the law beyond the offset. Half a range converges best among the
  // widths 1/4 and 1/2 in slow steps, and changes areas by less than 1.4e-3 of the strip.
  static constexpr double strip_per_range = 0.5;

  // Motion of vertices for which pairs of triangles are found, per range of the law. A wider margin
  // finds them more seldom, but keeps more pairs that do not interact: 930 instead of 500 in
  // debonding/pull with 0.05, mostly of faces with the side walls of the other body.
  static constexpr double margin_per_range = 0.01;

  explicit ClippedLaws(ObjectClasses classes)
      : classes_(std::move(classes)), laws_of_pair_(classes_.entries()),
        planes_(classes_.entries(), ClippedPlanes::of_larger) {}

  const std::vector<ClippedLaw>& laws() const { return laws_; }
  // Returns the index of the law between a and b, or between regions of them (the index of
  // pair_table.hpp; -1: outside of regions); -1: none.
  int between(int a, int b, int region_pair) const {
    const std::vector<int>& laws = laws_of_pair_[classes_.index(a, b)];
    const std::size_t i = static_cast<std::size_t>(region_pair + 1);
    return i < laws.size() ? laws[i] : -1;
  }
  // Returns whether a and b, or regions of them, have a law.
  bool any(int a, int b) const { return !laws_of_pair_[classes_.index(a, b)].empty(); }
  // Returns the index of a new law. of_table: see ClippedLaw.
  int add(PairLaw law, int of_table);
  // Sets the law of a region pair of a towards b, and the same of b towards a; region pair -1: of
  // the objects. law: -1: none, which only a region pair may have.
  void set(int a, int b, int law, int region_pair, int reverse_region_pair) {
    store(a, b, law, region_pair);
    store(b, a, law, reverse_region_pair);
  }
  // Sets whose planes are used; first: a.
  void set_planes(int a, int b, ClippedPlanes planes) {
    planes_[classes_.index(b, a)] = planes == ClippedPlanes::of_first    ? ClippedPlanes::of_second
                                    : planes == ClippedPlanes::of_second ? ClippedPlanes::of_first
                                                                         : planes;
    planes_[classes_.index(a, b)] = planes;
  }
  ClippedPlanes planes(int a, int b) const { return planes_[classes_.index(a, b)]; }
  // Returns the index of half of a law: of the sum over the planes of both.
  int half_of(int law);
  // Returns the laws between a and b alone, which become objects 0 and 1; a = b: object 0.
  ClippedLaws of_objects(int a, int b) const;
  // Adds the differences of the laws of regions from those of their objects, once all are set.
  void add_differences();
  // Returns the index of the law of a region (-1: none) less that of its objects.
  int difference(int law, int of_objects) const { return differences_.at({law, of_objects}); }

 private:
  void store(int a, int b, int law, int region_pair) {
    std::vector<int>& laws = laws_of_pair_[classes_.index(a, b)];
    if (static_cast<int>(laws.size()) < region_pair + 2)
      laws.resize(static_cast<std::size_t>(region_pair) + 2, -1);
    laws[static_cast<std::size_t>(region_pair + 1)] = law;
  }

  ObjectClasses classes_;
  std::vector<std::vector<int>> laws_of_pair_;  // of the objects, then of their region pairs
  std::vector<ClippedPlanes> planes_;
  std::vector<ClippedLaw> laws_;
  std::map<int, int> half_;
  std::map<std::pair<int, int>, int> differences_;
};

}  // namespace tack
