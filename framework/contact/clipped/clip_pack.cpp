#include "framework/contact/clipped/clip_pack.hpp"
#include "framework/contact/clipped/strip_integrals.hpp"

namespace tack {
namespace {

// Distance of a corner from a line, per length of the edge there, below which an edge of a may lie
// along the line (ClipIntegrator).
constexpr double near_ratio = 1e-8;
// The same, below which it is round-off.
constexpr double tie_ratio = 1e-13;
// Area of S over that of b, below which it may be a sliver along a line.
constexpr double sliver_ratio = 1e-9;
// Sine of the angle between edges that cross, above which both have the crossing at one point.
constexpr double crossing_sine_min = 1e-4;

// Area of S weighted by rho, over that without, below which rounding counts.
constexpr double weighted_area_min = 1e-3;

}  // namespace

void ClipPack::set(int lane, const VecX& x, const std::array<int, 6>& vertices, const std::array<double, 3>& strip_b, const std::array<bool, 3>& boundary_a, const std::array<bool, 3>& owns_b, bool two_sided_b) {
  for (int k = 0; k < 6; ++k)
    for (int d = 0; d < 3; ++d) corner_[3 * k + d][lane] = x[3 * vertices[k] + d];
  for (int k = 0; k < 3; ++k) {
    strip_[k][lane] = strip_b[k];
    boundary_[k][lane] = boundary_a[k];
    owns_[k][lane] = owns_b[k];
  }
  two_sided_b_[lane] = two_sided_b;
}

void ClipPack::shares(const Pack& x, const Pack& y, Pack& first, Pack& second) const {
  first = (of_a_[2].across_x * (y - of_a_[2].y) - of_a_[2].across_y * (x - of_a_[2].x)) * by_projected_;
  second = (of_a_[0].across_x * (y - of_a_[0].y) - of_a_[0].across_y * (x - of_a_[0].x)) * by_projected_;
}

// Finds the strip that S enters, and the part of each side in it. Lanes with several strips are not
// plain.
void ClipPack::find_strip(PackMask& plain) {
  Pack strip[3], entered[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k) std::memcpy(&strip[k], strip_[k], sizeof strip[k]);
  in_strip_ = strip_edge_[0] = strip_edge_[1] = strip_edge_[2] = PackMask{};
  if (!any((strip[0] > 0) | (strip[1] > 0) | (strip[2] > 0))) return;
  for (int k = 0; k < 3; ++k) edge_length_b_[k] = sqrt(of_b_[k].across_x * of_b_[k].across_x + of_b_[k].across_y * of_b_[k].across_y);
  for (int k = 0; k < 3; ++k)
    for_each_side([&](const Side& side) {
      // The corners of S are the begins of its sides.
      const Pack px = side.x + side.from * side.across_x, py = side.y + side.from * side.across_y;
      const Pack distance = of_b_[k].across_x * (py - of_b_[k].y) - of_b_[k].across_y * (px - of_b_[k].x);
      entered[k] = select((side.from < side.to) & (strip[k] > 0) & (distance < strip[k] * edge_length_b_[k]), Pack(1), entered[k]);
    });
  const Pack count = entered[0] + entered[1] + entered[2];
  plain &= count < 1.5;
  in_strip_ = (count > 0.5) & plain;
  if (!any(in_strip_)) return;
  inward_x_ = inward_y_ = 0;
  width_ = 1;
  Pack x = 0, y = 0;
  for (int k = 0; k < 3; ++k) {
    strip_edge_[k] = in_strip_ & (entered[k] > 0.5);
    inward_x_ = select(strip_edge_[k], -of_b_[k].across_y / edge_length_b_[k], inward_x_);
    inward_y_ = select(strip_edge_[k], of_b_[k].across_x / edge_length_b_[k], inward_y_);
    x = select(strip_edge_[k], of_b_[k].x, x);
    y = select(strip_edge_[k], of_b_[k].y, y);
    width_ = select(strip_edge_[k], strip[k], width_);
  }
  share_slope_1_ = (of_a_[2].across_x * inward_y_ - of_a_[2].across_y * inward_x_) * by_projected_;
  share_slope_2_ = (of_a_[0].across_x * inward_y_ - of_a_[0].across_y * inward_x_) * by_projected_;
  for_each_side([&](Side& side) {
    side.depth = inward_x_ * (side.x - x) + inward_y_ * (side.y - y);
    side.deepening = inward_x_ * side.across_x + inward_y_ * side.across_y;
    const Pack begin = width_ - side.depth, end = begin - side.deepening;
    const PackMask out_begin = begin <= 0, out_end = end <= 0;
    const Pack at = begin / select(out_begin ^ out_end, begin - end, 1);
    side.strip_from = select(out_begin, select(out_end, Pack(1), greater(side.from, at)), side.from);
    side.strip_to = select(out_end, select(out_begin, Pack(0), lesser(side.to, at)), side.to);
    side.strip_to = select(in_strip_, greater(side.strip_from, side.strip_to), side.strip_from);
  });
}

// o1, o2: shares that count as zero. moments: area, of both shares, of their squares and product.
void ClipPack::subtract_strip_moments(const Pack& o1, const Pack& o2, Pack* moments) {
  for_each_side([&](const Side& side) {
    // Inward component of the outward normal, times the length.
    const Pack outward = inward_x_ * side.across_y - inward_y_ * side.across_x;
    for_strip_points(side, [&](const Pack& at, const Pack& weight) {
      const Pack t = (side.depth + at * side.deepening) / width_, factor = weight * outward * width_;
      const Pack l0 = factor * weight_lost_0(t), l1 = factor * width_ * weight_lost_1(t), l2 = factor * width_ * width_ * weight_lost_2(t);
      Pack s1, s2;
      shares(side.x + at * side.across_x, side.y + at * side.across_y, s1, s2);
      s1 -= o1, s2 -= o2;
      moments[0] -= l0;
      moments[1] -= l0 * s1 + l1 * share_slope_1_;
      moments[2] -= l0 * s2 + l1 * share_slope_2_;
      moments[3] -= l0 * s1 * s1 + 2 * l1 * s1 * share_slope_1_ + l2 * share_slope_1_ * share_slope_1_;
      moments[4] -= l0 * s1 * s2 + l1 * (s1 * share_slope_2_ + s2 * share_slope_1_) + l2 * share_slope_1_ * share_slope_2_;
      moments[5] -= l0 * s2 * s2 + 2 * l1 * s2 * share_slope_2_ + l2 * share_slope_2_ * share_slope_2_;
    });
  });
}

// Finds which corners are outside of the lines of the other triangle. Where an edge of a lies along a
// line of b, the owner of the line decides, not the signs of distances: the edge of a is a side of S
// if b owns the line, otherwise that of b is. Returns the lanes with corners near lines.
PackMask ClipPack::find_outside(const Pack* square_a, const Pack* square_b, const Pack (&of_a)[3][3], const Pack (&of_b)[3][3], Outside& outside, PackMask& plain) const {
  PackMask near{}, near_a[3][3];
  for (int k = 0; k < 3; ++k)
    for (int e = 0; e < 3; ++e) {
      outside.a[k][e] = of_a[k][e] < 0;
      outside.b[k][e] = of_b[k][e] < 0;
      near_a[k][e] = abs(of_a[k][e]) <= near_ratio * square_b[e];
      near |= near_a[k][e] | (abs(of_b[k][e]) <= near_ratio * square_a[e]);
    }
  if (!any(near)) return near;
  for (int line = 0; line < 3; ++line) {
    Pack owns;
    std::memcpy(&owns, owns_[line], sizeof owns);
    const PackMask owned = owns > 0.5;
    for (int e = 0; e < 3; ++e) {
      const int n = (e + 1) % 3;
      const PackMask along = near_a[e][line] & near_a[n][line], inside = of_a[(e + 2) % 3][line] > 0;
      for (const int k : {e, n}) outside.a[k][line] = (along & ~owned) | (~along & outside.a[k][line]);
      for (const int k : {line, (line + 1) % 3}) outside.b[k][e] = (along & ~(owned ^ inside)) | (~along & outside.b[k][e]);
      // A sliver along the line, and a boundary edge that is not cut at the line itself.
      Pack boundary;
      std::memcpy(&boundary, boundary_[e], sizeof boundary);
      const Pack tie = tie_ratio * square_b[line];
      plain &= ~(along & owned & ~inside);
      plain &= ~(along & ~owned & (boundary > 0.5) & ((of_a[e][line] > tie) | (of_a[n][line] > tie)));
    }
  }
  return near;
}

// Finds the parts of the edges that bound S. Returns the lanes with corners near lines.
PackMask ClipPack::cut_sides(PackMask& plain) {
  // Distances of the corners of a from the lines of b, positive inside and times the length of the
  // edge.
  Pack square_a[3], square_b[3], of_a[3][3], of_b[3][3];
  PackMask not_inside{};
  for (int e = 0; e < 3; ++e) {
    const Side& sb = of_b_[e];
    square_b[e] = sb.across_x * sb.across_x + sb.across_y * sb.across_y;
    for (int k = 0; k < 3; ++k) {
      of_a[k][e] = sb.across_x * (y_[k] - sb.y) - sb.across_y * (x_[k] - sb.x);
      not_inside |= of_a[k][e] <= near_ratio * square_b[e];
    }
  }
  a_inside_ = !any(not_inside);
  if (a_inside_) return not_inside;

  // The same of the corners of b and the lines of a, and shares of the corners of b in a: corner k of a
  // lies opposite edge k + 1.
  for (int e = 0; e < 3; ++e) {
    const Side& sa = of_a_[e];
    square_a[e] = sa.across_x * sa.across_x + sa.across_y * sa.across_y;
    for (int k = 0; k < 3; ++k) of_b[k][e] = sa.across_x * (of_b_[k].y - sa.y) - sa.across_y * (of_b_[k].x - sa.x);
  }
  for (int k = 0; k < 3; ++k) {
    of_b_[k].gap = 0;
    for (int m = 0; m < 3; ++m) of_b_[k].gap += of_b[k][(m + 1) % 3] * by_projected_ * z_[m];
  }
  for (int e = 0; e < 3; ++e) of_b_[e].rise = of_b_[(e + 1) % 3].gap - of_b_[e].gap;

  // The distances of both ends of an edge of a from a line of b differ by the cross product of both
  // edges, and so do, with the other sign, those of that edge of b from the line of a.
  Pack by_cross[3][3];
  PackMask steep[3][3];
  for (int e = 0; e < 3; ++e)
    for (int line = 0; line < 3; ++line) {
      const Pack cross_of_edges = of_a[(e + 1) % 3][line] - of_a[e][line], square = cross_of_edges * cross_of_edges;
      steep[e][line] = square > crossing_sine_min * crossing_sine_min * square_a[e] * square_b[line];
      by_cross[e][line] = 1 / select(square > 0, cross_of_edges, 1);
    }
  Outside outside;
  const PackMask near = find_outside(square_a, square_b, of_a, of_b, outside, plain);
  // Edges are cut at lines, or prolonged up to them: positions below 0 and above 1.
  const auto cut = [](Side& side, const PackMask& out_begin, const PackMask& out_end, const Pack& at) {
    side.from = select(out_begin, select(out_end, Pack(1), greater(side.from, at)), side.from);
    side.to = select(out_end, select(out_begin, Pack(0), lesser(side.to, at)), side.to);
  };
  constexpr double not_cut_begin = -1, not_cut_end = 2;
  for (int e = 0; e < 3; ++e) {
    const int n = (e + 1) % 3;
    Side &sa = of_a_[e], &sb = of_b_[e];
    sa.from = sb.from = not_cut_begin;
    sa.to = sb.to = not_cut_end;
    for (int line = 0; line < 3; ++line) {
      plain &= steep[e][line] | ~((outside.a[n][line] ^ outside.a[e][line]) | (outside.b[line][e] ^ outside.b[(line + 1) % 3][e]));
      cut(sa, outside.a[n][line], outside.a[e][line], of_a[n][line] * by_cross[e][line]);
      cut(sb, outside.b[e][line], outside.b[n][line], -of_b[e][line] * by_cross[line][e]);
    }
    for (Side* side : {&sa, &sb}) {
      side->from = select(side->from <= not_cut_begin, 0, side->from);
      side->to = greater(side->from, select(side->to < not_cut_end, side->to, 1));
    }
  }
  return near;
}

unsigned ClipPack::clip(const GapBands& bands) {
  Pack c[18];
  for (int i = 0; i < 18; ++i) std::memcpy(&c[i], corner_[i], sizeof c[i]);
  const Pack *a = c, *b = c + 9;
  const auto cross = [](const Pack* p, const Pack* q, Pack* out) {
    out[0] = p[1] * q[2] - p[2] * q[1];
    out[1] = p[2] * q[0] - p[0] * q[2];
    out[2] = p[0] * q[1] - p[1] * q[0];
  };
  const auto dot = [](const Pack* p, const Pack* q) { return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]; };

