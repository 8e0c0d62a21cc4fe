// Energy, gradient and Hessian of the clipped integral of several pairs side by side.
#include "framework/contact/clipped/boundary_weight.hpp"
#include "framework/contact/clipped/clip_pack.hpp"
#include "framework/contact/clipped/strip_integrals.hpp"

namespace tack {

Pack ClipPack::energy(const double* values) const {
  Pack low, high;
  for (int l = 0; l < pack_width; ++l) {
    low.set(l, values[l]);
    high.set(l, values[pack_width + l]);
  }
  return 0.5 * area_ * (low + high);
}

ClippedIntegral ClipPack::integral(int lane, double energy) const {
  ClippedIntegral one;
  one.energy = energy;
  one.area_a = {area_[lane] - first_[lane] - second_[lane], first_[lane], second_[lane]};
  one.gap = mean_[lane];
  for (int k = 0; k < 3; ++k) {
    const double across = y_[k][lane] / height_[lane], along = (x_[k][lane] - across * foot_[lane]) / length_[lane];
    one.area[0] += one.area_a[k] * (1 - along - across);
    one.area[1] += one.area_a[k] * along;
    one.area[2] += one.area_a[k] * across;
  }
  return one;
}

void ClipPack::derivatives(const LawSample* samples, Pack* gradient, Pack* hessian) const {
  Pack value, slope, curvature, stiffness;
  for (int l = 0; l < pack_width; ++l) {
    const LawSample &low = samples[l], &high = samples[pack_width + l];
    const double deviation = deviation_[l];
    stiffness.set(l, 0.5 * (low.curvature + high.curvature));
    // Where the deviation is round-off, so is the effect of the curvature.
    curvature.set(l, deviation > 0 ? (high.slope - low.slope) / (2 * deviation) : stiffness[l]);
    slope.set(l, 0.5 * (low.slope + high.slope));
    value.set(l, 0.5 * (low.value + high.value));
  }
  const Pack constants[3] = {value - 0.5 * curvature * deviation_ * deviation_, slope, curvature};

  // Gaps, over S as it is.
  const Pack rise1 = z_[1] - z_[0], rise2 = z_[2] - z_[0];
  Pack by_x[3], by_y[3], by_z[3], by_bx[3], by_by[3];
  by_z[1] = slope * first_ + area_ * curvature * (rise1 * first_first_ + rise2 * first_second_);
  by_z[2] = slope * second_ + area_ * curvature * (rise1 * first_second_ + rise2 * second_second_);
  by_z[0] = slope * area_ - by_z[1] - by_z[2];
  const Pack x1 = x_[1] - x_[0], y1 = y_[1] - y_[0], x2 = x_[2] - x_[0], y2 = y_[2] - y_[0], projected = x1 * y2 - y1 * x2;
  const Pack by_projected = 1 / select(area_ > 0, projected, 1);
  const Pack slope_x = (rise1 * y2 - rise2 * y1) * by_projected, slope_y = (rise2 * x1 - rise1 * x2) * by_projected;
  for (int k = 0; k < 3; ++k) {
    by_x[k] = -by_z[k] * slope_x;
    by_y[k] = -by_z[k] * slope_y;
    by_bx[k] = by_by[k] = 0;
  }
  const PackMask some = area_ > 0;
  const bool strips = any(in_strip_ & some);
  const Pack inward_rise = strips ? slope_x * inward_x_ + slope_y * inward_y_ : Pack(0);
  Pack strip_all = 0, strip_end = 0, edge_x = 0, edge_y = 0, edge_length = 1;
  for (int k = 0; strips && k < 3; ++k) {
    edge_x = select(strip_edge_[k], of_b_[k].x, edge_x);
    edge_y = select(strip_edge_[k], of_b_[k].y, edge_y);
    edge_length = select(strip_edge_[k], edge_length_b_[k], edge_length);
  }
  // Sides that move outwards.
  const double gauss[2] = {0.5 - 0.28867513459481288, 0.5 + 0.28867513459481288};
  for (int e = 0; e < 3; ++e) {
    const int n = (e + 1) % 3;
    for (int of_b = 0; of_b < (a_inside_ ? 1 : 2); ++of_b) {
      const Side& side = of_b ? of_b_[e] : of_a_[e];
      const Pack width = side.to - side.from;
      Pack begin = 0, end = 0;
      for (const double point : gauss) {
        const Pack at = side.from + point * width, weighted = 0.5 * width * h(constants, side.gap + at * side.rise);
        begin += weighted * (1 - at);
        end += weighted * at;
      }
      if (strips) {
        const Pack outward = inward_x_ * side.across_y - inward_y_ * side.across_x;
        const Pack along_begin = inward_y_ * (side.x - edge_x) - inward_x_ * (side.y - edge_y), along_across = inward_y_ * side.across_x - inward_x_ * side.across_y;
        for_strip_points(side, [&](const Pack& at, const Pack& weight) {
          const Pack t = (side.depth + at * side.deepening) / width_, gap = side.gap + at * side.rise;
          const Pack lost = weight * weight_lost(t) * h(constants, gap);
          begin -= lost * (1 - at);
          end -= lost * at;
          const Pack moved = outward * (weight * width_ * (weight_lost_0(t) * (slope + curvature * (gap - mean_)) * inward_rise + width_ * weight_lost_1(t) * curvature * inward_rise * inward_rise) - lost);
          strip_all += moved;
          strip_end += moved * (along_begin + at * along_across) / edge_length;
        });
      }
      const Pack out_x = select(some, side.across_y, 0), out_y = select(some, -side.across_x, 0);
      if (of_b) {
        by_bx[e] += begin * out_x, by_by[e] += begin * out_y;
        by_bx[n] += end * out_x, by_by[n] += end * out_y;
      } else {
        by_x[n] += begin * out_x, by_y[n] += begin * out_y;
        by_x[e] += end * out_x, by_y[e] += end * out_y;
      }
    }
  }
  // The strip moves with its edge.
  for (int k = 0; strips && k < 3; ++k) {
    const int n = (k + 1) % 3;
    const Pack at_begin = select(strip_edge_[k] & some, strip_all - strip_end, 0), at_end = select(strip_edge_[k] & some, strip_end, 0);
    by_bx[k] -= at_begin * inward_x_, by_by[k] -= at_begin * inward_y_;
    by_bx[n] -= at_end * inward_x_, by_by[n] -= at_end * inward_y_;
  }
  // The local axes turn with b: the moment of the local derivatives acts on the corners of b.
  const Pack bx[3] = {0, length_, foot_}, by[3] = {0, 0, height_};
  Pack moment[3] = {0, 0, 0};
  for (int k = 0; k < 3; ++k) {
    moment[0] += y_[k] * by_z[k] - z_[k] * by_y[k];
    moment[1] += z_[k] * by_x[k] - x_[k] * by_z[k];
    moment[2] += x_[k] * by_y[k] - y_[k] * by_x[k] + bx[k] * by_by[k] - by[k] * by_bx[k];
  }
  const Pack by_length = 1 / select(some, length_, 1), by_height = 1 / select(some, height_, 1);
  const Pack local[5][3] = {{by_x[0], by_y[0], by_z[0]}, {by_x[1], by_y[1], by_z[1]}, {by_x[2], by_y[2], by_z[2]},
                            {by_bx[1], by_by[1] - moment[2] * by_length, (moment[1] + moment[0] * foot_ * by_height) * by_length},
                            {by_bx[2], by_by[2], -moment[0] * by_height}};
  for (int d = 0; d < 3; ++d) {
    Pack sum = 0;
    for (int k = 0; k < 5; ++k) {
      const Pack value_d = select(some, axes_[0][d] * local[k][0] + axes_[1][d] * local[k][1] + axes_[2][d] * local[k][2], 0);
      gradient[3 * (k < 3 ? k : k + 1) + d] = value_d;
      sum += value_d;
    }
    gradient[9 + d] = -sum;
  }
  if (!hessian) return;

  // Shares of the corners of a in b.
  Pack in_b[3][3];
  for (int k = 0; k < 3; ++k) {
    const Pack across = y_[k] * by_height, along = (x_[k] - across * foot_) * by_length;
    in_b[0][k] = along + across - 1;
    in_b[1][k] = -along;
    in_b[2][k] = -across;
  }
  const Pack weight = select(some, greater(stiffness, 0), 0), by_area = 1 / select(some, area_, 1);
  const Pack mean[3] = {(area_ - first_ - second_) * by_area, first_ * by_area, second_ * by_area};
  const Pack c01 = -first_first_ - first_second_, c02 = -first_second_ - second_second_;
  const Pack covariance[3][3] = {{-c01 - c02, c01, c02}, {c01, first_first_, first_second_}, {c02, first_second_, second_second_}};
  Pack full[6][6];  // lower triangle
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full[i][j] = weight * area_ * (mean[i] * mean[j] + covariance[i][j]);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) full[3 + i][j] = in_b[i][0] * full[0][j] + in_b[i][1] * full[1][j] + in_b[i][2] * full[2][j];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j <= i; ++j) full[3 + i][3 + j] = full[3 + i][0] * in_b[j][0] + full[3 + i][1] * in_b[j][1] + full[3 + i][2] * in_b[j][2];
  Pack outer[9];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) outer[3 * i + j] = select(some, axes_[2][i] * axes_[2][j], 0);
  Pack* block = hessian;
  for (int i = 0; i < 6; ++i)
    for (int j = 0; j <= i; ++j)
      for (int m = 0; m < 9; ++m) *block++ = full[i][j] * outer[m];
  if (strips) add_boundary_edges(constants, in_b, hessian);
}

