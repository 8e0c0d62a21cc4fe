// Parts of a problem: some of the stencils of a term, in a numbering of their own vertices.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace tack {

/// Numbering of a few vertices among all: 0, 1, ... in the order in which they are added. A hash
/// table with open addressing.
class LocalVertices {
 public:
  int count() const { return static_cast<int>(global_.size()); }
  const std::vector<int>& all() const { return global_; }  // global vertices in their order
  int global(int local) const { return global_[local]; }
  /// Returns the number of a global vertex; -1: it has none.
  int find(int global) const {
    if (slots_.empty()) return -1;
    for (std::size_t i = slot(global);; i = (i + 1) & (slots_.size() - 1)) {
      if (slots_[i] < 0) return -1;
      if (global_[slots_[i]] == global) return slots_[i];
    }
  }
  /// Returns the number of a global vertex, which it gets if it has none.
  int add(int global) {
    if (const int known = find(global); known >= 0) return known;
    if (2 * (global_.size() + 1) > slots_.size()) grow();
    global_.push_back(global);
    return place(count() - 1);
  }

 private:
  std::size_t slot(int global) const {  // multiplicative hashing (Knuth)
    return (static_cast<std::uint32_t>(global) * 2654435761u) & (slots_.size() - 1);
  }
  int place(int local) {
    std::size_t i = slot(global_[local]);
    while (slots_[i] >= 0) i = (i + 1) & (slots_.size() - 1);
    return slots_[i] = local;
  }
  void grow() {
    slots_.assign(slots_.empty() ? 64 : 2 * slots_.size(), -1);
    for (int i = 0; i < count(); ++i) place(i);
  }

  std::vector<int> global_;
  std::vector<int> slots_;  // local numbers; -1: free; their count is a power of two
};

/// Chosen stencils of a term, for a local problem.
struct StencilChoice {
  std::span<const std::vector<int>> stencils;  // of each batch of the term, ascending
  const LocalVertices& vertices;               // numbers all vertices of these stencils

  /// Returns the local vertices of a stencil of `arity` global ones.
  template <class Stencil>
  Stencil local(Stencil stencil) const {
    for (int& v : stencil) v = vertices.find(v);
    return stencil;
  }
};

}  // namespace tack
