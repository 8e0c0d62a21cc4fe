// Envelope of a damage law (damage_law.hpp) for any traction T by opening x: D = 1 - T(x) / (K x),
// K the largest T(x) / x. D is a monotone curve of the squared opening z, so that g(D) = K/2 (z D -
// integral of D) is exact.
#pragma once

#include <functional>
#include <memory>
#include <vector>

namespace tack {

class SampledEnvelope {
 public:
  SampledEnvelope() = default;
  // traction(x) [Pa], openings x from 0 to end [m]; zero beyond. Throws InputError, with a message
  // that begins with `what`, for a traction that does not begin at 0 or whose secant stiffness
  // grows.
  SampledEnvelope(const std::function<double(double)>& traction, double end, const char* what);

  double stiffness() const { return stiffness_; }  // K [Pa/m]

  double end() const { return end_; }
  double damage(double opening) const;
  double growth(double opening) const;
  double opening(double damage) const;
  double spent(double damage) const;

 private:
  // D = y + m t + c t^2 + k t^3 with t = squared opening - z. Pieces are equally long by opening.
  struct Piece {
    double z = 0, y = 0, m = 0, c = 0, k = 0;
    double integral = 0;  // of D up to the start of the piece

    double value(double t) const { return y + t * (m + t * (c + t * k)); }
    double slope(double t) const { return m + t * (2 * c + 3 * t * k); }
    double integral_to(double t) const {
      return integral + t * (y + t * (m / 2 + t * (c / 3 + t * k / 4)));
    }
  };
  struct Position {
    const Piece* piece;
    double t;
  };
  Position at(double opening) const;
  Position position_of(double damage) const;

  std::shared_ptr<const std::vector<Piece>> pieces_;  // the last piece is the end point
  double stiffness_ = 0, end_ = 0, pieces_per_opening_ = 0;
};

}  // namespace tack
