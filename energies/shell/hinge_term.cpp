#include "energies/shell/hinge_term.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "geometry/errors.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double pi = std::numbers::pi;

// Block (i, j), j <= i, of a stencil's Hessian.
constexpr int slot_of(int i, int j) { return i * (i + 1) / 2 + j; }

// What stands for the vertices of a hinge in the stencil: edge i is from vertex i + 1 to i + 2, and its apexes are vertex i
// and vertex 3 + i.
constexpr std::array<int, 3> members(int i, int side) { return {(i + 1) % 3, (i + 2) % 3, side == 0 ? i : 3 + i}; }

// To the block of rows a and columns b of the stencil, or its transpose.
void add(const PackMat3& block, int a, int b, Pack* slots) {
  if (a >= b) Eigen::Map<PackMat3>(slots + 9 * slot_of(a, b)) += block;
  else Eigen::Map<PackMat3>(slots + 9 * slot_of(b, a)) += block.transpose();
}

PackMat3 outer(const PackVec3& a, const PackVec3& b) { return a * b.transpose(); }

// Adds the rows and columns of the vertices that stand twice in a stencil to those of the first, and clears them.
void merge(const std::array<int, 6>& vertices, double* gradient, double* hessian) {
  for (int b = 1; b < 6; ++b) {
    const int a = static_cast<int>(std::find(vertices.begin(), vertices.end(), vertices[b]) - vertices.begin());
    if (a == b) continue;
    for (int d = 0; d < 3; ++d) gradient[3 * a + d] += std::exchange(gradient[3 * b + d], 0.0);
    if (!hessian) continue;
    const auto block = [&](int i, int j) { return Eigen::Map<Mat3>(hessian + 9 * slot_of(i, j)); };
    block(a, a) += block(b, b) + block(b, a) + block(b, a).transpose();
    for (int k = 0; k < 6; ++k) {
      if (k == a || k == b) continue;
      const Mat3 row = b > k ? Mat3(block(b, k)) : Mat3(block(k, b).transpose());  // of b, in the columns of k
      if (a > k) block(a, k) += row;
      else block(k, a) += row.transpose();
    }
    for (int k = 0; k < 6; ++k) b >= k ? block(b, k).setZero() : block(k, b).setZero();
  }
}

}  // namespace

HingeTerm::HingeTerm(std::string name, const Body& body, const VecX& rest, double stiffness, double poisson, bool rest_angles)
    : Term(std::move(name)), memory_(fmt::format("{}/energies/{}/turns", body.name, body.energy)) {
  const std::vector<SheetTriangle> sheet = connect_sheet(body.sheet, fmt::format("object '{}': ", body.name));
  const std::vector<Mat3> fitted = fit_hinges(sheet, rest, stiffness, poisson);
  std::vector<Mat3> kept;
  for (size_t t = 0; t < sheet.size(); ++t) {
    const auto& [v, across, neighbour] = sheet[t];
    if (across == std::array{-1, -1, -1}) continue;  // no hinge
    std::array<int, 6> stencil = {v[0], v[1], v[2], across[0], across[1], across[2]};
    for (int i = 3; i < 6; ++i)
      for (int j = 3; j < i; ++j)
        if (stencil[i] >= 0 && stencil[i] == stencil[j]) {
          repeated_.push_back(static_cast<int>(stencils_.size()));
          i = j = 6;
        }
    for (int& vertex : stencil)
      if (vertex < 0) vertex = v[0];
    stencils_.push_back(stencil);
    kept.push_back(fitted[t]);
  }
  if (stencils_.empty())
    throw InputError(fmt::format("object '{}': no two triangles of its sheet share an edge, so nothing can bend; weld its vertices, "
                                 "or take the bending energy away", body.name));
  count_ = static_cast<int>(stencils_.size());
  c_.resize(static_cast<size_t>(chunk_count(count_, pack_width)));
  for (size_t t = 0; t < c_.size() * pack_width; ++t)
    set_lane<3, 3>(c_[t / pack_width], static_cast<int>(t % pack_width), kept[std::min(t, kept.size() - 1)]);
  resting_.assign(c_.size(), PackVec3(0, 0, 0));
  start_ = resting_;
  turns_.assign(3 * static_cast<size_t>(count_), 0.0);
  if (!rest_angles) return;
  for (size_t p = 0; p < c_.size(); ++p) {
    const int first = static_cast<int>(p) * pack_width;
    const auto all = hinges(static_cast<int>(p), corners(first, std::min(pack_width, count_ - first), rest));
    for (int i = 0; i < 3; ++i) resting_[p](i) = all[i].angle;
  }
  start_ = resting_;
}

void HingeTerm::remember(const History& history) {
  if (const auto* values = remembered(history, memory_, 3, count_)) turns_ = *values;
  else std::fill(turns_.begin(), turns_.end(), 0.0);
}

