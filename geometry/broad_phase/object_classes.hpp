// Classes of objects with equal contact settings, so that the size of tables over pairs grows with
// the number of classes, not of objects. Each class has two entries with itself: one for two of its
// objects, one for an object and itself.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace tack {

class ObjectClasses {
 public:
  // class_of: per object, numbered from 0 by first occurrence.
  explicit ObjectClasses(std::vector<int> class_of) : of_(std::move(class_of)) {
    for (const int c : of_) {
      if (c == count()) members_.push_back(0);
      ++members_[c];
    }
  }
  // Returns a class of its own for each object.
  static ObjectClasses single(int objects) {
    std::vector<int> all(objects);
    std::iota(all.begin(), all.end(), 0);
    return ObjectClasses(std::move(all));
  }

  int objects() const { return static_cast<int>(of_.size()); }
  int count() const { return static_cast<int>(members_.size()); }
  int of(int object) const { return of_[object]; }

  // Returns the index of objects (a, b) in a table of `entries()`.
  std::size_t index(int a, int b) const {
    const int n = count();
    return static_cast<std::size_t>(of_[a]) * (n + 1) + (a == b ? n : of_[b]);
  }
  std::size_t entries() const { return static_cast<std::size_t>(count()) * (count() + 1); }

  // Returns the first pair of objects a <= b of each unordered pair of classes that has one,
  // ascending.
  std::vector<std::pair<int, int>> examples() const;
  // Returns the number of unordered pairs of objects that share the entry of (a, b).
  double pairs_like(int a, int b) const {
    const double first = members_[of_[a]], second = members_[of_[b]];
    if (a == b) return first;
    return of_[a] == of_[b] ? first * (first - 1) / 2 : first * second;
  }

 private:
  std::vector<int> of_, members_;  // per object; per class
};

}  // namespace tack
