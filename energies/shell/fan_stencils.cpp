#include "energies/shell/fan_stencils.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double pi = std::numbers::pi;

// Block (i, j), j <= i, of a stencil's Hessian.
constexpr int slot_of(int i, int j) { return i * (i + 1) / 2 + j; }

PackMat3 outer(const PackVec3& a, const PackVec3& b) { return a * b.transpose(); }

// To the block of rows a and columns b of the stencil, or its transpose.
void add(const PackMat3& block, int a, int b, Pack* slots) {
  if (a >= b) Eigen::Map<PackMat3>(slots + 9 * slot_of(a, b)) += block;
  else Eigen::Map<PackMat3>(slots + 9 * slot_of(b, a)) += block.transpose();
}

// The dihedral edges that turn with a vertex, and how far.
struct VertexEdges {
  std::array<int, fan_edges_max> edge;
  std::array<PackVec3, fan_edges_max> gradient;
  int count = 0;

  void add(int i, const PackVec3& g) {
    for (int k = 0; k < count; ++k)
      if (edge[k] == i) {
        gradient[k] += g;
        return;
      }
    edge[count] = i;
    gradient[count++] = g;
  }
};

}  // namespace

FanStencils::FanStencils(const DihedralFan* fans, const FanMatrix* c, int count) : shape_(fans[0].shape), count_(count) {
  const int n = shape_.edge_count;
  for (int f = 0; f < count; ++f) vertices_.insert(vertices_.end(), fans[f].vertices.begin(), fans[f].vertices.end());
  const int all = chunk_count(count, pack_width);
  c_.resize(static_cast<size_t>(all) * n * n);
  for (int f = 0; f < all * pack_width; ++f)
    for (int i = 0; i < n * n; ++i)
      c_[static_cast<size_t>(f / pack_width) * n * n + i].set(f % pack_width, c[std::min(f, count - 1)](i / n, i % n));
  Angles none;
  none.fill(0);
  resting_.assign(static_cast<size_t>(all), none);
  start_ = resting_;
}

void FanStencils::set_rest(const VecX& rest) {
  Corners x;
  DihedralEdges all;
  for (int p = 0; p < packs(); ++p) {
    corners(p, rest, x);
    find_edges(x, all);
    for (int i = 0; i < shape_.edge_count; ++i) resting_[p][i] = all[i].angle;
  }
  start_ = resting_;
}

void FanStencils::begin_step(const VecX& x, const double* turns) {
  for_each(packs(), [&](int p) {
    Corners at;
    DihedralEdges all;
    corners(p, x, at);
    find_edges(at, all);
    for (int i = 0; i < shape_.edge_count; ++i)
      for (int l = 0; l < pack_width; ++l)
        start_[p][i].set(l, all[i].angle[l] + 2 * pi * turns[entry(p, l, i)]);
  }, chunk_size / pack_width);
}

void FanStencils::turns(const VecX& x, double* turns) const {
  for_each(packs(), [&](int p) {
    Corners at;
    DihedralEdges all;
    corners(p, x, at);
    find_edges(at, all);
    for (int i = 0; i < shape_.edge_count; ++i) {
      const Pack angle = unwound(p, i, all[i].angle);
      for (int l = 0; l < lanes(p); ++l)
        turns[shape_.edge_count * (p * pack_width + l) + i] = std::round((angle[l] - all[i].angle[l]) / (2 * pi));
    }
  }, chunk_size / pack_width);
}

void FanStencils::angles(const VecX& x, double* angles) const {
  for_each(packs(), [&](int p) {
    Corners at;
    DihedralEdges all;
    corners(p, x, at);
    find_edges(at, all);
    for (int i = 0; i < shape_.edge_count; ++i) {
      const Pack angle = unwound(p, i, all[i].angle);
      for (int l = 0; l < lanes(p); ++l) angles[entry(p, l, i)] = angle[l];
    }
  }, chunk_size / pack_width);
}

void FanStencils::rest_angles(double* angles) const {
  for (int p = 0; p < packs(); ++p)
    for (int i = 0; i < shape_.edge_count; ++i)
      for (int l = 0; l < lanes(p); ++l) angles[entry(p, l, i)] = resting_[p][i][l];
}

void FanStencils::set_rest_angles(const double* angles) {
  for (int p = 0; p < packs(); ++p)
    for (int i = 0; i < shape_.edge_count; ++i)
      for (int l = 0; l < pack_width; ++l) resting_[p][i].set(l, angles[entry(p, l, i)]);
}

double FanStencils::energy_of(const double* angles) const {
  double sum = 0;
  for (int p = 0; p < packs(); ++p)
    for (int l = 0; l < lanes(p); ++l)
      for (int i = 0; i < shape_.edge_count; ++i)
        for (int k = 0; k < shape_.edge_count; ++k) sum += c(p, i, k)[l] / 2 * angles[entry(p, l, i)] * angles[entry(p, l, k)];
  return sum;
}

