#include "energies/rod/rod_term.hpp"

#include <limits>

#include "framework/assembly/stencil_clamp.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// A turn about the tangent.
Quaternion about_tangent(double angle) { return {std::cos(angle / 2), std::sin(angle / 2), 0, 0}; }

// The other end of an edge.
int opposite(const Edge& edge, int v) { return edge[0] == v ? edge[1] : edge[0]; }

constexpr const char* turns_name = "turns";

}  // namespace

RodTerm::RodTerm(std::string name, std::string history_name, const RodMaterial& material, const RodRest& shape, std::vector<Edge> edges,
                 std::shared_ptr<const RodFrames> frames, const VecX& rest)
    : Term(std::move(name)), history_name_(std::move(history_name)), frames_(std::move(frames)),
      stretching_(std::move(edges), material.stretching, rest) {
  for (const RodPair& of : rod_pairs(stretching_.edges(), rest)) {
    Pair& pair = pairs_.emplace_back();
    settle(pair, of, material, shape, rest);
  }
  load_history({});
}

// Adds directions, stencil and rest shape of a pair. The committed frames are those of the rest shape.
void RodTerm::settle(Pair& pair, const RodPair& of, const RodMaterial& material, const RodRest& shape, const VecX& rest) {
  const Edge &first = stretching_.edges()[of.first], &second = stretching_.edges()[of.second];
  const int a = opposite(first, of.vertex), b = opposite(second, of.vertex);
  pair.edge = {frames_->find(first), frames_->find(second)};
  stencils_.push_back({a, of.vertex, b, frames_->twists()[pair.edge[0]], frames_->twists()[pair.edge[1]]});
  const bool straight = shape.straight && !of.joint;
  const Vec3 in = Vec3(vertex(rest, of.vertex) - vertex(rest, a)).normalized();
  const Vec3 out = Vec3(vertex(rest, b) - vertex(rest, of.vertex)).normalized();
  constexpr double round_off = 1e-9;
  pair.second_from_end = !straight && in.dot(out) < -round_off;
  const int from = pair.second_from_end ? b : of.vertex;
  pair.backwards = {frames_->edge(pair.edge[0])[0] != a, frames_->edge(pair.edge[1])[0] != from};
  pair.turned = {0, 0};

  bends_.emplace_back(frame(pair, 0), frame(pair, 1));
  axes_.push_back({frame(pair, 0).conjugate().toRotationMatrix(), frame(pair, 1).conjugate().toRotationMatrix()});
  turns_.push_back(0);
  const double twist = 2 * bends_.back().turn(edge_pair(pair_count() - 1, rest));
  pair.turned = {twist / 2, -twist / 2};
  bends_.back() = {frame(pair, 0), frame(pair, 1)};
  axes_.back() = {frame(pair, 0).conjugate().toRotationMatrix(), frame(pair, 1).conjugate().toRotationMatrix()};
  pair.rest = straight ? Vec3::Zero() : bends_.back().strains(edge_pair(pair_count() - 1, rest));
  pair.rest.z() = 0;
  if (!of.joint) pair.rest += of.length * Vec3(shape.curvature.x(), shape.curvature.y(), shape.twist);
  const Vec3 turn(pair.rest.x(), pair.rest.y(), 0);
  const double cosine = 1 / std::sqrt(1 + turn.squaredNorm() / 4);  // of phi / 2
  const Vec3 along = turn.isZero() ? Vec3::Zero() : turn.normalized();
  pair.root = (material.bending / of.length).cwiseSqrt().asDiagonal() * (cosine * (Mat3::Identity() - (1 - cosine) * along * along.transpose()));
}

// The committed frame of an edge as the pair follows it: backwards, it is turned by half a turn about its first director.
Quaternion RodTerm::frame(const Pair& pair, int side) const {
  const Quaternion half_turn = pair.backwards[side] ? Quaternion(0, 0, 1, 0) : Quaternion::Identity();
  return frames_->committed(pair.edge[side]) * half_turn * about_tangent(pair.turned[side]);
}

