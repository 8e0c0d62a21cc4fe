// The lower triangle of a block matrix by rows, in an order in which it can be factorised without fill on
// several threads: vertices are cut into domains of consecutive numbers; those coupled to a later domain
// are separators and come last. What is left of different domains is not coupled. The order depends on
// the matrix alone.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct DomainRows {
  void build(const BlockMatrix& matrix, int domain_size);

  int size() const { return static_cast<int>(vertex.size()); }
  int domains() const { return static_cast<int>(domain_start.size()) - 1; }
  int separators() const { return domain_start.back(); }  // the first of their rows, which end at size()
  int diagonal(int row) const { return row_start[row + 1] - 1; }

  struct Entry {
    int column;
    int block;        // of the matrix
    bool transposed;  // which stands on the other side of its diagonal
  };
  std::vector<int> vertex;        // of each row
  std::vector<int> domain_start;  // rows of each domain, one more
  std::vector<int> row_start;
  std::vector<Entry> entries;     // of each row, columns ascending, so the diagonal last
};

}  // namespace tack