void FanStencils::corners(int pack, const VecX& x, Corners& out) const {
  const int arity = shape_.arity(), last = lanes(pack) - 1;
  for (int l = 0; l < pack_width; ++l) {
    const int* v = vertices_.data() + static_cast<size_t>(arity) * (pack * pack_width + std::min(l, last));
    for (int k = 0; k < arity; ++k)
      for (int d = 0; d < 3; ++d) out[k](d).set(l, x[3 * v[k] + d]);
  }
}

void FanStencils::find_edges(const Corners& x, DihedralEdges& out) const {
  std::array<PackVec3, ring_max> normal;
  std::array<Pack, ring_max> double_area;
  for (int j = 0; j < shape_.triangles(); ++j) {
    const PackVec3 twice = PackVec3(x[1 + j] - x[0]).cross(PackVec3(x[1 + (j + 1) % shape_.ring()] - x[0]));
    double_area[j] = sqrt(twice.squaredNorm());
    normal[j] = twice * (1 / double_area[j]);
  }
  for (int i = 0; i < shape_.edge_count; ++i) {
    DihedralEdge& h = out[i];
    const PackVec3 edge = x[shape_.tip(i)] - x[0];
    h.inverse_length = 1 / sqrt(edge.squaredNorm());
    h.e = edge * h.inverse_length;
    for (int s = 0; s < 2; ++s) {
      Side& side = h.sides[s];
      const int j = s == 0 ? shape_.left_triangle(i) : shape_.right_triangle(i);
      const PackVec3 arm = x[s == 0 ? shape_.left(i) : shape_.right(i)] - x[0];
      side.n = normal[j];
      side.m = s == 0 ? side.n.cross(h.e) : h.e.cross(side.n);
      const Pack foot = arm.dot(h.e) * h.inverse_length, inverse_height = 1 / (double_area[j] * h.inverse_length);
      side.alpha = {-(1 - foot) * inverse_height, -foot * inverse_height, inverse_height};
    }
    const PackVec3 &n1 = h.sides[0].n, &n2 = h.sides[1].n;
    h.angle = atan2(n2.cross(n1).dot(h.e), n1.dot(n2));
  }
}

Pack FanStencils::unwound(int pack, int i, const Pack& angle) const {
  // Whole turns that bring it nearest to the start; hardly ever any.
  const Pack off = angle - start_[pack][i];
  if (!any(abs(off) > pi)) return angle;
  Pack out = angle;
  for (int l = 0; l < pack_width; ++l) out.set(l, angle[l] - 2 * pi * std::round(off[l] / (2 * pi)));
  return out;
}

double FanStencils::value(const VecX& x) const {
  if (plastic()) return plastic_value(x);
  return sum_chunks(count_, [&](int first, int last) {
    double sum = 0;
    Corners at;
    DihedralEdges all;
    Angles a;
    for (int f = first; f < last; f += pack_width) {
      const int p = f / pack_width;
      corners(p, x, at);
      find_edges(at, all);
      Pack twice = 0;
      for (int i = 0; i < shape_.edge_count; ++i) {
        a[i] = unwound(p, i, all[i].angle) - resting_[p][i];
        Pack moment = 0.5 * c(p, i, i) * a[i];
        for (int k = 0; k < i; ++k) moment += c(p, i, k) * a[k];
        twice += a[i] * moment;
      }
      for (int l = 0; l < lanes(p); ++l) sum += twice[l];
    }
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;  // a triangle without area
  });
}

void FanStencils::range_derivatives(const VecX& x, Projection projection, int first, int last, double* gradient,
                                    double* hessian) const {
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);
  const int width = 3 * shape_.arity(), slots = 9 * hessian_blocks(shape_.arity());
  for (int f = first; f < last; f += pack_width) {
    const auto at = static_cast<size_t>(f - first);
    derivatives(f / pack_width, x, projection, gradient + at * static_cast<size_t>(width),
                hessian ? hessian + at * static_cast<size_t>(slots) : nullptr);
  }
  if (plastic()) let_flow(x, first, last, gradient, hessian);
}