  Pack e1[3], e2[3], normal[3], f1[3], f2[3], normal_a[3];
  for (int d = 0; d < 3; ++d) {
    e1[d] = b[3 + d] - b[d];
    e2[d] = b[6 + d] - b[d];
    f1[d] = a[3 + d] - a[d];
    f2[d] = a[6 + d] - a[d];
  }
  cross(e1, e2, normal);
  cross(f1, f2, normal_a);
  const Pack twice_area = sqrt(dot(normal, normal));
  length_ = sqrt(dot(e1, e1));
  PackMask plain = twice_area > 0;
  const Pack by_area = 1 / select(plain, twice_area, 1), by_length = 1 / select(plain, length_, 1);
  for (int d = 0; d < 3; ++d) {
    axes_[2][d] = normal[d] * by_area;
    axes_[0][d] = e1[d] * by_length;
  }
  cross(axes_[2], axes_[0], axes_[1]);
  const Pack facing = -dot(normal_a, axes_[2]);
  plain &= (facing > 0) & (facing * facing > clip_cosine_full * clip_cosine_full * dot(normal_a, normal_a));
  height_ = twice_area * by_length;
  foot_ = dot(axes_[0], e2);
  for (int k = 0; k < 3; ++k) {
    Pack from_b[3];
    for (int d = 0; d < 3; ++d) from_b[d] = a[3 * k + d] - b[d];
    x_[k] = dot(axes_[0], from_b);
    y_[k] = dot(axes_[1], from_b);
    z_[k] = dot(axes_[2], from_b);
  }
  Pack two_sided_b;
  std::memcpy(&two_sided_b, two_sided_b_, sizeof two_sided_b);
  plain &= ~((two_sided_b > 0.5) & (z_[0] + z_[1] + z_[2] < 0));

