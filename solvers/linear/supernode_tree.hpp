// Structure of a sparse Cholesky factor: supernodes (runs of columns that share their rows below
// the diagonal), their elimination tree, and the targets of the matrix's blocks. Columns and rows
// are numbered after the fill-reducing permutation. The tree is cut into independent subtrees,
// which threads process in parallel, and a top processed after them.
#pragma once

#include <cstddef>
#include <vector>

#include "framework/core/block_matrix.hpp"
#include "solvers/linear/cholmod_session.hpp"

namespace tack {

struct SupernodeTree {
  // factor: a supernodal analysis of the pattern of blocks.
  SupernodeTree(const cholmod_factor& factor, const BlockMatrix& matrix);

  int nodes() const { return static_cast<int>(parent.size()); }
  int columns(int s) const { return first[s + 1] - first[s]; }
  int height(int s) const { return row_start[s + 1] - row_start[s]; }
  int below(int s) const { return height(s) - columns(s); }
  const int* rows_below(int s) const { return rows.data() + row_start[s] + columns(s); }

  int size = 0;                      // unknowns
  std::vector<int> permutation;      // new -> old
  std::vector<int> first;            // first column of each node
  std::vector<int> row_start, rows;  // rows of each node, ascending, its own columns first
  std::vector<int> position;         // aligned with rows: index of a row in the parent's rows
  std::vector<int> parent;           // -1: a root; parents follow their children
  std::vector<int> child_start, children;
  // First entry of each node's columns (height x columns), and the end.
  std::vector<std::ptrdiff_t> panel;

  // Targets of the matrix's blocks, sorted by node: entry (i, j) goes to at + i + j * height(node).
  struct PanelEntry {
    int block;
    bool transposed;
    std::ptrdiff_t at;
  };
  std::vector<int> entry_start;
  std::vector<PanelEntry> entries;

  // Nodes first..root form a subtree. `local` (aligned with rows) numbers the rows of its nodes
  // within it: its columns, then the rows below its root. For nodes of `top` it holds the rows.
  struct Subtree {
    int first, root;
  };
  std::vector<Subtree> subtrees;
  std::vector<int> top;
  std::vector<std::vector<int>> top_levels;  // the top by levels; nodes of a level are independent
  std::vector<int> local;

 private:
  void read(const cholmod_factor& factor);
  void connect();
  void locate_blocks(const BlockMatrix& matrix);
  void cut();
  void sort_top();
  void number_locally(const Subtree& tree);
};

}  // namespace tack