void FanStencils::derivatives(int pack, const VecX& x, Projection projection, double* gradient, double* hessian) const {
  const int n = shape_.edge_count, arity = shape_.arity();
  Corners at;
  DihedralEdges all;
  corners(pack, x, at);
  find_edges(at, all);
  Angles a, moments;
  for (int i = 0; i < n; ++i) a[i] = unwound(pack, i, all[i].angle) - resting_[pack][i];
  for (int i = 0; i < n; ++i) {
    moments[i] = 0;
    for (int k = 0; k < n; ++k) moments[i] += c(pack, i, k) * a[k];
  }
  std::array<VertexEdges, 1 + ring_max> turning;
  for (int i = 0; i < n; ++i) {
    const auto& [left, right] = all[i].sides;
    turning[0].add(i, left.alpha[0] * left.n + right.alpha[0] * right.n);
    turning[shape_.tip(i)].add(i, left.alpha[1] * left.n + right.alpha[1] * right.n);
    turning[shape_.left(i)].add(i, left.alpha[2] * left.n);
    turning[shape_.right(i)].add(i, right.alpha[2] * right.n);
  }
  std::array<PackVec3, 1 + ring_max> g;
  for (int v = 0; v < arity; ++v) {
    g[v].setZero();
    for (int k = 0; k < turning[v].count; ++k) g[v] += moments[turning[v].edge[k]] * turning[v].gradient[k];
  }
  store_lanes(g[0].data(), 3 * arity, gradient, lanes(pack));
  if (!hessian) return;
  alignas(64) Pack slots[9 * hessian_blocks(1 + ring_max)];
  std::array<PackVec3, fan_edges_max> moved;  // moments, with a vertex
  for (int v = 0; v < arity; ++v) {
    for (int i = 0; i < n; ++i) {
      moved[i].setZero();
      for (int k = 0; k < turning[v].count; ++k) moved[i] += c(pack, i, turning[v].edge[k]) * turning[v].gradient[k];
    }
    for (int w = v; w < arity; ++w) {
      PackMat3 block = PackMat3::Zero();
      for (int k = 0; k < turning[w].count; ++k) block += outer(turning[w].gradient[k], moved[turning[w].edge[k]]);
      Eigen::Map<PackMat3>(slots + 9 * slot_of(w, v)) = block;
    }
  }
  for (int i = 0; i < n; ++i) add_moment(all[i], i, moments[i], projection, slots);
  store_lanes(slots, 9 * hessian_blocks(arity), hessian, lanes(pack));
}

// moment * d2 angle: its own part, or half of that and half of its absolute value, or the latter. Block (k, j) of a side is
// that of A(dx) twice, times alpha_k alpha_j; that of A and B, times alpha_k beta_j, and its transpose; and that of B twice.
void FanStencils::add_moment(const DihedralEdge& dihedral, int i, const Pack& moment, Projection projection, Pack* slots) const {
  const double share = projection == Projection::none ? 1 : projection == Projection::absolute ? 0 : 0.5;
  const Pack beta = dihedral.inverse_length;  // factor of the tip; the middle has its negative, the apex has 0
  const Pack signed_part = share * moment, size = (1 - share) * abs(moment);
  for (int s = 0; s < 2; ++s) {
    const auto& [m, n, alpha] = dihedral.sides[s];
    const PackMat3 mn = outer(m, n);
    PackMat3 of_a = -signed_part * (mn + PackMat3(mn.transpose())), of_b = Pack(0.5) * of_a;
    PackVec3 mixed = -signed_part * n;
    if (share < 1) {
      const Pack edge = 2 * beta * beta, side = alpha[0] * alpha[0] + alpha[1] * alpha[1] + alpha[2] * alpha[2];
      const Pack ratio = sqrt((4 * side + edge) / edge), inverse = size / (2 * ratio);
      const PackMat3 nn = outer(n, n), mm = outer(m, m);
      of_a += size * (nn + mm) + outer((4 * inverse) * dihedral.e, dihedral.e);
      of_b += (size / 2 * ratio) * nn + inverse * mm;
      mixed += (2 * inverse) * m;
    }
    const PackMat3 of_ab = outer(dihedral.e, mixed);
    const std::array<int, 3> v = {0, shape_.tip(i), s == 0 ? shape_.left(i) : shape_.right(i)};
    const std::array<PackMat3, 3> with_a = {alpha[0] * of_a, alpha[1] * of_a, alpha[2] * of_a};
    const PackMat3 b_ab = beta * of_ab, b_ba = b_ab.transpose(), b_b = (beta * beta) * of_b;
    add(alpha[0] * (with_a[0] - b_ab - b_ba) + b_b, v[0], v[0], slots);
    add(alpha[0] * with_a[1] - alpha[1] * b_ab + alpha[0] * b_ba - b_b, v[1], v[0], slots);
    add(alpha[1] * (with_a[1] + b_ab + b_ba) + b_b, v[1], v[1], slots);
    add(alpha[2] * (with_a[0] - b_ab), v[2], v[0], slots);
    add(alpha[2] * (with_a[1] + b_ab), v[2], v[1], slots);
    add(alpha[2] * with_a[2], v[2], v[2], slots);
  }
}

}  // namespace tack
