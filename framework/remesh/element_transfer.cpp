#include "framework/remesh/element_transfer.hpp"

#include <Eigen/LU>

#include "geometry/tet_edges.hpp"
#include "geometry/tets/tet_overlap.hpp"

namespace tack {

std::vector<TetContent> transfer_contents(const TetCorners& from, const std::vector<TetContent>& contents, const TetCorners& to) {
  std::vector<TetContent> all(to.size());
  for (const TetOverlap& o : tet_overlaps(to, from)) {
    const TetContent& old = contents[o.other];
    const double volume = old.volume * o.volume / (edges_of(from[o.other]).determinant() / 6);
    TetContent& now = all[o.one];
    now.volume += volume;
    now.strain += volume * old.strain;
    now.flow += volume * old.flow;
  }
  for (TetContent& now : all) now.strain /= now.volume, now.flow /= now.volume;
  return all;
}

}  // namespace tack
