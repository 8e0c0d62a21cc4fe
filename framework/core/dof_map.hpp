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
struct FixedDirections {
  int vertex = -1;
  Mat3 projection = Mat3::Zero();  // onto the fixed directions
  bool scalar = false;             // a scalar dof, not a position: the twist of an edge
};

/// Map between unknowns and vertices.
class DofMap {
 public:
  /// A vertex or a block with a weight.
  struct WeightedIndex {
    int index;
    double weight;
  };

  DofMap() = default;
  /// movable[i]: 0 if vertex i is fixed. Throws InputError if a vertex depends on itself.
  explicit DofMap(std::span<const char> movable, const Dependences& dependences = {},
                  const std::vector<FixedDirections>& fixed = {});

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
  struct PartlyFixedBlock {
    int block;
    Mat3 projection;
    bool scalar;
  };
  const std::vector<PartlyFixedBlock>& partly_fixed_blocks() const { return partly_fixed_blocks_; }

  const std::vector<int>& dependents() const { return dependents_; }  // ascending
  /// Returns the free and fixed vertices on which dependent vertex k depends, with weights.
  std::span<const WeightedIndex> independents(int k) const {
    return {independents_.data() + start_[k], independents_.data() + start_[k + 1]};
  }
  Dependences dependences() const;  // on independent vertices alone
  /// Returns the blocks that move a mixed vertex, with weights; blocks ascend.
  std::span<const WeightedIndex> blocks(int mixed_vertex) const {
    const int k = block_entry_[mixed_vertex];
    return {weighted_blocks_.data() + block_start_[k],
            weighted_blocks_.data() + block_start_[k + 1]};
  }

  /// q <- the positions of free vertices in x.
  void gather(const VecX& x, VecX& q) const;
  /// Sets free vertices of x to q, then updates dependent vertices. Fixed vertices stay.
  void scatter(const VecX& q, VecX& x) const;
  /// Copies the fixed directions of x into q.
  void copy_fixed_directions(const VecX& x, VecX& q) const;
  /// Updates the dependent vertices of x from the others.
  void update_dependents(VecX& x) const;
  /// Moves the forces (3n) on dependent vertices to the vertices on which these depend.
  void move_to_independents(VecX& forces) const;
  /// Removes the fixed directions from a gradient in the unknowns.
  void project_out_fixed_directions(VecX& gradient) const;
  /// Returns W^T full without the fixed directions, the gradient in the unknowns (3m) of a gradient
  /// at all vertices (3n). Overwrites `full`.
  VecX to_unknowns(VecX& full) const;
  /// Returns per block the mass of the vertices that it alone moves [kg]. mass: n.
  VecX own_masses(const VecX& mass) const;
  /// Returns the diagonal of W^T M W per block [kg]. mass: n.
  VecX block_masses(const VecX& mass) const;

 private:
  std::vector<int> block_of_;
  std::vector<int> vertex_of_;
  std::vector<int> dependents_, start_{0};
  std::vector<WeightedIndex> independents_;
  std::vector<PartlyFixedBlock> partly_fixed_blocks_;
  std::vector<char> mixed_;  // per vertex; empty without any
  bool shares_ = false;
  std::vector<int> block_entry_, block_start_{0};
  std::vector<WeightedIndex> weighted_blocks_;
};

}  // namespace tack
