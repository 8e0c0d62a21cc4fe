// The lower triangle of a block matrix by rows, ordered for an incomplete factorisation on several
// threads: block multicolour ordering (Iwashita, Nakashima and Takahashi 2012). Vertices are
// divided into compact domains by recursive coordinate bisection (Berger and Bokhari 1987), and the
// domains coloured. Key idea: domains of one colour are not coupled, so that threads process them
// together, colour after colour; inside a domain, rows keep the order of the mesh, in which an
// incomplete factor is good. The order does not depend on the number of threads.
#pragma once

#include <vector>

#include "framework/core/block_matrix.hpp"
#include "geometry/parallel.hpp"

namespace tack {

struct DomainRows {
  // Builds the order. The domains are those of the first matrix with these components; without
  // positions, they are runs of consecutive vertices.
  // domain_size: largest number of vertices of a domain.
  void build(const BlockMatrix& matrix, int domain_size);

  int size() const { return static_cast<int>(vertex.size()); }
  int domains() const { return static_cast<int>(domain_start.size()) - 1; }
  int colors() const { return static_cast<int>(color_start.size()) - 1; }
  int diagonal(int row) const { return row_start[row + 1] - 1; }

  // Calls body(domain, first row, last row) for each domain of a colour, on all threads.
  template <class Body>
  void for_each_domain(int color, const Body& body) const {
    const int first = color_start[color];
    for_each(
        color_start[color + 1] - first,
        [&](int i) { body(first + i, domain_start[first + i], domain_start[first + i + 1]); }, 1);
  }

  struct Source {
    int block;        // of the matrix
    bool transposed;  // the block is stored on the other side of the diagonal
  };
  std::vector<int> vertex;        // of each row
  std::vector<int> domain_start;  // first row of each domain, and the end
  std::vector<int> color_start;   // first domain of each colour, and the end
  std::vector<int> row_start;
  std::vector<int> column;       // of each entry of a row, ascending: the diagonal comes last
  std::vector<Source> source;    // of each entry
  std::vector<int> below_start;  // entries below the diagonal of each column
  std::vector<int> below_row;    // their rows, ascending
  std::vector<int> below_entry;  // their indices in `column`

 private:
  struct LeftBlocks;
  void divide(const BlockMatrix& matrix, int domain_size);
  void bisect(const VecX& positions, int first, int last, int domain, int domains);
  void color_domains(const BlockMatrix& matrix);
  void list_rows(const BlockMatrix& matrix, const LeftBlocks& left);

  std::vector<int> order_;        // vertices by domains, before these are sorted by colours
  std::vector<int> order_start_;  // first vertex of each domain in order_, and the end
  std::vector<int> component_;    // BlockMatrix::component when the domains were made
};

}  // namespace tack
