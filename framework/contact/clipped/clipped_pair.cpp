#include "framework/contact/clipped/clipped_pair.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <span>

#include "framework/contact/clipped/boundary_weight.hpp"
#include "framework/contact/law_peak.hpp"

namespace tack {
namespace {

// Cosines between which the weight of a pair falls to zero: two surfaces at more than 81 degrees.
constexpr double facing_cosine_min = 0.02, facing_cosine_full = 0.15;
// Distance of a corner of a from a line of b, per length of that edge, at which it counts as on the
// line. It then belongs to one of the two triangles there, so that where edges coincide, round-off
// decides nothing and nothing is lost.
constexpr double on_line_ratio = 1e-8;
// Spread of gaps or distances beyond a cut, per width of the band or strip, below which a piece is
// not cut: crossings of nearly parallel sides have no accurate derivatives.
constexpr double cut_ratio_min = 1e-6;

// Bands of gaps are halved until the law differs from its parabola (through both ends and the
// middle) by at most these fractions of its energy at gap zero and of its largest traction, or
// until a band is so narrow, per range. Energies of tilted plates are off by less than 2e-4 then.
constexpr double energy_tolerance = 3e-4, traction_tolerance = 2e-2, band_width_min = 1.0 / 256;

struct QuadraturePoint {
  Vec3 share;
  double weight;
};
// Exact for degree two: the midpoints of the edges.
const std::array<QuadraturePoint, 3> midpoints{
    {{{0.5, 0.5, 0}, 1.0 / 3}, {{0, 0.5, 0.5}, 1.0 / 3}, {{0.5, 0, 0.5}, 1.0 / 3}}};
// Exact for degree eight (Dunavant 1985): rho of two strips times an even gap. A rule of lower
// degree makes the energy jump where pieces are divided in another way.
std::array<QuadraturePoint, 16> sixteen_points() {
  std::array<QuadraturePoint, 16> all{{{Vec3::Constant(1.0 / 3), 0.144315607677787}}};
  int count = 1;
  for (const auto& [far, near_by, weight] : {std::array{0.081414823414554, 0.459292588292723, 0.095091634267285},
                                             std::array{0.658861384496480, 0.170569307751760, 0.103217370534718},
                                             std::array{0.898905543365938, 0.050547228317031, 0.032458497623198}})
    for (int k = 0; k < 3; ++k) {
      Vec3 share = Vec3::Constant(near_by);
      share[k] = far;
      all[count++] = {share, weight};
    }
  const std::array<double, 3> distinct{0.008394777409958, 0.263112829634638, 0.728492392955404};
  for (int k = 0; k < 3; ++k)
    for (const int turn : {1, 2})
      all[count++] = {Vec3(distinct[k], distinct[(k + turn) % 3], distinct[(k + 2 * turn) % 3]), 0.027230314174435};
  return all;
}
const std::array<QuadraturePoint, 16> points_in_strips = sixteen_points();

struct FacingFactor {
  double value, slope;  // F(c), dF/dc
};
FacingFactor facing_factor(double c) {
  if (c >= facing_cosine_full) return {1, 0};
  constexpr double width = facing_cosine_full - facing_cosine_min;
  const double t = (c - facing_cosine_min) / width;
  return {t * t * t * (10 - 15 * t + 6 * t * t), 30 * t * t * (1 - t) * (1 - t) / width};
}

// Adds factor times the derivative of n . v by the corners of a triangle with unit normal n, for a
// fixed v; twice_area: of the triangle.
void add_normal_slope(const std::array<Vec3, 3>& x, const Vec3& n, double twice_area, const Vec3& v,
                      double factor, double* gradient) {
  const Vec3 across = (v - v.dot(n) * n) * (factor / twice_area);
  const Vec3 by_1 = (x[2] - x[0]).cross(across), by_2 = across.cross(x[1] - x[0]);
  Eigen::Map<Vec3>(gradient) -= by_1 + by_2;
  Eigen::Map<Vec3>(gradient + 3) += by_1;
  Eigen::Map<Vec3>(gradient + 6) += by_2;
}

double twice_area_of(const Vec3& p, const Vec3& q, const Vec3& r) {
  return (q.x() - p.x()) * (r.y() - p.y()) - (q.y() - p.y()) * (r.x() - p.x());
}

// Returns whether the law is close to a parabola between two gaps.
bool close_to_parabola(const PairLaw& law, double low, double high, double energy, double traction) {
  const double half = (high - low) / 2, first = law.at(low).value, middle = law.at(low + half).value, last = law.at(high).value;
  const double slope = (last - first) / 2, bend = (last - 2 * middle + first) / 2;
  for (const double t : {-0.85, -0.6, -0.3, 0.3, 0.6, 0.85}) {
    const LawSample at = law.at(low + half * (1 + t));
    if (std::abs(at.value - (middle + t * (slope + t * bend))) > energy) return false;
    if (std::abs(at.slope - (slope + 2 * t * bend) / half) > traction) return false;
  }
  return true;
}

}  // namespace

GapBands gap_bands(const PairLaw& law) {
  GapBands levels{0.0};
  double depth = 0, traction = 0;
  for (const auto& term : law.laws()) {
    const LawPeak peak = largest_traction(*term);
    depth += std::abs(term->at(0).value);
    traction += peak.traction;
    for (const double gap : {peak.gap, term->range()})
      if (gap > 0) levels.push_back(law.offset() + gap);
  }
  std::sort(levels.begin(), levels.end());
  levels.erase(std::unique(levels.begin(), levels.end()), levels.end());
  const double narrow = band_width_min * levels.back();
  for (std::size_t i = 0; i + 1 < levels.size();) {
    const double low = levels[i], high = levels[i + 1];
    if (high - low <= narrow || close_to_parabola(law, low, high, energy_tolerance * depth, traction_tolerance * traction)) ++i;
    else levels.insert(levels.begin() + static_cast<std::ptrdiff_t>(i) + 1, (low + high) / 2);
  }
  return levels;
}

// Local coordinates of a pair: origin b0, axes along the first edge of b, across it, and n_b.
struct ClipIntegrator::Frame {
  Mat3 axes;  // columns
  Vec3 normal_a, normal_b;
  double twice_area_a, twice_area_b;  // m^2
  double cosine;
  FacingFactor facing;
  std::array<Vec3, 3> a, b;  // local coordinates of the corners [m]
};

// Clips the projection of a by the edges of b. Returns false if nothing is left.
bool ClipIntegrator::clip(const ClippedPair& pair, Frame& frame) {
  const Vec3 cross_a = (pair.a[1] - pair.a[0]).cross(pair.a[2] - pair.a[0]);
  const Vec3 cross_b = (pair.b[1] - pair.b[0]).cross(pair.b[2] - pair.b[0]);
  frame.twice_area_a = cross_a.norm();
  frame.twice_area_b = cross_b.norm();
  if (!(frame.twice_area_a > 0) || !(frame.twice_area_b > 0)) return false;
  frame.normal_a = cross_a / frame.twice_area_a;
  frame.normal_b = cross_b / frame.twice_area_b;
  frame.cosine = -frame.normal_a.dot(frame.normal_b);
  if (!(frame.cosine > facing_cosine_min)) return false;
  frame.facing = facing_factor(frame.cosine);
  const Vec3 along = (pair.b[1] - pair.b[0]).normalized();
  frame.axes.col(0) = along;
  frame.axes.col(1) = frame.normal_b.cross(along);
  frame.axes.col(2) = frame.normal_b;
  for (int k = 0; k < 3; ++k) {
    frame.a[k] = frame.axes.transpose() * (pair.a[k] - pair.b[0]);
    frame.b[k] = frame.axes.transpose() * (pair.b[k] - pair.b[0]);
  }
  tape_.clear();
  // Seen from outside of b, the corners of a are clockwise.
  piece_ = {{tape_.add(frame.a[2]), 1}, {tape_.add(frame.a[1]), 0}, {tape_.add(frame.a[0]), 2}};
  for (int k = 0; k < 3; ++k) {
    tape_.lines[k] = PlaneLine(frame.b[k].head<2>(), frame.b[(k + 1) % 3].head<2>());
    for (ClipNode& node : tape_.nodes)
      if (std::abs(tape_.lines[k].distance(node.at)) < on_line_ratio * tape_.lines[k].length) node.ties |= 1u << k;
  }
  for (int i = 0; i < 3; ++i) {
    if (pair.boundary_a[piece_[i].side]) continue;
    ClipNode &from = tape_.nodes[i], &to = tape_.nodes[(i + 1) % 3];
    const unsigned both = from.ties & to.ties;
    from.shared_ties |= both;
    to.shared_ties |= both;
  }
  for (int k = 0; k < 3; ++k) {
    tape_.keep_inside(piece_, k, pair.owns_b[k], within_);
    piece_.swap(within_);
    if (piece_.empty()) return false;
  }
  pieces_.assign(1, piece_);
  return true;
}

// Cuts the pieces where a strip ends: rho is a polynomial in each of them.
void ClipIntegrator::cut_strips(const ClippedPair& pair) {
  for (int k = 0; k < 3; ++k) {
    if (!(pair.strip_b[k] > 0)) continue;
    other_pieces_.clear();
    for (const ClipPiece& piece : pieces_) {
      tape_.cut_by_line(piece, k, pair.strip_b[k], cut_ratio_min * pair.strip_b[k], piece_, within_);
      if (!piece_.empty()) other_pieces_.push_back(piece_);
      if (!within_.empty()) other_pieces_.push_back(within_);
    }
    pieces_.swap(other_pieces_);
  }
}

// Cuts the pieces at the levels of the bands, and leaves out gaps below the first and above the
// last.
void ClipIntegrator::cut_bands(const GapBands& bands) {
  other_pieces_.clear();
  for (ClipPiece& piece : pieces_) {
    double low = bands.back(), high = bands.front();
    for (const PieceCorner& corner : piece) {
      const double gap = tape_.nodes[corner.node].at.z();
      low = std::min(low, gap);
      high = std::max(high, gap);
    }
    for (std::size_t i = 0; i < bands.size() && !piece.empty() && high > bands.front(); ++i) {
      const double least = i > 0 ? cut_ratio_min * (bands[i] - bands[i - 1]) : 0;
      if (high <= bands[i] + least) {
        other_pieces_.push_back(piece);
        break;
      }
      if (low >= bands[i] - least) continue;
      tape_.cut_by_level(piece, bands[i], piece_, within_);
      if (i > 0 && !within_.empty()) other_pieces_.push_back(within_);
      piece.swap(piece_);
    }
  }
  pieces_.swap(other_pieces_);
}

void ClipIntegrator::add_points(const ClippedPair& pair) {
  points_.clear();
  for (const ClipPiece& piece : pieces_) {
    Vec3 middle = Vec3::Zero();
    for (const PieceCorner& corner : piece) middle += tape_.nodes[corner.node].at;
    middle /= static_cast<double>(piece.size());
    bool in_strip = false;
    for (int k = 0; k < 3; ++k) in_strip |= tape_.lines[k].distance(middle) < pair.strip_b[k];
    const std::span<const QuadraturePoint> rule =
        in_strip ? std::span<const QuadraturePoint>(points_in_strips) : std::span<const QuadraturePoint>(midpoints);
    for (std::size_t i = 1; i + 1 < piece.size(); ++i) {
      Point point{{piece[0].node, piece[i].node, piece[i + 1].node}, {}, 0, 0, {}, 1};
      const Vec3 &p = tape_.nodes[point.nodes[0]].at, &q = tape_.nodes[point.nodes[1]].at,
                 &r = tape_.nodes[point.nodes[2]].at;
      point.area = 0.5 * twice_area_of(p, q, r);
      for (const QuadraturePoint& at : rule) {
        point.share = at.share;
        point.weight = at.weight;
        point.at = at.share[0] * p + at.share[1] * q + at.share[2] * r;
        point.rho = 1;
        for (int k = 0; in_strip && k < 3; ++k)
          if (pair.strip_b[k] > 0)
            point.rho *= BoundaryWeight::at(tape_.lines[k].distance(point.at) / pair.strip_b[k]).value;
        points_.push_back(point);
      }
    }
  }
}

ClippedIntegral ClipIntegrator::sum(const Frame& frame) const {
  ClippedIntegral all;
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& p = points_[i];
    const double area = frame.facing.value * p.weight * p.area * p.rho;
    all.energy += area * values_[i];
    const double across = p.at.y() / frame.b[2].y();
    const double along = (p.at.x() - across * frame.b[2].x()) / frame.b[1].x();
    all.area[0] += area * (1 - along - across);
    all.area[1] += area * along;
    all.area[2] += area * across;
  }
  return all;
}

