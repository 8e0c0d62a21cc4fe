// Cursor over a list that is sorted by key: finds ascending keys in one pass.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

namespace tack {

// Entry has a key() of two integers.
template <class Entry>
class SortedCursor {
 public:
  // The list must outlive this.
  explicit SortedCursor(const std::vector<Entry>& list) : list_(list) {}

  // Returns the entry of a key, null if there is none. key: not below the previous one.
  const Entry* find(const std::array<int, 2>& key) {
    if (!begun_) {
      next_ =
          std::lower_bound(list_.begin(), list_.end(), key,
                           [](const Entry& e, const std::array<int, 2>& k) { return e.key() < k; });
      begun_ = true;
    }
    const std::int64_t wanted = number(key);
    while (next_ != list_.end() && number(next_->key()) < wanted) ++next_;
    return next_ != list_.end() && number(next_->key()) == wanted ? &*next_ : nullptr;
  }

 private:
  // Returns an integer that orders as the keys do.
  static std::int64_t number(const std::array<int, 2>& key) {
    return (static_cast<std::int64_t>(key[0]) << 32) + key[1];
  }

  const std::vector<Entry>& list_;
  typename std::vector<Entry>::const_iterator next_;
  bool begun_ = false;
};

}  // namespace tack