void HingeTerm::begin_step(const StepStart& start) {
  for_each(static_cast<int>(c_.size()), [&](int p) {
    const int first = p * pack_width, n = std::min(pack_width, count_ - first);
    const auto all = hinges(p, corners(first, n, start.x));
    for (int i = 0; i < 3; ++i)
      for (int l = 0; l < pack_width; ++l)
        start_[p](i).set(l, all[i].angle[l] + 2 * pi * turns_[3 * static_cast<size_t>(first + std::min(l, n - 1)) + i]);
  }, chunk_size / pack_width);
}

std::vector<double> HingeTerm::turns(const VecX& x) const {
  std::vector<double> all(turns_.size());
  for_each(static_cast<int>(c_.size()), [&](int p) {
    const int first = p * pack_width, n = std::min(pack_width, count_ - first);
    const auto of = hinges(p, corners(first, n, x));
    const PackVec3 angles = unwound(p, of);
    for (int l = 0; l < n; ++l)
      for (int i = 0; i < 3; ++i)
        all[3 * static_cast<size_t>(first + l) + i] = std::round((angles(i)[l] - of[i].angle[l]) / (2 * pi));
  }, chunk_size / pack_width);
  return all;
}

// Nothing is remembered of a sheet that no angle of which has passed pi.
void HingeTerm::commit(const VecX& x, History& history) const {
  std::vector<double> all = turns(x);
  if (std::all_of(all.begin(), all.end(), [](double t) { return t == 0; })) history.erase(memory_);
  else history[memory_] = {3, std::move(all), {}};
}

HingeTerm::Corners HingeTerm::corners(int first, int n, const VecX& x) const {
  Corners out;
  for (int l = 0; l < pack_width; ++l) {
    const std::array<int, 6>& v = stencils_[static_cast<size_t>(first + (l < n ? l : n - 1))];
    for (int k = 0; k < 6; ++k)
      for (int d = 0; d < 3; ++d) out[k](d).set(l, x[3 * v[k] + d]);
  }
  return out;
}

std::array<HingeTerm::Hinge, 3> HingeTerm::hinges(int pack, const Corners& x) const {
  const PackVec3 twice = PackVec3(x[1] - x[0]).cross(PackVec3(x[2] - x[0]));
  const Pack double_area = sqrt(twice.squaredNorm());
  const PackVec3 normal = twice * (1 / double_area);
  std::array<Hinge, 3> out;
  for (int i = 0; i < 3; ++i) {
    Hinge& h = out[i];
    const PackVec3 &a = x[members(i, 0)[0]], &b = x[members(i, 0)[1]];
    const PackVec3 edge = b - a;
    h.inverse_length = 1 / sqrt(edge.squaredNorm());
    h.e = edge * h.inverse_length;
    for (int s = 0; s < 2; ++s) {
      Side& side = h.sides[s];
      const PackVec3 arm = x[members(i, s)[2]] - a;
      Pack height;
      if (s == 0) {
        side.n = normal;
        height = double_area * h.inverse_length;
        side.m = side.n.cross(h.e);
      } else {
        // At a border the apex is some vertex: C has nothing there, and all numbers have to be finite.
        const PackVec3 across = arm.cross(edge);
        const Pack length = sqrt(across.squaredNorm());
        const PackMask flat = length <= 0;
        const Pack inverse = select(flat, 0, 1 / select(flat, 1, length));
        side.n = across * inverse;
        height = select(flat, 1 / h.inverse_length, length * h.inverse_length);
        side.m = h.e.cross(side.n);
      }
      const Pack foot = arm.dot(h.e) * h.inverse_length, inverse_height = 1 / height;
      side.alpha = {-(1 - foot) * inverse_height, -foot * inverse_height, inverse_height};
    }
    const PackVec3 &n1 = h.sides[0].n, &n2 = h.sides[1].n;
    h.angle = select(c_[pack](i, i) > 0, atan2(n2.cross(n1).dot(h.e), n1.dot(n2)), 0);
  }
  return out;
}

PackVec3 HingeTerm::unwound(int pack, const std::array<Hinge, 3>& hinges) const {
  PackVec3 out;
  for (int i = 0; i < 3; ++i) {
    // Whole turns that bring it nearest to the start; hardly ever any.
    Pack angle = hinges[i].angle;
    const Pack off = angle - start_[pack](i);
    if (any(abs(off) > pi))
      for (int l = 0; l < pack_width; ++l) angle.set(l, angle[l] - 2 * pi * std::round(off[l] / (2 * pi)));
    out(i) = angle;
  }
  return out;
}

double HingeTerm::value(const VecX& x) const {
  return sum_chunks(count_, [&](int first, int last) {
    double sum = 0;
    for (int t = first; t < last; t += pack_width) {
      const int p = t / pack_width, n = std::min(pack_width, last - t);
      const PackVec3 a = unwound(p, hinges(p, corners(t, n, x))) - resting_[p];
      const Pack energy = 0.5 * a.dot(PackVec3(c_[p] * a));
      for (int l = 0; l < n; ++l) sum += energy[l];
    }
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;  // a triangle without area
  });
}

void HingeTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  for_each_chunk(count_, [&](int, int first, int last) {
    range_derivatives(x, projection, first, last, gradient + 18 * static_cast<size_t>(first),
                      hessian ? hessian + 189 * static_cast<size_t>(first) : nullptr);
  });
}