BendTwist::EdgePair RodTerm::edge_pair(int p, const VecX& x) const {
  const Pair& pair = pairs_[p];
  const auto& [a, v, b, u_1, u_2] = stencils_[p];
  const Vec3 out = vertex(x, b) - vertex(x, v);
  return {axes_[p][0] * (vertex(x, v) - vertex(x, a)), axes_[p][1] * (pair.second_from_end ? Vec3(-out) : out),
          sign(pair, 0) * x(3 * u_1) / frames_->radius(), sign(pair, 1) * x(3 * u_2) / frames_->radius(), turns_[p]};
}

void RodTerm::load_history(const History& history) {
  const std::vector<double>* turns = history_values(history, history_name_ + turns_name, 1, pair_count());
  for_each(pair_count(), [&](int p) {
    const Quaternion first = frame(pairs_[p], 0), second = frame(pairs_[p], 1);
    bends_[p] = {first, second};
    axes_[p] = {first.conjugate().toRotationMatrix(), second.conjugate().toRotationMatrix()};
    turns_[p] = turns ? (*turns)[p] : 0;
  });
}

void RodTerm::commit(const VecX& x, History& history) const {
  HistoryArray turns{1, turns_, {}};
  for (int p = 0; p < pair_count(); ++p) turns.values[p] = bends_[p].turn(edge_pair(p, x));
  history[history_name_ + turns_name] = std::move(turns);
}

VecX RodTerm::strains(const VecX& x) const {
  VecX strains(stretching_.count() + 3 * pair_count());
  stretching_.lengths(x, strains.data());
  for_each(pair_count(), [&](int p) { strains.segment<3>(stretching_.count() + 3 * p) = bends_[p].strains(edge_pair(p, x)); });
  return strains;
}

VecX RodTerm::rest_strains() const {
  VecX rest(stretching_.count() + 3 * pair_count());
  stretching_.rest_lengths(rest.data());
  for (int p = 0; p < pair_count(); ++p) rest.segment<3>(stretching_.count() + 3 * p) = pairs_[p].rest;
  return rest;
}

void RodTerm::set_rest_strains(const VecX& rest) {
  stretching_.set_rest_lengths(rest.data());
  for (int p = 0; p < pair_count(); ++p) pairs_[p].rest = rest.segment<3>(stretching_.count() + 3 * p);
}

double RodTerm::energy_of(const VecX& strains) const {
  double sum = stretching_.energy_of(strains.data());
  for (int p = 0; p < pair_count(); ++p) sum += (pairs_[p].root * strains.segment<3>(stretching_.count() + 3 * p)).squaredNorm() / 2;
  return sum;
}

double RodTerm::value_of(const VecX& x, const double* strains) const {
  return stretching_.value(x, strains) + sum_chunks(pair_count(), [&](int first, int last) {
    double sum = 0;
    for (int p = first; p < last; ++p) {
      const BendTwist::EdgePair at = edge_pair(p, x);
      if (!BendTwist::within_reach(at.first) || !BendTwist::within_reach(at.second)) return std::numeric_limits<double>::infinity();
      sum += (pairs_[p].root * (bends_[p].strains(at) - rest_of(p, strains))).squaredNorm() / 2;
    }
    return sum;
  });
}

std::vector<StencilBatch> RodTerm::batches() const {
  return {stretching_.batch(), {5, pair_count(), stencils_.empty() ? nullptr : stencils_.front().data(), 2}};
}

// A place by vertices and arcs: l_1 = axes_1 (x_v - x_a), l_2 = +-axes_2 (x_b - x_v), theta = +-u / r.
RodTerm::Chain RodTerm::chain(int p) const {
  const Pair& pair = pairs_[p];
  Chain chain = Chain::Zero();
  chain.block<3, 3>(0, 0) = -axes_[p][0];
  chain.block<3, 3>(0, 3) = axes_[p][0];
  chain.block<3, 3>(3, 6) = pair.second_from_end ? Mat3(-axes_[p][1]) : axes_[p][1];
  chain.block<3, 3>(3, 3) = -chain.block<3, 3>(3, 6);
  chain(6, 9) = sign(pair, 0) / frames_->radius();
  chain(7, 12) = sign(pair, 1) / frames_->radius();
  return chain;
}

