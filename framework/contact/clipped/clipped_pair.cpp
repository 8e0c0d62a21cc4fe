#include "framework/contact/clipped/clipped_pair.hpp"

#include <Eigen/Geometry>

#include <algorithm>
#include <bit>
#include <cmath>

#include "framework/contact/clipped/boundary_weight.hpp"
#include "framework/contact/clipped/gauss_rules.hpp"
#include "framework/contact/laws/law_peak.hpp"

namespace tack {
namespace {

// Distance of a corner of a from a line of b, per length of that edge, at which it counts as on the
// line. It then belongs to one of the two triangles there, so that where edges coincide, round-off
// decides nothing and nothing is lost.
constexpr double on_line_ratio = 1e-8;
// Distance of a crossing from a line per its length, and of a mean gap from all gaps per these, below
// which they differ by round-off.
constexpr double round_off = 1e-12;
// Spread of gaps or distances beyond a cut, per width of the band or strip, below which a piece is
// not cut. The force of a level is the difference of two parabolas over the slope of the gap, which
// has no accurate digits on a gap that is even up to round-off.
constexpr double cut_ratio_min = 1e-6;

// Bands of gaps are halved until the law differs from its parabola (through both ends and the
// middle) by at most these fractions of its energy at gap zero and of its largest traction, or
// until a band is so narrow, per range. Energies of tilted plates are off by less than 2e-4 then.
constexpr double energy_tolerance = 3e-4, traction_tolerance = 2e-2, band_width_min = 1.0 / 256;

double twice_area_of(const PlaneCorner& p, const PlaneCorner& q, const PlaneCorner& r) {
  return (q.x - p.x) * (r.y - p.y) - (q.y - p.y) * (r.x - p.x);
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

// Takes the plane of b and the local coordinates of a. Returns false if the two do not face each
// other.
bool ClipIntegrator::set(const ClippedPair& pair) {
  plane_.set(pair.b);
  const Vec3 cross_a = (pair.a[1] - pair.a[0]).cross(pair.a[2] - pair.a[0]);
  twice_area_a_ = cross_a.norm();
  if (!(twice_area_a_ > 0) || !(plane_.twice_area > 0)) return false;
  normal_a_ = cross_a / twice_area_a_;
  cosine_ = -normal_a_.dot(plane_.axes.col(2));
  if (!(cosine_ > clip_cosine_min)) return false;
  for (int k = 0; k < 3; ++k) a_[k] = plane_.to_local(pair.a[k]);
  return true;
}

bool ClipIntegrator::overlaps(const ClippedPair& pair, double range) {
  if (!set(pair)) return false;
  if (std::min({a_[0].z(), a_[1].z(), a_[2].z()}) >= range || std::max({a_[0].z(), a_[1].z(), a_[2].z()}) <= 0) return false;
  // Two triangles of a plane are apart if one of their six lines separates them.
  for (const ClipPlane::Line& line : plane_.lines) {
    double nearest = -1e300;
    for (const Vec3& corner : a_) nearest = std::max(nearest, line.distance(corner.x(), corner.y()));
    if (nearest < -on_line_ratio * line.length) return false;
  }
  for (int k = 0; k < 3; ++k) {
    // The corners of a are clockwise.
    const Vec2 from = a_[k].head<2>(), edge = from - a_[(k + 1) % 3].head<2>();
    double nearest = -1e300;
    for (const Vec2& corner : plane_.local)
      nearest = std::max(nearest, edge.x() * (corner.y() - from.y()) - edge.y() * (corner.x() - from.x()));
    if (nearest < -on_line_ratio * edge.squaredNorm()) return false;
  }
  return true;
}

// Clips the projection of a by the lines of b. Returns false if nothing is left.
bool ClipIntegrator::clip(const ClippedPair& pair) {
  // Seen from outside of b, the corners of a are clockwise.
  polygon_.clear();
  for (int k = 2; k >= 0; --k) polygon_.add({a_[k].x(), a_[k].y(), a_[k].z(), {k == 0 ? 1.0 : 0, k == 1 ? 1.0 : 0, k == 2 ? 1.0 : 0}, (k + 2) % 3, 0, 0});
  for (int k = 0; k < 3; ++k) {
    const ClipPlane::Line& line = plane_.lines[k];
    int outside = 0;
    for (int i = 0; i < 3; ++i) {
      const double distance = line.distance(polygon_[i].x, polygon_[i].y);
      if (std::abs(distance) < on_line_ratio * line.length) polygon_[i].ties |= 1u << k;
      if (distance < -on_line_ratio * line.length) ++outside;
    }
    if (outside == 3) return false;
    // An edge of a with a neighbour that lies along the line.
    for (int i = 0; i < 3; ++i) {
      const int next = (i + 1) % 3;
      if (pair.boundary_a[polygon_[i].side] || (polygon_[i].ties & polygon_[next].ties & 1u << k) == 0) continue;
      polygon_[i].along |= 1u << k;
      polygon_[next].along |= 1u << k;
    }
  }
  for (int k = 0; k < 3; ++k) {
    const ClipPlane::Line& line = plane_.lines[k];
    std::array<double, PlanePolygon::capacity> distance;
    std::array<bool, PlanePolygon::capacity> inside;
    bool all = true;
    for (int i = 0; i < polygon_.size(); ++i) {
      distance[i] = line.distance(polygon_[i].x, polygon_[i].y);
      const bool tie = (polygon_[i].ties >> k & 1) != 0 || std::abs(distance[i]) < round_off * line.length;
      inside[i] = tie ? pair.owns_b[k] : distance[i] > 0;
      // An edge of a along the line is cut at the line, even if it lies on the other side of it: what
      // this adds to one triangle at the line, also with the opposite sign, it takes from the other.
      if ((polygon_[i].along >> k & 1) == 0) distance[i] = inside[i] ? std::max(distance[i], 0.0) : std::min(distance[i], 0.0);
      all &= inside[i];
    }
    if (all) continue;
    cut_polygon(polygon_, distance.data(), inside.data(), PlaneSide::line_of_b + k, kept_, nullptr);
    if (kept_.empty()) return false;
    std::swap(polygon_, kept_);
  }
  return true;
}

ClipIntegrator::Piece& ClipIntegrator::next_piece() {
  if (piece_count_ == static_cast<int>(pieces_.size())) pieces_.emplace_back();
  return pieces_[piece_count_++];
}

// Makes the pieces of the polygon: cut where a strip ends, as rho is a polynomial in each of them.
void ClipIntegrator::cut_strips(const ClippedPair& pair) {
  piece_count_ = 0;
  Piece& whole = next_piece();
  whole.polygon = polygon_;
  whole.strips = 0;
  for (int k = 0; k < 3; ++k) {
    const double width = pair.strip_b[k];
    if (!(width > 0)) continue;
    for (int p = piece_count_ - 1; p >= 0; --p) {
      const PlanePolygon& polygon = pieces_[p].polygon;
      if (polygon.empty()) continue;
      std::array<double, PlanePolygon::capacity> distance;
      std::array<bool, PlanePolygon::capacity> beyond;
      int count = 0;
      for (int i = 0; i < polygon.size(); ++i) {
        distance[i] = plane_.lines[k].distance(polygon[i].x, polygon[i].y) - width;
        count += beyond[i] = distance[i] > -cut_ratio_min * width;
        if (beyond[i]) distance[i] = std::max(distance[i], 0.0);
      }
      if (count == polygon.size()) continue;
      if (count > 0) {
        cut_polygon(polygon, distance.data(), beyond.data(), PlaneSide::interior, kept_, &rest_);
        if (!kept_.empty()) {
          Piece& more = next_piece();
          more.polygon = kept_;
          more.strips = pieces_[p].strips;
        }
        pieces_[p].polygon = rest_;
      }
      pieces_[p].strips |= 1u << k;
    }
  }
}

// Puts the pieces in bands: cuts them at the levels, and leaves out gaps below the first and above
// the last. Bands are numbered from the lowest one that the polygon may reach.
void ClipIntegrator::cut_bands(const GapBands& bands) {
  double lowest = polygon_[0].gap, highest = lowest;
  for (int i = 1; i < polygon_.size(); ++i) {
    lowest = std::min(lowest, polygon_[i].gap);
    highest = std::max(highest, polygon_[i].gap);
  }
  const int levels = static_cast<int>(bands.size());
  // The last level below the polygon, and the first above it.
  const int begin = std::max(0, static_cast<int>(std::upper_bound(bands.begin(), bands.end(), lowest) - bands.begin()) - 1);
  const int end = std::min(levels - 1, static_cast<int>(std::lower_bound(bands.begin() + begin, bands.end(), highest) - bands.begin()));
  const int first = std::max(0, begin - 1);
  bands_.assign(std::max(1, end - first), Band());
  for (int p = 0, whole = piece_count_; p < whole; ++p) {
    pieces_[p].band = -1;
    if (pieces_[p].polygon.empty()) continue;
    double low = pieces_[p].polygon[0].gap, high = low;
    for (int i = 1; i < pieces_[p].polygon.size(); ++i) {
      low = std::min(low, pieces_[p].polygon[i].gap);
      high = std::max(high, pieces_[p].polygon[i].gap);
    }
    for (int l = begin; l < levels && high > bands.front(); ++l) {
      const double level = bands[l], least = l > 0 ? cut_ratio_min * (level - bands[l - 1]) : 0;
      if (high <= level + least) {
        pieces_[p].band = l - 1 - first;
        break;
      }
      if (low >= level - least) continue;
      const PlanePolygon& polygon = pieces_[p].polygon;
      std::array<double, PlanePolygon::capacity> distance;
      std::array<bool, PlanePolygon::capacity> above;
      for (int i = 0; i < polygon.size(); ++i) {
        distance[i] = polygon[i].gap - level;
        above[i] = distance[i] > 0;
      }
      cut_polygon(polygon, distance.data(), above.data(), PlaneSide::level, kept_, &rest_);
      if (l > 0 && !rest_.empty()) {
        Piece& below = next_piece();
        below.polygon = rest_;
        below.strips = pieces_[p].strips;
        below.band = l - 1 - first;
      }
      pieces_[p].polygon = kept_;
      if (kept_.empty()) break;
    }
  }
}

// Adds the moments of a piece to its band.
void ClipIntegrator::add_moments(const ClippedPair& pair, const Piece& piece) {
  Band& band = bands_[piece.band];
  const PlanePolygon& polygon = piece.polygon;
  for (int i = 0; i < polygon.size(); ++i) {
    band.low = std::min(band.low, polygon[i].gap);
    band.high = std::max(band.high, polygon[i].gap);
  }
  const PlaneCorner& o = polygon[0];
  for (int i = 1; i + 1 < polygon.size(); ++i) {
    const PlaneCorner &p = polygon[i], &q = polygon[i + 1];
    const double area = 0.5 * twice_area_of(o, p, q);
    const double o1 = o.share[1], p1 = p.share[1], q1 = q.share[1], o2 = o.share[2], p2 = p.share[2], q2 = q.share[2];
    if (piece.strips == 0) {
      const double sum1 = o1 + p1 + q1, sum2 = o2 + p2 + q2, twelfth = area / 12;
      band.area += area;
      band.first += area / 3 * sum1;
      band.second += area / 3 * sum2;
      band.first_first += twelfth * (sum1 * sum1 + o1 * o1 + p1 * p1 + q1 * q1);
      band.first_second += twelfth * (sum1 * sum2 + o1 * o2 + p1 * p2 + q1 * q2);
      band.second_second += twelfth * (sum2 * sum2 + o2 * o2 + p2 * p2 + q2 * q2);
      continue;
    }
    const TriangleRule& rule = rules_in_strips(std::popcount(piece.strips)).triangle;
    const int points = static_cast<int>(rule.weight.size());
    std::array<double, TriangleRule::points_max> weight;
    for (int j = 0; j < points; ++j) weight[j] = area * rule.weight[j];
    for (int k = 0; k < 3; ++k) {
      if ((piece.strips >> k & 1) == 0) continue;
      const ClipPlane::Line& line = plane_.lines[k];
      const double to_t = 1 / pair.strip_b[k], t = to_t * line.distance(o.x, o.y);
      const double tp = to_t * line.distance(p.x, p.y) - t, tq = to_t * line.distance(q.x, q.y) - t;
      for (int j = 0; j < points; ++j)
        weight[j] *= BoundaryWeight::value_in_strip(t + rule.first[j] * tp + rule.second[j] * tq);
    }
    double sums[6] = {};
    for (int j = 0; j < points; ++j) {
      const double w = weight[j], s1 = o1 + rule.first[j] * (p1 - o1) + rule.second[j] * (q1 - o1),
                   s2 = o2 + rule.first[j] * (p2 - o2) + rule.second[j] * (q2 - o2);
      sums[0] += w;
      sums[1] += w * s1;
      sums[2] += w * s2;
      sums[3] += w * s1 * s1;
      sums[4] += w * s1 * s2;
      sums[5] += w * s2 * s2;
    }
    band.area += sums[0];
    band.first += sums[1];
    band.second += sums[2];
    band.first_first += sums[3];
    band.first_second += sums[4];
    band.second_second += sums[5];
  }
}

// Turns moments into means and covariances, and finds the gaps at which the law is taken. Returns
// whether there is anything.
bool ClipIntegrator::find_gaps() {
  const double rise1 = a_[1].z() - a_[0].z(), rise2 = a_[2].z() - a_[0].z();
  const double slack = round_off * std::max({std::abs(a_[0].z()), std::abs(a_[1].z()), std::abs(a_[2].z())});
  gaps_.clear();
  for (Band& band : bands_) {
    if (band.empty()) continue;
    const double first_moment = band.area * a_[0].z() + rise1 * band.first + rise2 * band.second;
    band.mean = first_moment / band.area;
    if (band.mean >= band.low - slack && band.mean <= band.high + slack) {
      band.mean = std::clamp(band.mean, band.low, band.high);
      const double first = band.first / band.area, second = band.second / band.area;
      band.first_first = band.first_first / band.area - first * first;
      band.first_second = band.first_second / band.area - first * second;
      band.second_second = band.second_second / band.area - second * second;
      const double variance = rise1 * rise1 * band.first_first + 2 * rise1 * rise2 * band.first_second + rise2 * rise2 * band.second_second;
      band.deviation = std::sqrt(std::clamp(variance, 0.0, (band.high - band.mean) * (band.mean - band.low)));
    } else {
      // Slivers along a line, with areas of both signs: phi is the parabola at the mean.
      band.mean = 0.5 * (band.low + band.high);
      band.excess = first_moment - band.area * band.mean;
      const double z = a_[0].z() - band.mean;
      band.second_excess = z * (z * band.area + 2 * (rise1 * band.first + rise2 * band.second)) + rise1 * rise1 * band.first_first +
                           2 * rise1 * rise2 * band.first_second + rise2 * rise2 * band.second_second;
      band.first_first = band.first_second = band.second_second = 0;
    }
    gaps_.push_back(band.mean - band.deviation);
    gaps_.push_back(band.mean + band.deviation);
  }
  return !gaps_.empty();
}

// Finds the pieces of a pair, their moments and gaps. Returns false if there are none.
bool ClipIntegrator::prepare(const ClippedPair& pair, const GapBands& bands) {
  if (!set(pair)) return false;
  if (std::min({a_[0].z(), a_[1].z(), a_[2].z()}) >= bands.back() || std::max({a_[0].z(), a_[1].z(), a_[2].z()}) <= bands.front()) return false;
  if (!clip(pair)) return false;
  cut_strips(pair);
  cut_bands(bands);
  for (int p = 0; p < piece_count_; ++p)
    if (pieces_[p].band >= 0) add_moments(pair, pieces_[p]);
  if (!find_gaps()) return false;
  facing_ = 1;
  facing_slope_ = 0;
  if (cosine_ < clip_cosine_full) {
    constexpr double width = clip_cosine_full - clip_cosine_min;
    const double t = (cosine_ - clip_cosine_min) / width;
    facing_ = t * t * t * (10 - 15 * t + 6 * t * t);
    facing_slope_ = 30 * t * t * (1 - t) * (1 - t) / width;
  }
  return true;
}

ClippedIntegral ClipIntegrator::sum() const {
  ClippedIntegral all;
  std::array<double, 3> shares{};  // int of rho times the shares of a
  int i = 0;
  for (const Band& band : bands_) {
    if (band.empty()) continue;
    all.energy += 0.5 * band.area * (values_[i] + values_[i + 1]);
    i += 2;
    shares[0] += band.area - band.first - band.second;
    shares[1] += band.first;
    shares[2] += band.second;
  }
  all.energy *= facing_;
  double moment = 0;
  for (int k = 0; k < 3; ++k) {
    all.area_a[k] = facing_ * shares[k];
    moment += all.area_a[k] * a_[k].z();
    const Vec3 of_b = plane_.shares(a_[k].x(), a_[k].y());
    for (int j = 0; j < 3; ++j) all.area[j] += all.area_a[k] * of_b[j];
  }
  const double area = all.area_a[0] + all.area_a[1] + all.area_a[2];
  if (area > 0) all.gap = moment / area;
  return all;
}

ClippedIntegral ClipIntegrator::value(const ClippedPair& pair, const PairLaw& law, const GapBands& bands) {
  if (!prepare(pair, bands)) return {};
  values_.resize(gaps_.size());
  law.values(static_cast<int>(gaps_.size()), gaps_.data(), values_.data());
  ClippedIntegral all = sum();
  for (const Band& band : bands_) {
    if (band.excess == 0) continue;
    const LawSample sample = law.at(band.mean);
    all.energy += facing_ * (band.excess * sample.slope + 0.5 * band.second_excess * sample.curvature);
  }
  return all;
}

}  // namespace tack
