// The lower triangle of a block matrix by rows, in an order in which it can be factorised without fill on
// several threads: vertices are cut into domains of consecutive numbers where few couplings cross the cut;
// those coupled to a later domain are separators and come last. What is left of different domains is not
// coupled, nor are separators of different groups. The order depends on the matrix alone.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"

namespace tack {

struct DomainRows {
  // Domains of at least `domain_size` vertices, of more where too many of them would separate.
  void build(const BlockMatrix& matrix, int domain_size);

  int size() const { return static_cast<int>(vertex.size()); }
  int domains() const { return static_cast<int>(domain_start.size()) - 1; }
  int groups() const { return static_cast<int>(group_start.size()) - 1; }
  int diagonal(int row) const { return row_start[row + 1] - 1; }

  struct Source {
    int block;        // of the matrix
    bool transposed;  // which stands on the other side of its diagonal
  };
  std::vector<int> vertex;        // of each row
  std::vector<int> domain_start;  // rows of each domain, one more
  std::vector<int> group_start;   // rows of each group of separators, one more: they follow the domains
  std::vector<int> row_start;
  std::vector<int> column;        // of each entry of a row, ascending, so the diagonal last
  std::vector<Source> source;     // of each entry
  std::vector<int> below_start;   // what is below the diagonal of each column:
  std::vector<int> below_row;     // its rows, ascending,
  std::vector<int> below_entry;   // and which of their entries

 private:
  void separate(const BlockMatrix& matrix, const std::vector<int>& cuts);
  void group(const BlockMatrix& matrix, const std::vector<int>& separating);
  void sort_columns();
};

}  // namespace tack
