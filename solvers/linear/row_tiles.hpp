// Runs of consecutive rows, the units of work of threads in triangular solves, and which tiles each
// one waits for. Key idea: in a mesh that is numbered line by line, tiles are lines, and those of a
// diagonal front do not wait for each other (wavefronts: Anderson and Saad 1989). Lines of a sheet
// are cut into several tiles. A strip of tiles that wait for each other, a layer of a solid, is the
// work of one thread. Rows keep the order of the mesh, in which an incomplete factor is good.
#pragma once

#include <vector>

#include "geometry/chunk_order.hpp"
#include "solvers/linear/lower_rows.hpp"

namespace tack {

struct RowTiles {
  explicit RowTiles(const LowerRows& rows);

  int count() const { return static_cast<int>(start.size()) - 1; }
  // Returns the chunks of solves with L and then L^T: the tiles forwards, then the tiles backwards.
  ChunkOrder order() const;

  std::vector<int> start;  // first row of each tile, and the end
  // Tiles that each tile waits for. Those that one of these waits for itself are left out (Park et
  // al. 2014).
  ChunkOrder before;

 private:
  void cut(const LowerRows& rows, int limit);
  void connect(const LowerRows& rows);
};

}  // namespace tack
