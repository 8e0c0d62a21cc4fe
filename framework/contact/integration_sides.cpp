#include "framework/contact/integration_sides.hpp"

#include <algorithm>

namespace tack {
namespace {

constexpr double as_much = 0.9;       // of the larger capture
constexpr double nearly_as_much = 0.7;  // likewise, to keep a side

}  // namespace

IntegrationSides::IntegrationSides(const PairTable& pairs)
    : pairs_(pairs), objects_(pairs.objects()), captures_(objects_ * objects_), integrates_(objects_ * objects_) {
  choose();
}

void IntegrationSides::clear() { std::fill(captures_.begin(), captures_.end(), Capture{}); }

bool IntegrationSides::first_integrates(int a, int b) const {
  const Capture &first = captures_[a * objects_ + b], &second = captures_[b * objects_ + a];
  if (!before_.empty()) {
    const bool was_first = before_[a * objects_ + b] != 0;
    if ((was_first ? first : second).area >= nearly_as_much * std::max(first.area, second.area)) return was_first;
  }
  const double much = as_much * std::max(first.area, second.area);
  if (first.area < much) return false;
  if (second.area < much) return true;
  if (first.triangles != second.triangles) return first.triangles > second.triangles;
  return pairs_.point(a, b).preferred;
}

void IntegrationSides::choose() {
  for (int a = 0; a < objects_; ++a)
    for (int b = a; b < objects_; ++b) {
      const PairRole& role = pairs_.point(a, b);
      const bool first = role.automatic ? first_integrates(a, b) : role.facing;
      integrates_[a * objects_ + b] = first;
      if (a != b) integrates_[b * objects_ + a] = role.automatic ? !first : pairs_.point(b, a).facing;
    }
}

}  // namespace tack
