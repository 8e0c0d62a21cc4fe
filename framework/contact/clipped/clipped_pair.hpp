// Adhesion energy between two triangles, as a function of their positions alone:
//     E = F(c) int over S of rho phi(g) dA,    F(c) = f(c) / c,    c = -n_a . n_b,
// S: the part of triangle b onto which triangle a is projected along n_b, the normal of b;
// g: gap of a over the plane of b; phi: energy per area of a gap (normal_law.hpp);
// rho: weight near the boundary edges of b's surface (boundary_weight.hpp).
// f(c) = c for c >= 0.15, 0 for c <= 0.02, and twice differentiable between.
//
// Quadrature: S is cut at the levels of the law (GapBands). The part S_i between two levels has the
// area A, the mean gap m and the variance V of the gap, all weighted by rho, which are exact, and
//     int over S_i of rho phi dA = A (phi(m - s) + phi(m + s)) / 2,    s = sqrt(V),
// which is exact for phi of degree two between the levels. To first order in a change of the
// positions, phi acts as the parabola h with h'(m), h'' and mean those of phi at m - s and m + s.
// So the gradient is a shape derivative: int rho h' dg over S_i, int rho h (v . outward) along its
// sides that move with the velocity v, and int h d rho. It is that of the quadrature, round-off
// apart. Crossings of edges need no derivative. Net force and moment are zero.
//
// The Hessian is positive semi-definite: the curvature of phi where it is positive, and the
// boundary edges of a in a strip of b. Curvatures of the clip itself are left out: those of
// neighbours cancel in the sum, and projecting them pair by pair does not converge.
//
// Source: clipping as in mortar methods (Puso and Laursen 2004); one plane per pair, no normals of
// vertices.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include "framework/contact/clipped/clip_plane.hpp"
#include "framework/contact/clipped/plane_polygon.hpp"
#include "framework/contact/laws/pair_law.hpp"

namespace tack {

using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat18 = Eigen::Matrix<double, 18, 18>;

// Cosines c between which the weight of a pair falls to zero: two surfaces at more than 81 degrees.
inline constexpr double clip_cosine_min = 0.02, clip_cosine_full = 0.15;

// Levels between which a law is close to a parabola, ascending, from 0 to its range [m].
using GapBands = std::vector<double>;
// Returns two bands for a law of two parabolas, as many as needed for others.
GapBands gap_bands(const PairLaw& law);

struct ClippedPair {
  std::array<Vec3, 3> a, b;          // corners, counter-clockwise seen from outside [m]
  std::array<bool, 3> boundary_a{};  // edge i: from corner i to the next
  // Edge i: whether points on its line belong to this triangle, not to its neighbour there.
  std::array<bool, 3> owns_b{true, true, true};
  std::array<double, 3> strip_b{};  // width of the strip of each edge of b [m]; 0: no boundary
};

struct ClippedIntegral {
  double energy = 0;  // J
  // int of rho F times the shape function of each corner of b, and of a [m^2].
  std::array<double, 3> area{}, area_a{};
  double gap = 0;  // mean, weighted by rho F [m]
};

// The integral of one pair at a time. One object per thread: it keeps its memory, and the plane of
// b from one pair to the next.
class ClipIntegrator {
 public:
  // Returns whether a lies over b, nearer than `range` somewhere, and faces it; true also within
  // round-off of it.
  bool overlaps(const ClippedPair& pair, double range);
  ClippedIntegral value(const ClippedPair& pair, const PairLaw& law, const GapBands& bands);
  // Overwrites gradient (corners of a, then of b) and, unless null, hessian.
  ClippedIntegral derivatives(const ClippedPair& pair, const PairLaw& law, const GapBands& bands,
                              Vec18& gradient, Mat18* hessian);

 private:
  // Part of S between two levels that lies in the same strips.
  struct Piece {
    PlanePolygon polygon;
    int band;         // -1: none, out of range
    unsigned strips;  // a bit per line of b: the piece lies in its strip
  };
  // Part of S between two levels. Shares are the barycentric coordinates in a.
  struct Band {
    double area = 0;  // int of rho [m^2]; of slivers along a line it may have any sign
    double low = std::numeric_limits<double>::infinity(), high = -low;  // gaps of corners [m]
    double first = 0, second = 0;  // int of rho times the shares of corners 1 and 2 [m^2]
    // Covariances of these shares; while they are summed, integrals of their products.
    double first_first = 0, first_second = 0, second_second = 0;
    double mean = 0, deviation = 0;  // of the gap [m]: m and s
    // int of rho (g - m) [m^3] and rho (g - m)^2 [m^4] where m is no mean; else 0.
    double excess = 0, second_excess = 0;
    // h(g) = constant + slope (g - m) + curvature (g - m)^2 / 2
    double constant = 0, slope = 0, curvature = 0;
    double stiffness = 0;  // mean of phi'' [Pa/m]
    bool empty() const { return !(low <= high); }
    double h(double gap) const {
      const double from_mean = gap - mean;
      return constant + from_mean * (slope + 0.5 * curvature * from_mean);
    }
  };
  // Derivatives of the integral without F by local coordinates.
  struct Slopes {
    std::array<Vec3, 3> a;
    std::array<Vec2, 3> b;
  };

  Piece& next_piece();
  bool set(const ClippedPair& pair);
  bool clip(const ClippedPair& pair);
  void cut_strips(const ClippedPair& pair);
  void cut_bands(const GapBands& bands);
  void add_moments(const ClippedPair& pair, const Piece& piece);
  bool find_gaps();
  bool prepare(const ClippedPair& pair, const GapBands& bands);
  ClippedIntegral sum() const;

  void add_gap_slopes(Slopes& slopes) const;
  void add_side_slopes(const ClippedPair& pair, const Piece& piece, Slopes& slopes) const;
  void add_strip_slopes(const ClippedPair& pair, const Piece& piece, Slopes& slopes) const;
  void write_gradient(const ClippedPair& pair, const Slopes& slopes, double energy,
                      Vec18& gradient) const;
  void write_hessian(const ClippedPair& pair, Mat18& hessian) const;

  ClipPlane plane_;
  Vec3 normal_a_;
  double twice_area_a_;                    // m^2
  double cosine_, facing_, facing_slope_;  // c, F(c), dF/dc
  std::array<Vec3, 3> a_;                  // local coordinates of the corners of a [m]
  Vec2 gap_slope_;                         // of the gap by the local coordinates
  PlanePolygon polygon_, kept_, rest_;
  std::vector<Piece> pieces_;  // the first piece_count_ of them
  int piece_count_ = 0;
  std::vector<Band> bands_;
  std::vector<double> gaps_, values_;  // two per band
  std::vector<LawSample> samples_;
};

}  // namespace tack
