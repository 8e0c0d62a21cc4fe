#include <algorithm>

#include "framework/contact/point_pieces.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Offsets of a chunk's lists in the joined lists.
struct PlaceOfPieces {
  size_t piece = 0, group = 0, triangle = 0, share = 0, edge = 0, other = 0, held = 0;

  PlaceOfPieces after(const PointPieces& p) const {
    return {piece + p.pieces.size(), group + p.group_begin.size(), triangle + p.triangles.size(), share + p.shares.size(),
            edge + p.edges.size(),   other + p.others.size(),      held + p.held.size()};
  }
};

}  // namespace

PointPieces joined_pieces(const std::vector<PointPieces>& chunks) {
  std::vector<PlaceOfPieces> places(1);
  for (const PointPieces& chunk : chunks) places.push_back(places.back().after(chunk));
  const PlaceOfPieces& end = places.back();
  PointPieces all;
  all.pieces.resize(end.piece);
  all.group_begin.resize(end.group + 1);
  all.group_begin.back() = static_cast<int>(end.piece);
  all.triangles.resize(end.triangle);
  all.shares.resize(end.share);
  all.edges.resize(end.edge);
  all.others.resize(end.other);
  all.held.resize(end.held);
  for_each(static_cast<int>(chunks.size()), [&](int c) {
    const PointPieces& chunk = chunks[c];
    const PlaceOfPieces& at = places[c];
    const auto shift = [](size_t by, int& first, int& last) {
      first += static_cast<int>(by);
      last += static_cast<int>(by);
    };
    for (size_t i = 0; i < chunk.pieces.size(); ++i) {
      PointPiece& p = all.pieces[at.piece + i] = chunk.pieces[i];
      shift(at.triangle, p.triangle_begin, p.triangle_end);
      if (p.share_begin >= 0) p.share_begin += static_cast<int>(at.share);
      shift(at.edge, p.edge_begin, p.edge_end);
      shift(at.other, p.other_begin, p.other_end);
    }
    for (size_t i = 0; i < chunk.group_begin.size(); ++i) all.group_begin[at.group + i] = chunk.group_begin[i] + static_cast<int>(at.piece);
    const auto copy = [](const auto& from, auto& to, size_t place) { std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(place)); };
    copy(chunk.triangles, all.triangles, at.triangle);
    copy(chunk.shares, all.shares, at.share);
    copy(chunk.edges, all.edges, at.edge);
    copy(chunk.others, all.others, at.other);
    copy(chunk.held, all.held, at.held);
  }, 16);
  return all;
}

}  // namespace tack
