// Which pairs of objects may touch: a symmetric table over object ids, and one answer for every
// pair that the table does not hold. Contact within one object is the pair (a, a).
#pragma once

#include <algorithm>
#include <vector>

namespace tack {

class CollidingObjects {
 public:
  explicit CollidingObjects(bool otherwise = true) : otherwise_(otherwise) {}

  // Object ids are >= 0; the table grows as needed.
  void set(int a, int b, bool allowed) {
    grow(std::max(a, b) + 1);
    table_[index(a, b)] = table_[index(b, a)] = allowed;
  }
  bool allows(int a, int b) const {
    const bool known = a >= 0 && b >= 0 && a < objects_ && b < objects_;
    return known ? table_[index(a, b)] != 0 : otherwise_;
  }

 private:
  std::size_t index(int a, int b) const { return static_cast<std::size_t>(a) * objects_ + b; }
  void grow(int objects) {
    if (objects <= objects_) return;
    std::vector<char> larger(static_cast<std::size_t>(objects) * objects, otherwise_);
    for (int a = 0; a < objects_; ++a)
      std::copy_n(table_.begin() + a * objects_, objects_,
                  larger.begin() + static_cast<std::ptrdiff_t>(a) * objects);
    table_ = std::move(larger);
    objects_ = objects;
  }

  bool otherwise_;
  int objects_ = 0;
  std::vector<char> table_;
};

}  // namespace tack