bool ClipIntegrator::overlaps(const ClippedPair& pair, double range) {
  const Vec3 normal = (pair.b[1] - pair.b[0]).cross(pair.b[2] - pair.b[0]);
  double low = range, high = 0;
  for (const Vec3& corner : pair.a) {
    const double gap = normal.dot(corner - pair.b[0]) / normal.norm();
    low = std::min(low, gap);
    high = std::max(high, gap);
  }
  if (!(low < range) || !(high > 0)) return false;
  Frame frame;
  return clip(pair, frame);
}

// Makes the quadrature points of a pair and their gaps. Returns false if there are none.
bool ClipIntegrator::prepare(const ClippedPair& pair, const GapBands& bands, Frame& frame) {
  if (!clip(pair, frame)) return false;
  cut_strips(pair);
  cut_bands(bands);
  add_points(pair);
  gaps_.resize(points_.size());
  values_.resize(points_.size());
  for (std::size_t i = 0; i < points_.size(); ++i) gaps_[i] = points_[i].at.z();
  return !points_.empty();
}

ClippedIntegral ClipIntegrator::value(const ClippedPair& pair, const PairLaw& law, const GapBands& bands) {
  Frame frame;
  if (!prepare(pair, bands, frame)) return {};
  law.values(static_cast<int>(gaps_.size()), gaps_.data(), values_.data());
  return sum(frame);
}

