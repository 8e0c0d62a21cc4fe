#include "geometry/broad_phase/bvh.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <utility>

#include "geometry/broad_phase/space_order.hpp"
#include "geometry/errors.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int groups_per_chunk = 64;

}  // namespace

Bvh::Bvh(const std::vector<Aabb>& boxes, const std::vector<char>& active, const std::vector<int>& rigid_group)
    : primitive_active_(active) {
  if (!rigid_group.empty() && rigid_group.size() != boxes.size())
    throw InputError(fmt::format("Bvh: {} boxes but {} rigid groups; give one a box or none", boxes.size(), rigid_group.size()));
  if (std::any_of(rigid_group.begin(), rigid_group.end(), [](int k) { return k >= 0; })) primitive_group_ = rigid_group;
  if (!active.empty() && active.size() != boxes.size())
    throw InputError(fmt::format("Bvh: {} boxes but {} activity flags; give one flag a box or none",
                                 boxes.size(), active.size()));
  if (active.empty()) primitive_active_.assign(boxes.size(), 1);
  lay_out_levels();
  order_by_position(boxes);
}

bool Bvh::update(const std::vector<Aabb>& boxes, double growth) {
  if (boxes.size() != primitive_active_.size())
    throw InputError(fmt::format("Bvh: updated with {} boxes but built over {}; build a new tree",
                                 boxes.size(), size()));
  fill(boxes);
  if (node_area() <= growth * built_area_) return false;
  order_by_position(boxes);
  return true;
}

void Bvh::set_active(std::vector<char> active) {
  if (active.size() != primitive_active_.size())
    throw InputError(fmt::format("Bvh: {} boxes but {} activity flags; give one flag a box", size(), active.size()));
  primitive_active_ = std::move(active);
}

void Bvh::order_by_position(const std::vector<Aabb>& boxes) {
  order_ = space_order(boxes, primitive_group_);
  order_.resize((boxes.size() + Box8::width - 1) / Box8::width * Box8::width, -1);
  fill(boxes);
  fill_rigid_groups();
  built_area_ = node_area();
}

void Bvh::lay_out_levels() {
  int count = size();
  while (count > 0) {
    const int groups = (count + Box8::width - 1) / Box8::width;
    level_begin_.push_back(level_begin_.back() + groups);
    count = groups > 1 ? groups : 0;
  }
  boxes_.resize(level_begin_.back());
  bounds_.resize(level_begin_.back());
  active_.resize(level_begin_.back());
}

void Bvh::fill_rigid_groups() {
  if (primitive_group_.empty()) return;
  rigid_group_.assign(level_begin_.back(), -1);
  for (int level = 0; level < levels(); ++level) {
    const int count = level == 0 ? size() : groups(level - 1);
    const auto of = [&](int child) {
      return level == 0 ? primitive_group_[order_[child]] : rigid_group_[level_begin_[level - 1] + child];
    };
    for_each(groups(level), [&](int group) {
      const int first = group * Box8::width, last = std::min(first + Box8::width, count);
      int common = of(first);
      for (int child = first + 1; child < last; ++child)
        if (of(child) != common) common = -1;
      rigid_group_[level_begin_[level] + group] = common;
    }, groups_per_chunk);
  }
}

void Bvh::fill(const std::vector<Aabb>& boxes) {
  for (int level = 0; level < levels(); ++level)
    for_each(groups(level), [&](int group) { fill_group(boxes, level, group); }, groups_per_chunk);
}

void Bvh::fill_group(const std::vector<Aabb>& boxes, int level, int group) {
  const int node = level_begin_[level] + group;
  const int count = level == 0 ? size() : groups(level - 1);
  Aabb bound;
  unsigned active = 0;
  for (int lane = 0; lane < Box8::width; ++lane) {
    const int child = group * Box8::width + lane;
    const bool used = child < count;
    Aabb box;
    if (used) box = level == 0 ? boxes[order_[child]] : bounds_[level_begin_[level - 1] + child];
    if (used && (level == 0 ? primitive_active_[order_[child]] != 0
                            : active_[level_begin_[level - 1] + child] != 0))
      active |= 1u << lane;
    boxes_[node].set(lane, box);
    bound.include(box);
  }
  bounds_[node] = bound;
  active_[node] = static_cast<std::uint8_t>(active);
}

double Bvh::node_area() const {
  return sum_chunks(static_cast<int>(bounds_.size()), [&](int first, int last) {
    double sum = 0;
    for (int node = first; node < last; ++node) sum += bounds_[node].half_area();
    return sum;
  }, 4096);
}

}  // namespace tack
