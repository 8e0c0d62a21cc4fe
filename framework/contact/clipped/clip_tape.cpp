#include "framework/contact/clipped/clip_tape.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tack {
namespace {

// Distance from a line, per its length, below which round-off decides on which side a crossing lies.
constexpr double round_off = 1e-12;

}  // namespace

PlaneLine::PlaneLine(const Vec2& from, const Vec2& to)
    : begin(from), end(to), slope_begin(Vec2::Zero()), slope_end(Vec2::Zero()) {
  const Vec2 along = to - from;
  length = along.norm();
  inward = Vec2(-along.y(), along.x()) / length;
}

Vec2 PlaneLine::add_slope(const Vec3& at, double by_distance) {
  const double fraction = (end - begin).dot(at.head<2>() - begin) / (length * length);
  slope_begin -= (1 - fraction) * by_distance * inward;
  slope_end -= fraction * by_distance * inward;
  return by_distance * inward;
}

template <class Side>
void ClipTape::cut(const ClipPiece& piece, int line, const Side& side, ClipPiece& beyond, ClipPiece* within) {
  beyond.clear();
  if (within) within->clear();
  const int corners = static_cast<int>(piece.size());
  if (corners < 3) return;
  std::pair<bool, double> next = side(nodes[piece[0].node]);
  const std::pair<bool, double> first = next;
  for (int i = 0; i < corners; ++i) {
    const auto [in, here] = next;
    const PieceCorner corner = piece[i], after = piece[(i + 1) % corners];
    next = i + 1 < corners ? side(nodes[after.node]) : first;
    if (in) beyond.push_back(corner);
    else if (within) within->push_back(corner);
    if (in == next.first) continue;
    const double difference = here - next.second;
    const double t = difference == 0 ? 0 : here / difference;
    ClipNode crossing{nodes[corner.node].at + t * (nodes[after.node].at - nodes[corner.node].at), Vec3::Zero()};
    crossing.from = corner.node;
    crossing.to = after.node;
    crossing.line = line;
    crossing.ties = nodes[corner.node].ties & nodes[after.node].ties;
    crossing.shared_ties = nodes[corner.node].shared_ties & nodes[after.node].shared_ties;
    crossing.t = t;
    if (difference != 0) {
      crossing.rate_from = -next.second / (difference * difference);
      crossing.rate_to = here / (difference * difference);
    }
    nodes.push_back(crossing);
    const int node = static_cast<int>(nodes.size()) - 1;
    beyond.push_back({node, in ? -1 : corner.side});
    if (within) within->push_back({node, in ? corner.side : -1});
  }
  if (beyond.size() < 3) beyond.clear();
  if (within && within->size() < 3) within->clear();
}

namespace {

std::pair<bool, double> side_of(bool beyond, double distance) {
  return {beyond, beyond ? std::max(distance, 0.0) : std::min(distance, 0.0)};
}

}  // namespace

void ClipTape::keep_inside(const ClipPiece& piece, int line, bool owns, ClipPiece& inside) {
  const PlaneLine& by = lines[line];
  const auto tied = [line](const ClipNode& node) { return (node.ties >> line & 1) != 0; };
  const std::size_t older = nodes.size();
  cut(piece, line, [&](const ClipNode& node) {
    const double distance = by.distance(node.at);
    if ((node.shared_ties >> line & 1) != 0) return std::pair(owns, distance);
    return side_of(tied(node) || std::abs(distance) < round_off * by.length ? owns : distance > 0, distance);
  }, inside, nullptr);
  // A crossing at a tied end has the ties of this end with other lines.
  for (std::size_t i = older; i < nodes.size(); ++i)
    for (const int end : {nodes[i].from, nodes[i].to})
      if (tied(nodes[end])) {
        nodes[i].ties |= nodes[end].ties;
        nodes[i].shared_ties |= nodes[end].shared_ties;
      }
}

void ClipTape::cut_by_line(const ClipPiece& piece, int line, double distance, double tolerance,
                           ClipPiece& beyond, ClipPiece& within) {
  const PlaneLine& by = lines[line];
  cut(piece, line, [&](const ClipNode& node) {
    const double from_cut = by.distance(node.at) - distance;
    return side_of(from_cut > -tolerance, from_cut);
  }, beyond, &within);
}

void ClipTape::cut_by_level(const ClipPiece& piece, double level, ClipPiece& above, ClipPiece& below) {
  cut(piece, -1, [&](const ClipNode& node) { return side_of(node.at.z() > level, node.at.z() - level); }, above, &below);
}

void ClipTape::pass_back() {
  for (int i = static_cast<int>(nodes.size()) - 1; i >= 0; --i) {
    const ClipNode node = nodes[i];
    if (node.from < 0) continue;
    ClipNode &from = nodes[node.from], &to = nodes[node.to];
    from.slope += (1 - node.t) * node.slope;
    to.slope += node.t * node.slope;
    const double by_t = node.slope.dot(to.at - from.at);
    const double by_from = by_t * node.rate_from, by_to = by_t * node.rate_to;
    if (node.line >= 0) {
      from.slope.head<2>() += lines[node.line].add_slope(from.at, by_from);
      to.slope.head<2>() += lines[node.line].add_slope(to.at, by_to);
    } else {
      from.slope.z() += by_from;
      to.slope.z() += by_to;
    }
  }
}

}  // namespace tack