void RodTerm::derivatives_of(const VecX& x, const double* strains, Projection projection, double* gradient, double* hessian) const {
  stretching_.derivatives(x, projection, gradient, hessian, strains);
  gradient += 6 * static_cast<size_t>(stretching_.count());
  if (hessian) hessian += 27 * static_cast<size_t>(stretching_.count());
  for_each(pair_count(), [&](int p) {
    const Pair& pair = pairs_[p];
    BendTwist::Vec8 slope;
    BendTwist::Mat8 local;
    bends_[p].derivatives(edge_pair(p, x), pair.root.transpose() * pair.root, rest_of(p, strains), slope, hessian ? &local : nullptr);
    // Chain rule from the committed frames to x and arcs, then from edges to vertices: -1, 1 for the first and -1, 1 for the second edge.
    const std::array<Mat3, 2> back = {axes_[p][0].transpose(), (pair.second_from_end ? -1 : 1) * axes_[p][1].transpose()};
    const std::array<double, 2> arcs = {sign(pair, 0) / frames_->radius(), sign(pair, 1) / frames_->radius()};
    const Vec3 first = back[0] * slope.head<3>(), second = back[1] * slope.segment<3>(3);
    double* g = gradient + 15 * static_cast<size_t>(p);
    Eigen::Map<Vec3>{g} = -first;
    Eigen::Map<Vec3>{g + 3} = first - second;
    Eigen::Map<Vec3>{g + 6} = second;
    for (int i = 0; i < 2; ++i) Eigen::Map<Vec3>{g + 9 + 3 * i} = Vec3(arcs[i] * slope(6 + i), 0, 0);
    if (!hessian) return;
    const Mat3 k11 = back[0] * local.block<3, 3>(0, 0) * back[0].transpose(), k21 = back[1] * local.block<3, 3>(3, 0) * back[0].transpose(),
               k22 = back[1] * local.block<3, 3>(3, 3) * back[1].transpose();
    double* slot = hessian + 135 * static_cast<size_t>(p);
    const auto put = [&](const Mat3& block) {
      Eigen::Map<Mat3>{slot} = block;
      slot += 9;
    };
    put(k11);
    put(k21 - k11);
    put(k11 + k22 - k21 - k21.transpose());
    put(-k21);
    put(k21 - k22);
    put(k22);
    for (int i = 0; i < 2; ++i) {
      const Vec3 by_first = arcs[i] * back[0] * local.block<3, 1>(0, 6 + i), by_second = arcs[i] * back[1] * local.block<3, 1>(3, 6 + i);
      for (const Vec3& row : {Vec3(-by_first), Vec3(by_first - by_second), by_second}) put(Vec3::UnitX() * row.transpose());
      for (int j = 0; j <= i; ++j) put(arcs[i] * arcs[j] * local(6 + i, 6 + j) * Vec3::UnitX() * Vec3::UnitX().transpose());
    }
    project_slots({.arity = 5, .scalars = 2}, slot - 135, projection);
  }, 32);
}

std::vector<ResidualBatch> RodTerm::residual_batches() const {
  return {stretching_.residual_batch(), {5, 3, pair_count(), batches()[1].vertices}};
}

bool RodTerm::residuals(const VecX& x, double* r, double* jacobian) const {
  stretching_.residuals(x, r, jacobian);
  r += stretching_.count();
  if (jacobian) jacobian += 6 * static_cast<size_t>(stretching_.count());
  for (int p = 0; p < pair_count(); ++p) {
    const BendTwist::EdgePair at = edge_pair(p, x);
    if (!BendTwist::within_reach(at.first) || !BendTwist::within_reach(at.second)) return false;
    BendTwist::Slopes slopes;
    Eigen::Map<Vec3>{r + 3 * static_cast<size_t>(p)} = pairs_[p].root * (bends_[p].strains(at, jacobian ? &slopes : nullptr) - pairs_[p].rest);
    if (jacobian)
      Eigen::Map<Eigen::Matrix<double, 3, 15, Eigen::RowMajor>>{jacobian + 45 * static_cast<size_t>(p)} = pairs_[p].root * slopes * chain(p);
  }
  return true;
}

}  // namespace tack