// Boundary edges of a in the strip: their energy falls as they move inwards. in_b: minus the shares
// in b of each corner of a.
void ClipPack::add_boundary_edges(const Pack* constants, const Pack (&in_b)[3][3], Pack* hessian) const {
  for (int e = 0; e < 3; ++e) {
    Pack boundary;
    std::memcpy(&boundary, boundary_[e], sizeof boundary);
    const Side& side = of_a_[e];
    const PackMask acts = (boundary > 0.5) & in_strip_ & (area_ > 0) & (side.strip_from < side.strip_to);
    if (!any(acts)) continue;
    const Pack length = sqrt(side.across_x * side.across_x + side.across_y * side.across_y);
    const Pack out_x = side.across_y / length, out_y = -side.across_x / length, width = side.strip_to - side.strip_from;
    Pack begin_begin = 0, begin_end = 0, end_end = 0;
    for (const double point : {0.5 - 0.28867513459481288, 0.5 + 0.28867513459481288}) {
      const Pack at = side.strip_from + point * width, t = (side.depth + at * side.deepening) / width_;
      const Pack rho_slope = BoundaryWeight::slope_in_strip(t) / width_;
      const Pack stiffness = 0.5 * width * length * h(constants, side.gap + at * side.rise) * rho_slope * (inward_x_ * out_x + inward_y_ * out_y);
      const Pack positive = select(acts, greater(stiffness, 0), 0);
      begin_begin += positive * (1 - at) * (1 - at);
      begin_end += positive * (1 - at) * at;
      end_end += positive * at * at;
    }
    // Shares of the six corners at the begin and at the end of the edge.
    const int n = (e + 1) % 3;
    Pack at_begin[6] = {0, 0, 0, in_b[0][n], in_b[1][n], in_b[2][n]}, at_end[6] = {0, 0, 0, in_b[0][e], in_b[1][e], in_b[2][e]};
    at_begin[n] = 1;
    at_end[e] = 1;
    Pack direction[3];
    for (int d = 0; d < 3; ++d) direction[d] = axes_[0][d] * out_x + axes_[1][d] * out_y;
    Pack* block = hessian;
    for (int i = 0; i < 6; ++i) {
      const Pack by_begin = begin_begin * at_begin[i] + begin_end * at_end[i], by_end = begin_end * at_begin[i] + end_end * at_end[i];
      for (int j = 0; j <= i; ++j) {
        const Pack scalar = by_begin * at_begin[j] + by_end * at_end[j];
        for (int c = 0; c < 3; ++c)
          for (int r = 0; r < 3; ++r) *block++ += select(acts, scalar * direction[r] * direction[c], 0);
      }
    }
  }
}

}  // namespace tack
