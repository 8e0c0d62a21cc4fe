// Memory for numbers that a parallel loop writes before anything reads them. A std::vector would
// set all of them to zero first, in one thread, which then also waits for the fresh pages.
#pragma once

#include <cstddef>
#include <memory>

namespace tack {

/// An array without initial values. T: trivial.
template <class T>
class UnsetArray {
 public:
  /// Makes room for `size` numbers. All values are lost if that takes new memory.
  void resize(std::size_t size) {
    if (size <= capacity_) return;
    constexpr std::size_t spare = 8;  // fraction of the size: patterns of contacts grow and shrink
    capacity_ = size + size / spare;
    data_.reset();
    data_ = std::make_unique_for_overwrite<T[]>(capacity_);
  }
  T* data() { return data_.get(); }
  const T* data() const { return data_.get(); }

 private:
  std::unique_ptr<T[]> data_;
  std::size_t capacity_ = 0;
};

}  // namespace tack