void HingeTerm::range_derivatives(const VecX& x, Projection projection, int first, int last, double* gradient,
                                  double* hessian) const {
  static_assert(chunk_size % pack_width == 0 && grain % pack_width == 0);
  const double* const start = hessian;
  for (int t = first; t < last; t += pack_width) {
    const size_t at = static_cast<size_t>(t - first);
    elements(t, std::min(pack_width, last - t), x, projection, gradient + 18 * at, hessian ? hessian + 189 * at : nullptr);
  }
  for (auto r = std::lower_bound(repeated_.begin(), repeated_.end(), first); r != repeated_.end() && *r < last; ++r) {
    const size_t at = static_cast<size_t>(*r - first);
    merge(stencils_[static_cast<size_t>(*r)], gradient + 18 * at, start ? hessian + 189 * at : nullptr);
  }
}

void HingeTerm::elements(int first, int n, const VecX& x, Projection projection, double* gradient, double* hessian) const {
  const int p = first / pack_width;
  const std::array<Hinge, 3> all = hinges(p, corners(first, n, x));
  const PackVec3 moments = c_[p] * (unwound(p, all) - resting_[p]);
  // Column i of turn[k]: the gradient of angle i in vertex k.
  std::array<PackMat3, 3> turn;
  std::array<PackVec3, 3> turn_across;
  for (PackMat3& g : turn) g = PackMat3::Zero();
  for (int i = 0; i < 3; ++i) {
    for (int s = 0; s < 2; ++s)
      for (int k = 0; k < 2; ++k) turn[members(i, s)[k]].col(i) += all[i].sides[s].alpha[k] * all[i].sides[s].n;
    turn[i].col(i) += all[i].sides[0].alpha[2] * all[i].sides[0].n;
    turn_across[i] = all[i].sides[1].alpha[2] * all[i].sides[1].n;
  }
  PackMatrix<3, 6> g;
  for (int k = 0; k < 3; ++k) {
    g.col(k) = turn[k] * moments;
    g.col(3 + k) = moments(k) * turn_across[k];
  }
  store_lanes(g.data(), 18, gradient, n);
  if (!hessian) return;
  alignas(64) Pack slots[189];
  const auto slot = [&](int i, int j) { return Eigen::Map<PackMat3>(slots + 9 * slot_of(i, j)); };
  for (int k = 0; k < 3; ++k) {
    const PackMat3 half = turn[k] * c_[p];
    for (int j = 0; j <= k; ++j) slot(k, j) = half * turn[j].transpose();
    for (int i = 0; i < 3; ++i) slot(3 + i, k) = outer(turn_across[i], half.col(i));
    for (int j = 0; j <= k; ++j) slot(3 + k, 3 + j) = c_[p](k, j) * outer(turn_across[k], turn_across[j]);
  }
  for (int i = 0; i < 3; ++i) add_moment(all[i], i, moments(i), projection, slots);
  store_lanes(slots, 189, hessian, n);
}

// moment * d2 angle: its own part, or half of that and half of its absolute value, or the latter.
void HingeTerm::add_moment(const Hinge& hinge, int i, const Pack& moment, Projection projection, Pack* slots) const {
  const double share = projection == Projection::none ? 1 : projection == Projection::absolute ? 0 : 0.5;
  const std::array<Pack, 3> beta = {-hinge.inverse_length, hinge.inverse_length, 0};
  const Pack signed_part = share * moment, size = (1 - share) * abs(moment);
  for (int s = 0; s < 2; ++s) {
    const auto& [m, n, alpha] = hinge.sides[s];
    const PackMat3 mn = outer(m, n), en = outer(hinge.e, n);
    const PackMat3 mixed = mn + PackMat3(mn.transpose());
    PackMat3 nn, square;
    Pack ratio = 1;
    if (share < 1) {
      nn = outer(n, n);
      square = nn + outer(m, m);
      const Pack edge = 2 * hinge.inverse_length * hinge.inverse_length;
      const Pack side = alpha[0] * alpha[0] + alpha[1] * alpha[1] + alpha[2] * alpha[2];
      ratio = sqrt((4 * side + edge) / edge);
    }
    const std::array<int, 3> v = members(i, s);
    for (int k = 0; k < 3; ++k) {
      for (int j = 0; j <= k; ++j) {
        const Pack aa = alpha[k] * alpha[j], bb = beta[k] * beta[j];
        PackMat3 block = (-signed_part * (aa + bb / 2)) * mixed;
        block -= (signed_part * alpha[k] * beta[j]) * en;
        block -= (signed_part * alpha[j] * beta[k]) * en.transpose();
        if (share < 1) {
          const PackVec3 wk = 2 * alpha[k] * hinge.e + beta[k] * m, wj = 2 * alpha[j] * hinge.e + beta[j] * m;
          block += (size * aa) * square;
          block += (size / 2 * ratio * bb) * nn;
          block += (size / 2 / ratio) * outer(wk, wj);
        }
        add(block, v[k], v[j], slots);
      }
    }
  }
}

}  // namespace tack
