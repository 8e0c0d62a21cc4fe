// Maxima and marks that several threads take at the same time. Neither depends on their order.
#pragma once

#include <atomic>

namespace tack {

/// largest <- max(largest, value). A value that is not a number changes nothing.
inline void raise(double& largest, double value) {
  const std::atomic_ref<double> shared(largest);
  double now = shared.load(std::memory_order_relaxed);
  while (now < value && !shared.compare_exchange_weak(now, value, std::memory_order_relaxed)) {
  }
}

/// Sets the flag.
inline void mark(char& flag) {
  const std::atomic_ref<char> shared(flag);
  if (!shared.load(std::memory_order_relaxed)) shared.store(1, std::memory_order_relaxed);
}

/// Sets these bits.
inline void mark(char& bits, char set) {
  const std::atomic_ref<char> shared(bits);
  if ((shared.load(std::memory_order_relaxed) & set) != set)
    shared.fetch_or(set, std::memory_order_relaxed);
}

}  // namespace tack
