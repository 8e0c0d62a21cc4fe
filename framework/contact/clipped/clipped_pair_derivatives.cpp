// Gradient and Hessian of the clipped integral of two triangles.
#include <Eigen/Geometry>

#include <bit>
#include <cmath>

#include "framework/contact/clipped/boundary_weight.hpp"
#include "framework/contact/clipped/clipped_pair.hpp"
#include "framework/contact/clipped/gauss_rules.hpp"

namespace tack {
namespace {

// Adds factor times the derivative of n . v by the corners of a triangle with unit normal n, for a
// fixed v; twice_area: of the triangle.
void add_normal_slope(const std::array<Vec3, 3>& x, const Vec3& n, double twice_area, const Vec3& v, double factor,
                      double* gradient) {
  const Vec3 across = (v - v.dot(n) * n) * (factor / twice_area);
  const Vec3 by_1 = (x[2] - x[0]).cross(across), by_2 = across.cross(x[1] - x[0]);
  Eigen::Map<Vec3>(gradient) -= by_1 + by_2;
  Eigen::Map<Vec3>(gradient + 3) += by_1;
  Eigen::Map<Vec3>(gradient + 6) += by_2;
}

PlaneCorner between(const PlaneCorner& p, const PlaneCorner& q, double t) {
  PlaneCorner at = p;
  at.x += t * (q.x - p.x);
  at.y += t * (q.y - p.y);
  at.gap += t * (q.gap - p.gap);
  for (int k = 0; k < 3; ++k) at.share[k] += t * (q.share[k] - p.share[k]);
  return at;
}

}  // namespace

ClippedIntegral ClipIntegrator::derivatives(const ClippedPair& pair, const PairLaw& law, const GapBands& bands,
                                            Vec18& gradient, Mat18* hessian) {
  gradient.setZero();
  if (hessian) hessian->setZero();
  if (!prepare(pair, bands)) return {};
  values_.resize(gaps_.size());
  samples_.resize(gaps_.size());
  law.samples(static_cast<int>(gaps_.size()), gaps_.data(), samples_.data());
  int i = 0;
  for (Band& band : bands_) {
    if (band.empty()) continue;
    const LawSample &low = samples_[i], &high = samples_[i + 1];
    values_[i++] = low.value;
    values_[i++] = high.value;
    band.stiffness = 0.5 * (low.curvature + high.curvature);
    // Where the deviation is round-off, so is the effect of the curvature.
    band.curvature = band.deviation > 0 ? (high.slope - low.slope) / (2 * band.deviation) : band.stiffness;
    band.slope = 0.5 * (low.slope + high.slope);
    band.constant = 0.5 * (low.value + high.value - band.curvature * band.deviation * band.deviation);
  }
  ClippedIntegral all = sum();
  for (const Band& band : bands_)
    if (band.excess != 0) all.energy += facing_ * (band.excess * band.slope + 0.5 * band.second_excess * band.stiffness);

  const Vec2 first = (a_[1] - a_[0]).head<2>(), second = (a_[2] - a_[0]).head<2>();
  const double rise1 = a_[1].z() - a_[0].z(), rise2 = a_[2].z() - a_[0].z();
  gap_slope_ = Vec2(rise1 * second.y() - rise2 * first.y(), rise2 * first.x() - rise1 * second.x()) / (first.x() * second.y() - first.y() * second.x());
  Slopes slopes;
  slopes.a.fill(Vec3::Zero());
  slopes.b.fill(Vec2::Zero());
  add_gap_slopes(slopes);
  for (int p = 0; p < piece_count_; ++p) {
    if (pieces_[p].band < 0) continue;
    add_side_slopes(pair, pieces_[p], slopes);
    if (pieces_[p].strips != 0) add_strip_slopes(pair, pieces_[p], slopes);
  }
  for (Vec3& by_a : slopes.a) by_a.head<2>() -= by_a.z() * gap_slope_;
  write_gradient(pair, slopes, all.energy, gradient);
  if (hessian) write_hessian(pair, *hessian);
  return all;
}

// Adds int of rho h' times each share of a, over S as it is.
void ClipIntegrator::add_gap_slopes(Slopes& slopes) const {
  const double rise1 = a_[1].z() - a_[0].z(), rise2 = a_[2].z() - a_[0].z();
  for (const Band& band : bands_) {
    const double first = band.slope * band.first + band.area * band.curvature * (rise1 * band.first_first + rise2 * band.first_second);
    const double second = band.slope * band.second + band.area * band.curvature * (rise1 * band.first_second + rise2 * band.second_second);
    slopes.a[0].z() += band.area * band.slope - first - second;
    slopes.a[1].z() += first;
    slopes.a[2].z() += second;
  }
}

// Adds int of rho h v along the sides of a piece, v: their velocity outwards.
void ClipIntegrator::add_side_slopes(const ClippedPair& pair, const Piece& piece, Slopes& slopes) const {
  const Band& band = bands_[piece.band];
  const SegmentRule& rule = rules_in_strips(std::popcount(piece.strips)).segment;
  for (int i = 0; i < piece.polygon.size(); ++i) {
    const PlaneCorner &p = piece.polygon[i], &q = piece.polygon.after(i);
    const int line = p.side - PlaneSide::line_of_b;
    // rho is zero on a boundary edge of b.
    if (p.side == PlaneSide::interior || (line >= 0 && line < 3 && pair.strip_b[line] > 0)) continue;
    std::array<double, 3> by_share{};
    double by_begin = 0, by_end = 0;
    for (std::size_t j = 0; j < rule.at.size(); ++j) {
      const PlaneCorner at = between(p, q, rule.at[j]);
      double weight = rule.weight[j] * band.h(at.gap);
      for (int k = 0; k < 3; ++k)
        if (piece.strips >> k & 1) weight *= BoundaryWeight::value_in_strip(plane_.lines[k].distance(at.x, at.y) / pair.strip_b[k]);
      if (line < 0 || p.side == PlaneSide::level) {
        for (int k = 0; k < 3; ++k) by_share[k] += weight * at.share[k];
      } else {
        const double fraction = plane_.lines[line].fraction(at.x, at.y);
        by_begin += weight * (1 - fraction);
        by_end += weight * fraction;
      }
    }
    const Vec2 outward(q.y - p.y, p.x - q.x);  // times the length of the side
    if (line < 0) {
      const int next = (p.side + 1) % 3;
      slopes.a[p.side].head<2>() += by_share[p.side] * outward;
      slopes.a[next].head<2>() += by_share[next] * outward;
    } else if (p.side == PlaneSide::level) {
      // The side moves where the gap changes: v = -dg / (slope of the gap outwards).
      const double rise = gap_slope_.dot(outward);
      for (int k = 0; rise != 0 && k < 3; ++k) slopes.a[k].z() -= outward.squaredNorm() / rise * by_share[k];
    } else {
      slopes.b[line] += by_begin * outward;
      slopes.b[(line + 1) % 3] += by_end * outward;
    }
  }
}

// Adds int of h d rho over a piece: a strip moves with its line.
void ClipIntegrator::add_strip_slopes(const ClippedPair& pair, const Piece& piece, Slopes& slopes) const {
  const Band& band = bands_[piece.band];
  const TriangleRule& rule = rules_in_strips(std::popcount(piece.strips)).triangle;
  const int points = static_cast<int>(rule.weight.size());
  const PlaneCorner& o = piece.polygon[0];
  for (int i = 1; i + 1 < piece.polygon.size(); ++i) {
    const PlaneCorner &p = piece.polygon[i], &q = piece.polygon[i + 1];
    const double area = 0.5 * ((p.x - o.x) * (q.y - o.y) - (p.y - o.y) * (q.x - o.x));
    std::array<double, TriangleRule::points_max> h;
    for (int j = 0; j < points; ++j)
      h[j] = area * rule.weight[j] * band.h(o.gap + rule.first[j] * (p.gap - o.gap) + rule.second[j] * (q.gap - o.gap));
    std::array<std::array<double, TriangleRule::points_max>, 3> t;
    for (int k = 0; k < 3; ++k) {
      if ((piece.strips >> k & 1) == 0) continue;
      const ClipPlane::Line& line = plane_.lines[k];
      const double from = line.distance(o.x, o.y) / pair.strip_b[k], to_p = line.distance(p.x, p.y) / pair.strip_b[k] - from,
                   to_q = line.distance(q.x, q.y) / pair.strip_b[k] - from;
      for (int j = 0; j < points; ++j) t[k][j] = from + rule.first[j] * to_p + rule.second[j] * to_q;
    }
    for (int k = 0; k < 3; ++k) {
      if ((piece.strips >> k & 1) == 0) continue;
      const ClipPlane::Line& line = plane_.lines[k];
      const double from = line.fraction(o.x, o.y), to_p = line.fraction(p.x, p.y) - from, to_q = line.fraction(q.x, q.y) - from;
      double all = 0, at_end = 0;
      for (int j = 0; j < points; ++j) {
        double weight = h[j] * BoundaryWeight::slope_in_strip(t[k][j]);
        for (int m = 0; m < 3; ++m)
          if (m != k && (piece.strips >> m & 1)) weight *= BoundaryWeight::value_in_strip(t[m][j]);
        all += weight;
        at_end += weight * (from + rule.first[j] * to_p + rule.second[j] * to_q);
      }
      const Vec2 inward = line.inward() / pair.strip_b[k];
      slopes.b[k] -= (all - at_end) * inward;
      slopes.b[(k + 1) % 3] -= at_end * inward;
    }
  }
}

void ClipIntegrator::write_gradient(const ClippedPair& pair, const Slopes& slopes, double energy, Vec18& gradient) const {
  // The local axes turn with b: the moment of the local derivatives acts on the corners of b.
  Vec3 moment = Vec3::Zero();
  for (int k = 0; k < 3; ++k) {
    const Vec2 &at = plane_.local[k], &by = slopes.b[k];
    moment += a_[k].cross(slopes.a[k]);
    moment.z() += at.x() * by.y() - at.y() * by.x();
  }
  const double length = plane_.local[1].x(), foot = plane_.local[2].x(), height = plane_.local[2].y();
  const Vec3 by_1(slopes.b[1].x(), slopes.b[1].y() - moment.z() / length, moment.y() / length + moment.x() * foot / (length * height));
  const Vec3 by_2(slopes.b[2].x(), slopes.b[2].y(), -moment.x() / height);
  for (int k = 0; k < 3; ++k) gradient.segment<3>(3 * k) = plane_.axes * (facing_ * slopes.a[k]);
  gradient.segment<3>(12) = plane_.axes * (facing_ * by_1);
  gradient.segment<3>(15) = plane_.axes * (facing_ * by_2);
  gradient.segment<3>(9) = -(gradient.segment<3>(0) + gradient.segment<3>(3) + gradient.segment<3>(6) + gradient.segment<3>(12) + gradient.segment<3>(15));
  if (facing_slope_ == 0 || facing_ == 0) return;
  const double by_cosine = energy / facing_ * facing_slope_;
  const Vec3 normal_b = plane_.axes.col(2);
  add_normal_slope(pair.a, normal_a_, twice_area_a_, normal_b, -by_cosine, gradient.data());
  add_normal_slope(pair.b, normal_b, plane_.twice_area, normal_a_, -by_cosine, gradient.data() + 9);
}

// Motion of a relative to b: at a point of the plane with the shares s of the corners of a, the
// corners of both count by the shares and by minus those in b, which are linear in s.
void ClipIntegrator::write_hessian(const ClippedPair& pair, Mat18& hessian) const {
  using Mat63 = Eigen::Matrix<double, 6, 3>;
  Mat63 relative;
  relative.topRows<3>().setIdentity();
  for (int k = 0; k < 3; ++k) relative.col(k).tail<3>() = -plane_.shares(a_[k].x(), a_[k].y());

  Mat3 moments = Mat3::Zero();  // int of the curvature times products of shares
  for (const Band& band : bands_) {
    if (!(band.area > 0) || !(band.stiffness > 0)) continue;
    const double weight = facing_ * band.area * band.stiffness;
    const Vec3 mean = Vec3(band.area - band.first - band.second, band.first, band.second) / band.area;
    const double across1 = -band.first_first - band.first_second, across2 = -band.first_second - band.second_second;
    Mat3 covariance;
    covariance << -across1 - across2, across1, across2,
                  across1, band.first_first, band.first_second,
                  across2, band.first_second, band.second_second;
    moments += weight * (mean * mean.transpose() + covariance);
  }
  const Eigen::Matrix<double, 6, 6> normal = relative * moments * relative.transpose();
  const Vec3 n = plane_.axes.col(2);
  const Mat3 outer = n * n.transpose();
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j < 6; ++j) hessian.block<3, 3>(3 * i, 3 * j) = normal(i, j) * outer;

