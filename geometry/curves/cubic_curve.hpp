// Piecewise cubic function of one variable with given values and slopes at knots (cubic Hermite).
// It has a continuous first derivative; its exact integral has a continuous second one.
#pragma once

#include <vector>

namespace tack {

class CubicCurve {
 public:
  struct Sample {
    double value = 0;
    double slope = 0;
    double integral = 0;  // from the first knot to x
    double rest = 0;      // from x to the last knot, without cancellation where it is small
  };
  struct Point {
    double x = 0, value = 0;
  };

  CubicCurve() = default;
  // Takes one value and slope per x. Throws std::logic_error for less than two knots, for x that
  // does not ascend, and for values that are not finite.
  CubicCurve(const std::vector<double>& x, const std::vector<double>& values,
             const std::vector<double>& slopes);

  // Returns a curve through the values that is monotone between neighbours, so that it has no other
  // extrema (PCHIP: Fritsch and Butland 1984, at the ends as Moler 2004, Numerical computing with
  // MATLAB, 3.6). Throws as above.
  static CubicCurve monotone(const std::vector<double>& x, const std::vector<double>& values);

  // Returns the curve at x; outside of the knots, the values at the ends are constant.
  Sample at(double x) const;

  double first() const { return pieces_.front().x; }
  double last() const { return pieces_.back().x; }
  double total() const { return pieces_.back().integral; }  // from the first knot to the last
  int knots() const { return static_cast<int>(pieces_.size()); }

  // Returns the first point with the largest value at or above `from`.
  Point largest(double from) const;
  Point largest() const { return largest(first()); }
  Point least() const;

 private:
  // Piece from a knot on: y + m t + c t^2 + k t^3 with t = x - knot; the last one is only a knot.
  struct Piece {
    double x = 0, y = 0, m = 0, c = 0, k = 0;
    double c_end = 0;  // c relative to the end of the piece
    double integral = 0, rest = 0;
  };
  // Calls act(x, value) at the ends and the extrema of the piece.
  template <class Act>
  void for_each_extreme(int piece, const Act& act) const;
  int piece_at(double x) const;
  void find_starts();

  std::vector<Piece> pieces_;
  std::vector<int> starts_;  // per equal bin of the range: the piece in which it begins
  double bins_per_x_ = 0;
};

}  // namespace tack
