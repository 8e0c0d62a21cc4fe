// Tasks of a multifrontal factor: the subtrees, then the nodes above them, of which large ones are
// cut into tiles. A task waits for the tasks whose results it reads, so that nodes and tiles run
// on all threads at once (Hogg, Reid and Scott 2010, Design of a multicore sparse Cholesky
// factorization using DAGs). Tiles have a fixed size: the same bits for any number of threads.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/chunk_order.hpp"

namespace tack {

struct SupernodeTree;

// Tiles of a node's rows: first its own columns, then the rows below.
struct FrontTiles {
  // Rows of a tile, in own columns a multiple of the columns of triangles that are stored inverted
  // (docs/log/performance_linear_solvers.md): short chains of tasks, but long enough to compute.
  static FrontTiles of_factor(int columns, int height) { return {columns, height, 64, 96}; }
  // A solve reads each entry once: short columns of a tile would cost more than threads gain.
  static FrontTiles of_solve(int columns, int height) { return {columns, height, 96, 128}; }

  // node_height: rows, the own ones first.
  FrontTiles(int node_columns, int node_height, int own_rows, int rows_below)
      : columns(node_columns), height(node_height), own_width(own_rows), below_width(rows_below),
        own((columns + own_width - 1) / own_width),
        count(own + (height - columns + below_width - 1) / below_width) {}
  int begin(int tile) const {
    return tile < own ? tile * own_width : columns + (tile - own) * below_width;
  }
  int end(int tile) const {
    return tile < own ? std::min(begin(tile) + own_width, columns)
                      : std::min(begin(tile) + below_width, height);
  }

  int columns, height;
  int own_width, below_width;  // rows of a tile
  int own;                     // tiles of the node's own columns
  int count;                   // tiles of all rows
};

struct FrontTask {
  enum class Kind : char {
    subtree,  // all nodes of subtree `node`; in a solve: forwards
    whole,    // a node; in a solve: forwards
    // Factorisation of a node in tiles.
    begin,    // memory
    open,     // entries of the matrix and children, in the columns of tile `column`
    release,  // memory of the children
    panel,    // tile (row, column) of the factor
    update,   // tile (row, column) of the Schur complement
    // Solve with a node in tiles: forwards, then backwards.
    gather,            // contributions of the children
    lower,             // tile (row, column) of the own columns; row = column: a triangle
    subtract,          // rows below in tile `row`
    scatter,           // solution in the rows below
    transposed_below,  // rows below to the columns of tile `column`
    transposed,        // tile (row, column) of the own columns, transposed
    whole_back,
    subtree_back,
  };
  Kind kind;
  int node;  // subtrees: the number of the subtree
  int row = 0, column = 0;
};

struct FrontTasks {
  std::vector<FrontTask> tasks;
  ChunkOrder order;  // chunk: index of a task
};

FrontTasks tasks_of_factorisation(const SupernodeTree& tree);
FrontTasks tasks_of_solve(const SupernodeTree& tree);

}  // namespace tack
