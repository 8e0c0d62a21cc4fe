// Adhesion laws of the pairs of objects whose adhesion is integrated by clipping
// (clipped_adhesion_term.hpp), and their widths of strips. Table over classes of objects.
#pragma once

#include <utility>
#include <vector>

#include "framework/contact/clipped/clipped_pair.hpp"
#include "framework/contact/pair_law.hpp"
#include "geometry/broad_phase/object_classes.hpp"

namespace tack {

// Of two objects, the one whose normals and planes are used (b of clipped_pair.hpp).
enum class ClippedPlanes { of_larger, of_coarser, of_first, of_second };

struct ClippedLaw {
  PairLaw law;     // adhesion alone
  GapBands bands;  // m
  double range;    // of the law, offsets included [m]
  double strip;    // largest width of a strip [m]
};

class ClippedLaws {
 public:
  // Width of a strip per range of the law beyond the offset. Half a range converges best among the
  // widths 1/4 and 1/2 in slow steps, and changes areas by less than 1.4e-3 of the strip.
  static constexpr double strip_per_range = 0.5;

  explicit ClippedLaws(ObjectClasses classes)
      : classes_(std::move(classes)), index_(classes_.entries(), -1),
        planes_(classes_.entries(), ClippedPlanes::of_larger) {}

  bool empty() const { return laws_.empty(); }
  const std::vector<ClippedLaw>& laws() const { return laws_; }
  // Returns the index of a law between objects a and b; -1: none.
  int between(int a, int b) const { return index_[classes_.index(a, b)]; }
  int add(PairLaw law) {
    const double range = law.range(), strip = strip_per_range * (range - law.offset());
    GapBands bands = gap_bands(law);
    laws_.push_back({std::move(law), std::move(bands), range, strip});
    return static_cast<int>(laws_.size()) - 1;
  }
  // Sets the law between a and b, and whose planes are used; first: a.
  void set(int a, int b, int law, ClippedPlanes planes) {
    const bool swapped = planes == ClippedPlanes::of_first || planes == ClippedPlanes::of_second;
    const ClippedPlanes from_b = !swapped                            ? planes
                                 : planes == ClippedPlanes::of_first ? ClippedPlanes::of_second
                                                                     : ClippedPlanes::of_first;
    index_[classes_.index(a, b)] = index_[classes_.index(b, a)] = law;
    planes_[classes_.index(b, a)] = from_b;
    planes_[classes_.index(a, b)] = planes;
  }
  ClippedPlanes planes(int a, int b) const { return planes_[classes_.index(a, b)]; }

 private:
  ObjectClasses classes_;
  std::vector<int> index_;
  std::vector<ClippedPlanes> planes_;
  std::vector<ClippedLaw> laws_;
};

}  // namespace tack