  const Pack bx[3] = {0, length_, foot_}, by[3] = {0, 0, height_};
  for (int e = 0; e < 3; ++e) {
    const int n = (e + 1) % 3;
    // Seen from outside of b, the corners of a are clockwise: its edges run from corner e + 1 to e.
    Side& sa = of_a_[e];
    sa.x = x_[n], sa.y = y_[n], sa.gap = z_[n];
    sa.across_x = x_[e] - x_[n], sa.across_y = y_[e] - y_[n], sa.rise = z_[e] - z_[n];
    sa.from = 0, sa.to = 1;
    Side& sb = of_b_[e];
    sb.x = bx[e], sb.y = by[e];
    sb.across_x = bx[n] - bx[e], sb.across_y = by[n] - by[e];
  }
  const Pack twice_projected = of_a_[0].across_x * (y_[2] - y_[1]) - of_a_[0].across_y * (x_[2] - x_[1]);
  by_projected_ = 1 / select(plain, twice_projected, 1);
  const PackMask near = cut_sides(plain);

  // The common point: the mean of the corners of S, which are the begins of its sides.
  Pack ox = 0, oy = 0, count = 0, low = 1e300, high = -1e300;
  for_each_side([&](const Side& side) {
    const PackMask some = side.from < side.to;
    const Pack one = select(some, Pack(1), 0), gap = side.gap + side.from * side.rise;
    ox += one * (side.x + side.from * side.across_x);
    oy += one * (side.y + side.from * side.across_y);
    count += one;
    low = select(some, lesser(low, gap), low);
    high = select(some, greater(high, gap), high);
  });
  find_strip(plain);
  const Pack by_count = 1 / greater(count, 1);
  ox *= by_count;
  oy *= by_count;

