// Collision filter of pairs of objects: a symmetric table over classes of objects, and a default
// for pairs outside the table. Contact within one object is the pair (a, a).
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/broad_phase/object_classes.hpp"

namespace tack {

class CollidingObjects {
 public:
  // Every object is a class of its own; `otherwise` is the default.
  explicit CollidingObjects(bool otherwise = true) : otherwise_(otherwise), classes_({}) {}
  // set(a, b, ...) holds for all objects of the classes of a and b.
  explicit CollidingObjects(ObjectClasses classes)
      : otherwise_(true), classes_(std::move(classes)), table_(classes_.entries(), true) {}

  // Object ids are >= 0. The table grows as needed; new objects are classes of their own.
  void set(int a, int b, bool allowed) {
    grow(std::max(a, b) + 1);
    table_[classes_.index(a, b)] = table_[classes_.index(b, a)] = allowed;
  }
  bool allows(int a, int b) const {
    const int n = classes_.objects();
    const bool known = a >= 0 && b >= 0 && a < n && b < n;
    return known ? table_[classes_.index(a, b)] != 0 : otherwise_;
  }

 private:
  void grow(int objects) {
    if (objects <= classes_.objects()) return;
    const ObjectClasses larger = ObjectClasses::single(objects);
    std::vector<char> table(larger.entries(), otherwise_);
    for (int a = 0; a < classes_.objects(); ++a)
      for (int b = 0; b < classes_.objects(); ++b)
        table[larger.index(a, b)] = table_[classes_.index(a, b)];
    table_ = std::move(table);
    classes_ = larger;
  }

  bool otherwise_;
  ObjectClasses classes_;
  std::vector<char> table_;
};

}  // namespace tack
