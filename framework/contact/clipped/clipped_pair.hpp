// Adhesion energy between two triangles, as a function of their positions alone:
//     E = F(c) int over S of rho phi(g) dA,    F(c) = f(c) / c,    c = -n_a . n_b,
// S: the part of triangle b onto which triangle a is projected along n_b, the normal of b;
// g: gap of a over the plane of b; phi: energy per area of a gap (normal_law.hpp);
// rho: weight near the boundary edges of b's surface (boundary_weight.hpp).
// f(c) = c for c >= 0.15, 0 for c <= 0.02, and twice differentiable between.
//
// Exact for phi of degree two between the levels (GapBands) and rho = 1; the quadrature is of
// degree two there, of degree eight within strips. The gradient is that of the quadrature,
// round-off apart. Net force and moment are zero.
//
// The Hessian is positive semi-definite: the curvature of phi where it is positive, and the
// boundary edges of a in a strip of b. Curvatures of the clip itself are left out: those of
// neighbours cancel in the sum, and projecting them pair by pair does not converge.
//
// Source: clipping as in mortar methods (Puso and Laursen 2004); one plane per pair, no normals of
// vertices.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/clipped/clip_tape.hpp"
#include "framework/contact/pair_law.hpp"

namespace tack {

using Vec18 = Eigen::Matrix<double, 18, 1>;
using Mat18 = Eigen::Matrix<double, 18, 18>;

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
  double energy = 0;             // J
  std::array<double, 3> area{};  // of each corner of b: int of rho F times its shape function [m^2]
};

// The integral of one pair at a time. One object per thread: it keeps its memory.
class ClipIntegrator {
 public:
  // Returns whether a lies over b, nearer than `range` somewhere, and faces it.
  bool overlaps(const ClippedPair& pair, double range);
  ClippedIntegral value(const ClippedPair& pair, const PairLaw& law, const GapBands& bands);
  // Overwrites gradient (corners of a, then of b) and, unless null, hessian.
  ClippedIntegral derivatives(const ClippedPair& pair, const PairLaw& law, const GapBands& bands,
                              Vec18& gradient, Mat18* hessian);

 private:
  struct Frame;
  struct Point {  // of the quadrature
    std::array<int, 3> nodes;
    Vec3 share;     // barycentric coordinates within these nodes
    double weight;  // fraction of the area of the three nodes
    double area;    // of the three nodes [m^2]
    Vec3 at;        // x, y, g [m]
    double rho;
  };
  bool clip(const ClippedPair& pair, Frame& frame);
  void cut_strips(const ClippedPair& pair);
  void cut_bands(const GapBands& bands);
  void add_points(const ClippedPair& pair);
  bool prepare(const ClippedPair& pair, const GapBands& bands, Frame& frame);
  ClippedIntegral sum(const Frame& frame) const;
  void write_gradient(const ClippedPair& pair, const Frame& frame, double energy, Vec18& gradient);
  void write_hessian(const ClippedPair& pair, const Frame& frame, const PairLaw& law,
                     Mat18& hessian) const;

  ClipTape tape_;
  std::vector<ClipPiece> pieces_, other_pieces_;
  ClipPiece piece_, within_;
  std::vector<Point> points_;
  std::vector<double> gaps_, values_;
  std::vector<LawSample> samples_;
};

}  // namespace tack
