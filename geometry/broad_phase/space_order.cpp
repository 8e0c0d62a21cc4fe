#include "geometry/broad_phase/space_order.hpp"

#include <tbb/parallel_sort.h>

#include <algorithm>
#include <cstdint>
#include <utility>

#include "geometry/parallel.hpp"

namespace tack {
namespace {

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

}  // namespace

std::vector<int> space_order(const std::vector<Aabb>& boxes) {
  Aabb all;
  for (const Aabb& box : boxes) all.include(Vec3(0.5 * (box.lo + box.hi)));
  constexpr double cells = (1 << 21) - 1;
  const double extent = boxes.empty() ? 0.0 : (all.hi - all.lo).maxCoeff();
  const double scale = extent > 0.0 ? cells / extent : 0.0;

  std::vector<std::pair<std::uint64_t, int>> keys(boxes.size());
  for_each(static_cast<int>(boxes.size()), [&](int i) {
    const Vec3 offset = 0.5 * (boxes[i].lo + boxes[i].hi) - all.lo;
    keys[i] = {morton_code((scale * offset).cwiseMin(cells)), i};
  }, 4096);
  tbb::parallel_sort(keys.begin(), keys.end());

  std::vector<int> order(boxes.size());
  std::transform(keys.begin(), keys.end(), order.begin(),
                 [](const auto& key) { return key.second; });
  return order;
}

}  // namespace tack