  Pack area = 0, x = 0, y = 0, xx = 0, xy = 0, yy = 0;  // from the common point
  for_each_side([&](const Side& side) {
    const Pack px = side.x - ox + side.from * side.across_x, py = side.y - oy + side.from * side.across_y;
    const Pack qx = side.x - ox + side.to * side.across_x, qy = side.y - oy + side.to * side.across_y;
    const Pack twice = px * qy - py * qx, sum_x = px + qx, sum_y = py + qy;
    area += twice;
    x += twice * sum_x;
    y += twice * sum_y;
    xx += twice * (sum_x * sum_x + px * px + qx * qx);
    xy += twice * (sum_x * sum_y + px * py + qx * qy);
    yy += twice * (sum_y * sum_y + py * py + qy * qy);
  });
  area *= 0.5;
  x *= 1.0 / 6, y *= 1.0 / 6;
  xx *= 1.0 / 24, xy *= 1.0 / 24, yy *= 1.0 / 24;
  // Shares of corners 1 and 2 of a: at the common point, and their slopes.
  Pack o1, o2;
  shares(ox, oy, o1, o2);
  const Pack x1 = -of_a_[2].across_y * by_projected_, y1 = of_a_[2].across_x * by_projected_;
  const Pack x2 = -of_a_[0].across_y * by_projected_, y2 = of_a_[0].across_x * by_projected_;
  Pack moments[6] = {area,
                     x1 * x + y1 * y,
                     x2 * x + y2 * y,
                     x1 * x1 * xx + 2 * x1 * y1 * xy + y1 * y1 * yy,
                     x1 * x2 * xx + (x1 * y2 + y1 * x2) * xy + y1 * y2 * yy,
                     x2 * x2 * xx + 2 * x2 * y2 * xy + y2 * y2 * yy};
  if (any(in_strip_)) subtract_strip_moments(o1, o2, moments);
  const PackMask none = bands.back() <= low, some = (count > 0) & (moments[0] > 0);
  plain &= ~some | (moments[0] > weighted_area_min * area);
  plain &= ~near | none | (area > sliver_ratio * twice_area);
  // Lanes in one band; in the others the law is taken beyond its range.
  PackMask in_band{};
  for (std::size_t i = 0; i + 1 < bands.size(); ++i) in_band |= (bands[i] <= low) & (high <= bands[i + 1]);
  in_band &= plain & some & ~none & (low > bands.front());

