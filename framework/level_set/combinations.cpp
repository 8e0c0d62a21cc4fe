// Combinations of level sets: unions, intersections and differences, sharp or blended, and arrays of
// copies.
#include "framework/config/field.hpp"
#include "framework/level_set/level_set.hpp"
#include "geometry/level_set/distance_formulas.hpp"

namespace tack {
namespace {

using Box = Eigen::AlignedBox3d;

// Combination of several level sets, from the first to the last.
class Combination : public LevelSet {
 public:
  void fields(Fields& f) override {
    f.component_list("of", of_, "the bodies that it combines, in order").required().nonempty();
    f.number("blend", blend_, units::length, "rounding where surfaces meet: bodies whose distances differ by less are blended").nonnegative();
    LevelSet::fields(f);
  }
  void prepare(double voxel) override {
    for (const auto& part : of_) part->prepare(voxel);
  }

 protected:
  void own_values(std::span<const Vec3> points, std::span<double> values) const final {
    std::vector<double> next(points.size());
    of_.front()->evaluate(points, values);
    for (size_t k = 1; k < of_.size(); ++k) {
      of_[k]->evaluate(points, next);
      for (size_t i = 0; i < values.size(); ++i) values[i] = combined(values[i], next[i]);
    }
  }
  virtual double combined(double a, double b) const = 0;

  std::vector<std::unique_ptr<LevelSet>> of_;
  double blend_ = 0;  // m
};

class UnionLevelSet : public Combination {
 protected:
  double combined(double a, double b) const override { return blended_min(a, b, blend_); }
  Box own_bounds() const override {
    Box box;
    for (const auto& part : of_) box.extend(part->bounds());
    return widened(box, blend_ / 4 * static_cast<double>(of_.size() - 1));  // a blend bulges by no more than a quarter of its width
  }
};

class IntersectionLevelSet : public Combination {
 protected:
  double combined(double a, double b) const override { return -blended_min(-a, -b, blend_); }
  Box own_bounds() const override {
    Box box = everywhere();
    for (const auto& part : of_) box.clamp(part->bounds());
    return box;
  }
};

class DifferenceLevelSet : public Combination {
 protected:
  double combined(double a, double b) const override { return -blended_min(-a, b, blend_); }
  Box own_bounds() const override { return of_.front()->bounds(); }
};

class ArrayLevelSet : public DerivedLevelSet {
 public:
  void fields(Fields& f) override {
    f.vector("counts", counts_, "copies along x, y and z").required().at_least(1);
    f.vector("spacing", spacing_, units::length, "distance between copies along each axis").required().positive();
    DerivedLevelSet::fields(f);
  }

 protected:
  Box own_bounds() const override {
    Box one = child().bounds();
    if (one.isEmpty() || !finite(one)) return one;
    return {one.min() - half_extent(), one.max() + half_extent()};
  }
  void own_values(std::span<const Vec3> points, std::span<double> values) const override {
    const Box one = child().bounds();
    // Copies farther from the nearest copy than that number of neighbours are never nearer.
    std::array<int, 3> neighbour_count{};
    for (int k = 0; k < 3; ++k)
      neighbour_count[k] = one.isEmpty() || !finite(one) ? counts_[k] - 1 : std::min(counts_[k] - 1, 1 + static_cast<int>(one.sizes()[k] / spacing_[k]));
    std::vector<Vec3> moved(points.size());
    std::vector<double> next(points.size());
    std::fill(values.begin(), values.end(), std::numeric_limits<double>::infinity());
    for (int a = -neighbour_count[0]; a <= neighbour_count[0]; ++a)
      for (int b = -neighbour_count[1]; b <= neighbour_count[1]; ++b)
        for (int c = -neighbour_count[2]; c <= neighbour_count[2]; ++c) {
          for (size_t i = 0; i < points.size(); ++i)
            for (int k = 0; k < 3; ++k) {
              const double last = counts_[k] - 1, start = one.isEmpty() || !finite(one) ? 0 : one.center()[k];
              const double nearest = std::clamp(std::round((points[i][k] - start) / spacing_[k] + last / 2), 0.0, last);
              const double which = std::clamp(nearest + (k == 0 ? a : k == 1 ? b : c), 0.0, last);
              moved[i][k] = points[i][k] - (which - last / 2) * spacing_[k];
            }
          child().evaluate(moved, next);
          for (size_t i = 0; i < values.size(); ++i) values[i] = std::min(values[i], next[i]);
        }
  }

 private:
  Vec3 half_extent() const {
    return {(counts_[0] - 1) * spacing_[0] / 2, (counts_[1] - 1) * spacing_[1] / 2, (counts_[2] - 1) * spacing_[2] / 2};
  }

  std::array<int, 3> counts_ = {1, 1, 1};
  Vec3 spacing_ = Vec3::Ones();  // m
};

TACK_REGISTER(LevelSet, UnionLevelSet, "union", "The union of several bodies.", "");
TACK_REGISTER(LevelSet, IntersectionLevelSet, "intersection", "The common part of several bodies.", "");
TACK_REGISTER(LevelSet, DifferenceLevelSet, "difference", "The first body minus the others.", "");
TACK_REGISTER(LevelSet, ArrayLevelSet, "array", "Copies at the points of a grid, centred at the origin.", "");

}  // namespace
}  // namespace tack
