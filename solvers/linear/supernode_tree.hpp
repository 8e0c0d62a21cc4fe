// Structure of a sparse Cholesky factor: supernodes (runs of columns that share their rows below
// the diagonal), their elimination tree, and the targets of the matrix's blocks. Columns and rows
// are numbered after the fill-reducing permutation. The tree is cut into independent subtrees,
// which threads process in parallel, and a top processed after them.
#pragma once

#include <cstddef>
#include <vector>

#include "framework/core/block_matrix.hpp"
#include "solvers/linear/cholmod_session.hpp"
#include "solvers/linear/front_tasks.hpp"

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

  // Targets of the matrix's blocks, sorted by block column of the factor (entry_start): entry (i,
  // j) goes to at + i + j * height(node).
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
    double work;  // products and sums of its factorisation, about
  };
  std::vector<Subtree> subtrees;
  std::vector<int> top;  // ascending: parents follow their children
  std::vector<int> local;
  FrontTasks factor_tasks, solve_tasks;

 private:
  void read(const cholmod_factor& factor);
  void connect();
  void locate_blocks(const BlockMatrix& matrix);
  void cut();
  void number_locally(const Subtree& subtree);
};

}  // namespace tack