  const Pack by_moment = 1 / select(some, moments[0], 1);
  area_ = select(in_band, moments[0], 0);
  const Pack m1 = moments[1] * by_moment, m2 = moments[2] * by_moment;
  first_ = area_ * (o1 + m1);
  second_ = area_ * (o2 + m2);
  first_first_ = select(in_band, moments[3] * by_moment - m1 * m1, 0);
  first_second_ = select(in_band, moments[4] * by_moment - m1 * m2, 0);
  second_second_ = select(in_band, moments[5] * by_moment - m2 * m2, 0);
  const Pack rise1 = z_[1] - z_[0], rise2 = z_[2] - z_[0];
  mean_ = select(in_band, z_[0] + rise1 * (o1 + m1) + rise2 * (o2 + m2), bands.back());
  const Pack variance = rise1 * rise1 * first_first_ + 2 * rise1 * rise2 * first_second_ + rise2 * rise2 * second_second_;
  deviation_ = sqrt(greater(variance, 0));
  const Pack gaps[2] = {mean_ - deviation_, mean_ + deviation_};
  std::memcpy(gaps_, gaps, sizeof gaps_);
  const PackMask found = in_band | (plain & none);
  unsigned bits = 0;
  for (int l = 0; l < pack_width; ++l) bits |= static_cast<unsigned>(found[l] & 1) << l;
  return bits;
}

}  // namespace tack