ClippedIntegral ClipIntegrator::derivatives(const ClippedPair& pair, const PairLaw& law, const GapBands& bands,
                                            Vec18& gradient, Mat18* hessian) {
  gradient.setZero();
  if (hessian) hessian->setZero();
  Frame frame;
  if (!prepare(pair, bands, frame)) return {};
  samples_.resize(points_.size());
  law.samples(static_cast<int>(gaps_.size()), gaps_.data(), samples_.data());
  for (std::size_t i = 0; i < points_.size(); ++i) values_[i] = samples_[i].value;
  const ClippedIntegral all = sum(frame);
  write_gradient(pair, frame, all.energy, gradient);
  if (hessian) write_hessian(pair, frame, law, *hessian);
  return all;
}

void ClipIntegrator::write_gradient(const ClippedPair& pair, const Frame& frame, double energy, Vec18& gradient) {
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& p = points_[i];
    const LawSample& law = samples_[i];
    const double factor = frame.facing.value * p.weight;
    for (int m = 0; m < 3; ++m) {
      ClipNode& node = tape_.nodes[p.nodes[m]];
      const Vec3 &next = tape_.nodes[p.nodes[(m + 1) % 3]].at, &last = tape_.nodes[p.nodes[(m + 2) % 3]].at;
      const double by_area = factor * p.rho * law.value;
      node.slope += Vec3(0.5 * by_area * (next.y() - last.y()), 0.5 * by_area * (last.x() - next.x()),
                         factor * p.area * p.rho * law.slope * p.share[m]);
    }
    for (int k = 0; k < 3; ++k) {
      if (!(pair.strip_b[k] > 0)) continue;
      const BoundaryWeight weight = BoundaryWeight::at(tape_.lines[k].distance(p.at) / pair.strip_b[k]);
      if (weight.slope == 0) continue;
      double others = 1;
      for (int m = 0; m < 3; ++m)
        if (m != k && pair.strip_b[m] > 0)
          others *= BoundaryWeight::at(tape_.lines[m].distance(p.at) / pair.strip_b[m]).value;
      const double by_distance = factor * p.area * law.value * others * weight.slope / pair.strip_b[k];
      const Vec2 by_point = tape_.lines[k].add_slope(p.at, by_distance);
      for (int m = 0; m < 3; ++m) tape_.nodes[p.nodes[m]].slope.head<2>() += p.share[m] * by_point;
    }
  }
  tape_.pass_back();

  std::array<Vec3, 6> local;  // derivatives by the local coordinates
  for (int k = 0; k < 3; ++k) {
    local[k] = tape_.nodes[2 - k].slope;
    const PlaneLine &from = tape_.lines[k], &to = tape_.lines[(k + 2) % 3];
    local[3 + k] << from.slope_begin + to.slope_end, 0;
  }
  // The frame turns with b: the moment of the local derivatives acts on the corners of b.
  Vec3 moment = Vec3::Zero();
  for (int k = 0; k < 6; ++k) moment += (k < 3 ? frame.a[k] : frame.b[k - 3]).cross(local[k]);
  const double length = frame.b[1].x(), foot = frame.b[2].x(), height = frame.b[2].y();
  Vec3 by_1 = local[4], by_2 = local[5];
  by_1.y() -= moment.z() / length;
  by_1.z() += moment.y() / length + moment.x() * foot / (length * height);
  by_2.z() -= moment.x() / height;
  for (int k = 0; k < 3; ++k) gradient.segment<3>(3 * k) = frame.axes * local[k];
  gradient.segment<3>(12) = frame.axes * by_1;
  gradient.segment<3>(15) = frame.axes * by_2;
  gradient.segment<3>(9) =
      -(gradient.segment<3>(0) + gradient.segment<3>(3) + gradient.segment<3>(6) + gradient.segment<3>(12) + gradient.segment<3>(15));
  if (frame.facing.slope == 0 || frame.facing.value == 0) return;
  const double by_cosine = energy / frame.facing.value * frame.facing.slope;
  add_normal_slope(pair.a, frame.normal_a, frame.twice_area_a, frame.normal_b, -by_cosine, gradient.data());
  add_normal_slope(pair.b, frame.normal_b, frame.twice_area_b, frame.normal_a, -by_cosine, gradient.data() + 9);
}

