// An array whose numbers are not initialised, for results that threads write: each page of new
// memory is then mapped by the thread that writes it first.
#pragma once

#include <cstddef>
#include <memory>

namespace tack {

template <class T>
class Buffer {
 public:
  // Makes room for `size` numbers; the old ones are lost if the array grows.
  void resize(std::size_t size) {
    if (size <= capacity_) return;
    capacity_ = size + size / 8;
    numbers_ = std::unique_ptr<T[]>(new T[capacity_]);
  }
  T* data() { return numbers_.get(); }
  const T* data() const { return numbers_.get(); }

 private:
  std::unique_ptr<T[]> numbers_;
  std::size_t capacity_ = 0;
};

}  // namespace tack
