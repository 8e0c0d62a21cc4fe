// Objects that are alike in contact share a class, so that tables over pairs are as large as there are kinds of objects, not
// as there are objects. Two objects of one class and an object with itself are told apart.
#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace tack {

class ObjectClasses {
 public:
  // Per object, numbered from 0 in the order in which they come up first.
  explicit ObjectClasses(std::vector<int> class_of) : of_(std::move(class_of)) {
    for (const int c : of_) {
      if (c == count()) members_.push_back(0);
      ++members_[c];
    }
  }
  // A class for each.
  static ObjectClasses single(int objects) {
    std::vector<int> all(objects);
    std::iota(all.begin(), all.end(), 0);
    return ObjectClasses(std::move(all));
  }

  int objects() const { return static_cast<int>(of_.size()); }
  int count() const { return static_cast<int>(members_.size()); }
  int of(int object) const { return of_[object]; }

  // The place of objects (a, b) in a table of `entries`.
  std::size_t index(int a, int b) const {
    const int n = count();
    return static_cast<std::size_t>(of_[a]) * (n + 1) + (a == b ? n : of_[b]);
  }
  std::size_t entries() const { return static_cast<std::size_t>(count()) * (count() + 1); }

  // For each unordered pair of classes that has one, its first pair of objects a <= b, ascending.
  std::vector<std::pair<int, int>> examples() const;
  // How many pairs of objects, in any order, share the entry of (a, b).
  double pairs_like(int a, int b) const {
    const double first = members_[of_[a]], second = members_[of_[b]];
    if (a == b) return first;
    return of_[a] == of_[b] ? first * (first - 1) / 2 : first * second;
  }

 private:
  std::vector<int> of_, members_;  // per object; per class
};

}  // namespace tack