  for (int number = 0; number < piece_count_; ++number) {
    const Piece& piece = pieces_[number];
    if (piece.strips == 0 || piece.band < 0) continue;
    const Band& band = bands_[piece.band];
    const SegmentRule& rule = rules_in_strips(0).segment;
    for (int i = 0; i < piece.polygon.size(); ++i) {
      const PlaneCorner &p = piece.polygon[i], &q = piece.polygon.after(i);
      if (p.side >= 3 || !pair.boundary_a[p.side]) continue;
      const Vec2 outward(q.y - p.y, p.x - q.x);
      const double length = outward.norm();
      if (!(length > 0)) continue;
      Mat3 edge = Mat3::Zero();
      for (std::size_t j = 0; j < rule.at.size(); ++j) {
        const PlaneCorner at = between(p, q, rule.at[j]);
        double slope = 0;
        for (int k = 0; k < 3; ++k)
          if (piece.strips >> k & 1)
            slope += BoundaryWeight::slope_in_strip(plane_.lines[k].distance(at.x, at.y) / pair.strip_b[k]) / pair.strip_b[k] * plane_.lines[k].inward().dot(outward) / length;
        const double stiffness = rule.weight[j] * length * facing_ * band.h(at.gap) * slope;
        if (!(stiffness > 0)) continue;
        const Vec3 share(at.share[0], at.share[1], at.share[2]);
        edge += stiffness * share * share.transpose();
      }
      const Eigen::Matrix<double, 6, 6> scalar = relative * edge * relative.transpose();
      const Vec3 direction = plane_.axes.leftCols<2>() * outward / length;
      const Mat3 along = direction * direction.transpose();
      for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) hessian.block<3, 3>(3 * r, 3 * c) += scalar(r, c) * along;
    }
  }
}

}  // namespace tack
