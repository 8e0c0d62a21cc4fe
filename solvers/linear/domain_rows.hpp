// The lower triangle of a block matrix by rows, ordered for a factorisation without fill on several
// threads. Vertices are divided into domains of consecutive numbers at cuts that few couplings
// cross. Vertices coupled to a later domain are separators and come last. Key idea: without the
// separators, different domains are not coupled, nor are separators of different groups. The order
// depends on the matrix alone.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct DomainRows {
  // Builds the order. Domains have at least `domain_size` vertices, more if too many vertices would
  // be separators.
  void build(const BlockMatrix& matrix, int domain_size);

  int size() const { return static_cast<int>(vertex.size()); }
  int domains() const { return static_cast<int>(domain_start.size()) - 1; }
  int groups() const { return static_cast<int>(group_start.size()) - 1; }
  int diagonal(int row) const { return row_start[row + 1] - 1; }

  struct Source {
    int block;        // of the matrix
    bool transposed;  // the block is stored on the other side of the diagonal
  };
  std::vector<int> vertex;        // of each row
  std::vector<int> domain_start;  // first row of each domain, and the end
  // First row of each group of separators, and the end; groups follow the domains.
  std::vector<int> group_start;
  std::vector<int> row_start;
  std::vector<int> column;       // of each entry of a row, ascending: the diagonal comes last
  std::vector<Source> source;    // of each entry
  std::vector<int> below_start;  // entries below the diagonal of each column
  std::vector<int> below_row;    // their rows, ascending
  std::vector<int> below_entry;  // their indices in `column`

 private:
  void separate(const BlockMatrix& matrix, const std::vector<int>& cuts);
  void group(const BlockMatrix& matrix, const std::vector<int>& separating);
  void sort_columns();
};

}  // namespace tack
