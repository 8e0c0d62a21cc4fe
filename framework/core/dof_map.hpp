// Degrees of freedom: x = x0 + W q. W has scalar weights on blocks of three unknowns, so that all
// matrices keep 3x3 blocks. Energies depend on the configuration x of all vertices (3n), minimisers
// see the unknowns q (3m).
//
//   vertex     unknowns
//   free       one block of weight 1: its position
//   fixed      none: x0 is its position
//   dependent  none: a weighted sum of free and fixed vertices (dependence.hpp). A vertex that
//              depends on a single free vertex with weight 1 shares the block of that vertex.
//
// A free vertex may have fixed directions. Its block keeps three numbers, and gradients and
// Hessians are projected onto the free directions.
#pragma once

#include <span>
#include <vector>

#include "framework/core/dependence.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Fixed directions of a free vertex: a roller, a slider, a plane of symmetry.
struct HeldDirections {
  int vertex = -1;
  Mat3 held = Mat3::Zero();  // projection onto the fixed directions
  bool twist = false;        // the twist of an edge (rod/rod_frames.hpp), not a position
};

/// Map between unknowns and vertices.
class DofMap {
 public:
  struct Part {
    int leaf;       // a free or fixed vertex
    double weight;
  };

  DofMap() = default;
  /// movable[i]: 0 if vertex i is fixed. Throws InputError if a vertex depends on itself.
  explicit DofMap(std::span<const char> movable, const Dependences& dependences = {},
                  const std::vector<HeldDirections>& held = {});

  int vertex_count() const { return static_cast<int>(block_of_.size()); }
  int block_count() const { return static_cast<int>(vertex_of_.size()); }
  int size() const { return 3 * block_count(); }
  /// Returns the block that alone moves the vertex, with weight 1; -1 if there is none.
  int block(int vertex_index) const { return block_of_[vertex_index]; }
  int vertex_of_block(int block) const { return vertex_of_[block]; }  // the owner of the block
  bool owns(int v) const { return block_of_[v] >= 0 && vertex_of_[block_of_[v]] == v; }
  /// moves: any unknown moves the vertex; mixed: several do, or one with a weight other than 1.
  bool moves(int v) const { return block_of_[v] >= 0 || mixed(v); }
  bool mixed(int v) const { return !mixed_.empty() && mixed_[v]; }
  /// Returns true if every block moves a single vertex, with weight 1.
  bool plain() const { return mixed_.empty() && !shares_; }

  /// A block with fixed directions, and the projection onto them; blocks ascend.
  struct HeldBlock {
    int block;
    Mat3 held;
    bool twist;
  };
  const std::vector<HeldBlock>& held_blocks() const { return held_blocks_; }

  const std::vector<int>& dependents() const { return dependents_; }  // ascending
  /// Returns the free and fixed vertices on which dependent vertex k depends, with weights.
  std::span<const Part> parts(int k) const {
    return {parts_.data() + start_[k], parts_.data() + start_[k + 1]};
  }
  Dependences dependences() const;  // on leaves alone
  /// Returns the blocks (as `leaf`) that move a mixed vertex, with weights; blocks ascend.
  std::span<const Part> blocks(int mixed_vertex) const {
    const int k = block_entry_[mixed_vertex];
    return {block_parts_.data() + block_start_[k], block_parts_.data() + block_start_[k + 1]};
  }

  /// q <- the positions of free vertices in x.
  void gather(const VecX& x, VecX& q) const;
  /// Sets free vertices of x to q, then updates dependent vertices. Fixed vertices stay.
  void scatter(const VecX& q, VecX& x) const;
  /// Copies the fixed directions of x into q.
  void keep_held(const VecX& x, VecX& q) const;
  /// Updates the dependent vertices of x from the others.
  void follow(VecX& x) const;
  /// Adds the forces on dependent vertices (3n) to the free and fixed vertices they depend on.
  void collect(VecX& forces) const;
  /// Returns per block the mass of the vertices that it alone moves [kg]. mass: n.
  VecX own_masses(const VecX& mass) const;
  /// Returns the diagonal of W^T M W per block [kg]. mass: n.
  VecX block_masses(const VecX& mass) const;

 private:
  std::vector<int> block_of_;
  std::vector<int> vertex_of_;
  std::vector<int> dependents_, start_{0};
  std::vector<Part> parts_;
  std::vector<HeldBlock> held_blocks_;
  std::vector<char> mixed_;  // per vertex; empty without any
  bool shares_ = false;
  std::vector<int> block_entry_, block_start_{0};
  std::vector<Part> block_parts_;
};

}  // namespace tack
