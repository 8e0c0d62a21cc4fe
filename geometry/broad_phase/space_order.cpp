#include "geometry/broad_phase/space_order.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "geometry/parallel.hpp"
#include "geometry/parallel_sort.hpp"

namespace tack {
namespace {

constexpr int boxes_per_chunk = 1024;

// Inserts two zero bits before each of the 21 low bits.
std::uint64_t spread(std::uint64_t bits) {
  bits = (bits | bits << 32) & 0x001f00000000ffffULL;
  bits = (bits | bits << 16) & 0x001f0000ff0000ffULL;
  bits = (bits | bits << 8) & 0x100f00f00f00f00fULL;
  bits = (bits | bits << 4) & 0x10c30c30c30c30c3ULL;
  return (bits | bits << 2) & 0x1249249249249249ULL;
}

std::uint64_t morton_code(const Vec3& cell) {
  std::uint64_t code = 0;
  for (int axis = 0; axis < 3; ++axis)
    code |= spread(static_cast<std::uint64_t>(cell[axis])) << axis;
  return code;
}

Vec3 centre(const Aabb& box) { return 0.5 * (box.lo + box.hi); }

}  // namespace

std::vector<int> space_order(const std::vector<Aabb>& boxes, const std::vector<int>& rigid_group) {
  const int n = static_cast<int>(boxes.size());
  std::vector<Aabb> of_chunk(chunk_count(n, boxes_per_chunk));
  for_each_chunk(n, [&](int c, int first, int last) {
    for (int i = first; i < last; ++i) of_chunk[c].include(centre(boxes[i]));
  }, boxes_per_chunk);
  Aabb all;
  for (const Aabb& box : of_chunk) all.include(box);
  constexpr double cells = (1 << 21) - 1;
  const double extent = boxes.empty() ? 0.0 : (all.hi - all.lo).maxCoeff();
  const double scale = extent > 0.0 ? cells / extent : 0.0;

  const auto code = [&](const Vec3& x) { return morton_code((scale * (x - all.lo)).cwiseMin(cells)); };

  // Boxes of a rigid group are placed at the first of them, in Morton order among themselves.
  std::vector<std::uint64_t> first_of(rigid_group.empty() ? 0 : *std::max_element(rigid_group.begin(), rigid_group.end()) + 1);
  for (int i = static_cast<int>(rigid_group.size()) - 1; i >= 0; --i)
    if (rigid_group[i] >= 0) first_of[rigid_group[i]] = code(centre(boxes[i]));
  std::vector<std::tuple<std::uint64_t, int, std::uint64_t, int>> keys(boxes.size());
  for_each(n, [&](int i) {
    const std::uint64_t own = code(centre(boxes[i]));
    const int of = rigid_group.empty() ? -1 : rigid_group[i];
    keys[i] = {of >= 0 ? first_of[of] : own, of, own, i};
  }, boxes_per_chunk);
  parallel_sort(keys);

  std::vector<int> order(boxes.size());
  for_each(n, [&](int i) { order[i] = std::get<3>(keys[i]); }, boxes_per_chunk);
  return order;
}

}  // namespace tack