void ClipIntegrator::write_hessian(const ClippedPair& pair, const Frame& frame, const PairLaw& law,
                                   Mat18& hessian) const {
  using Vec6 = Eigen::Matrix<double, 6, 1>;
  using Mat6 = Eigen::Matrix<double, 6, 6>;
  // Motion of a relative to b at a point of the plane: sum of the six numbers times the corners'.
  const double twice_projected = twice_area_of(frame.a[0], frame.a[1], frame.a[2]);
  const auto relative = [&](const Vec3& at) {
    Vec6 v;
    for (int k = 0; k < 3; ++k)
      v[k] = twice_area_of(at, frame.a[(k + 1) % 3], frame.a[(k + 2) % 3]) / twice_projected;
    const double across = at.y() / frame.b[2].y();
    const double along = (at.x() - across * frame.b[2].x()) / frame.b[1].x();
    v.tail<3>() << along + across - 1, -along, -across;
    return v;
  };
  const auto add = [&](const Mat6& scalar, const Vec3& direction) {
    const Mat3 outer = direction * direction.transpose();
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) hessian.block<3, 3>(3 * i, 3 * j) += scalar(i, j) * outer;
  };
  Mat6 normal = Mat6::Zero();
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const Point& p = points_[i];
    const double stiffness = frame.facing.value * p.weight * p.area * p.rho * samples_[i].curvature;
    if (!(stiffness > 0)) continue;
    const Vec6 v = relative(p.at);
    normal += stiffness * v * v.transpose();
  }
  add(normal, frame.normal_b);

  for (const ClipPiece& piece : pieces_)
    for (std::size_t i = 0; i < piece.size(); ++i) {
      if (piece[i].side < 0 || !pair.boundary_a[piece[i].side]) continue;
      const Vec3 &p = tape_.nodes[piece[i].node].at, &q = tape_.nodes[piece[(i + 1) % piece.size()].node].at;
      const Vec2 along = (q - p).head<2>();
      const double length = along.norm();
      if (!(length > 0)) continue;
      const Vec2 outward = Vec2(along.y(), -along.x()) / length;
      Mat6 edge = Mat6::Zero();
      for (const double t : {0.5 - std::sqrt(1.0 / 12), 0.5 + std::sqrt(1.0 / 12)}) {
        const Vec3 at = p + t * (q - p);
        double slope = 0;
        for (int k = 0; k < 3; ++k)
          if (pair.strip_b[k] > 0)
            slope += BoundaryWeight::at(tape_.lines[k].distance(at) / pair.strip_b[k]).slope / pair.strip_b[k] *
                     tape_.lines[k].inward.dot(outward);
        const double stiffness = 0.5 * length * frame.facing.value * law.at(at.z()).value * slope;
        if (!(stiffness > 0)) continue;
        const Vec6 v = relative(at);
        edge += stiffness * v * v.transpose();
      }
      add(edge, frame.axes.leftCols<2>() * outward);
    }
}

}  // namespace tack
