// The sparse constraint rows J: each row has one 3-vector per block of unknowns that it touches.
#pragma once

#include <span>
#include <vector>

#include "framework/core/dof_map.hpp"

namespace tack {

class Rows {
 public:
  struct Entry {
    int block;
    Vec3 along;
  };

  int count() const { return static_cast<int>(start_.size()) - 1; }
  std::span<const Entry> entries(int row) const {
    return {entries_.data() + start_[row], entries_.data() + start_[row + 1]};
  }

  // Adds the coefficient of vertex v in direction `along` to the row under construction.
  void add(const DofMap& dofs, int v, const Vec3& along) {
    if (dofs.block(v) >= 0) {
      add_block(dofs.block(v), along);
    } else if (dofs.mixed(v)) {
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v))
        add_block(entry.index, entry.weight * along);
    }
  }
  void finish() { start_.push_back(static_cast<int>(entries_.size())); }

  // times: J v of one row. add_transposed: column += factor J^T.
  template <class Vector>
  double times(int row, const Vector& v) const {
    double sum = 0;
    for (const Entry& e : entries(row)) sum += e.along.dot(v.template segment<3>(3 * e.block));
    return sum;
  }
  template <class Vector>
  void add_transposed(int row, double factor, Vector&& column) const {
    for (const Entry& e : entries(row)) column.template segment<3>(3 * e.block) += factor * e.along;
  }

 private:
  void add_block(int block, const Vec3& along) {
    for (size_t i = start_.back(); i < entries_.size(); ++i)
      if (entries_[i].block == block) {
        entries_[i].along += along;
        return;
      }
    entries_.push_back({block, along});
  }

  std::vector<int> start_{0};
  std::vector<Entry> entries_;
};

}  // namespace tack
