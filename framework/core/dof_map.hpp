// Degrees of freedom: x = x0 + W q, where W has scalar weights on blocks of three unknowns, so that 3x3 blocks
// survive everywhere. Vertices are
//   free       own one block of weight 1: their position,
//   held       own none; x0 is their place,
//   dependent  are a sum of others with weights (dependence.hpp), in the end of free and held ones. One that depends
//              on one free vertex alone, with weight 1, shares its block.
// Of a free vertex some directions may be held: its block keeps three numbers, of which only those across count, and
// gradients and Hessians are projected onto these.
// Energies see the configuration x of all vertices (3n), minimisers the unknowns q (3m).
#pragma once

#include <span>
#include <vector>

#include "framework/core/dependence.hpp"
#include "geometry/types.hpp"

namespace tack {

// A free vertex of which some directions are held: a roller, a slider, a plane of symmetry.
struct HeldDirections {
  int vertex = -1;
  Mat3 held = Mat3::Zero();  // projects onto them
  bool twist = false;        // it is no place but the twist of an edge (rod/rod_frames.hpp)
};

class DofMap {
 public:
  struct Part {
    int leaf;       // a vertex that is free or held
    double weight;
  };

  DofMap() = default;
  // movable[i] != 0 where vertex i is not held. Throws InputError if vertices depend on themselves.
  explicit DofMap(std::span<const char> movable, const Dependences& dependences = {},
                  const std::vector<HeldDirections>& held = {});

  int vertex_count() const { return static_cast<int>(block_of_.size()); }
  int block_count() const { return static_cast<int>(vertex_of_.size()); }
  int size() const { return 3 * block_count(); }
  // The one block that moves the vertex, with weight 1; -1 where there is none, or more than that.
  int block(int vertex_index) const { return block_of_[vertex_index]; }
  int vertex_of_block(int block) const { return vertex_of_[block]; }  // that owns it
  bool owns(int v) const { return block_of_[v] >= 0 && vertex_of_[block_of_[v]] == v; }
  // Whether any unknown moves the vertex, and whether several do, or one with another weight.
  bool moves(int v) const { return block_of_[v] >= 0 || mixed(v); }
  bool mixed(int v) const { return !mixed_.empty() && mixed_[v]; }
  // Whether every block moves one vertex alone, and with weight 1.
  bool plain() const { return mixed_.empty() && !shares_; }

  // The blocks of which some directions are held, ascending, and what projects onto those.
  struct HeldBlock {
    int block;
    Mat3 held;
    bool twist;
  };
  const std::vector<HeldBlock>& held_blocks() const { return held_blocks_; }

  const std::vector<int>& dependents() const { return dependents_; }  // ascending
  // What the k-th of them is a sum of.
  std::span<const Part> parts(int k) const { return {parts_.data() + start_[k], parts_.data() + start_[k + 1]}; }
  Dependences dependences() const;  // on leaves alone
  // Of a mixed vertex: blocks (as leaf) and weights, ascending.
  std::span<const Part> blocks(int mixed_vertex) const {
    const int k = block_entry_[mixed_vertex];
    return {block_parts_.data() + block_start_[k], block_parts_.data() + block_start_[k + 1]};
  }

  void gather(const VecX& x, VecX& q) const;   // q <- the free part of x
  void scatter(const VecX& q, VecX& x) const;  // x's free part <- q; held vertices keep theirs, dependent ones follow
  // Makes the held directions of q those of x.
  void keep_held(const VecX& x, VecX& q) const;
  void follow(VecX& x) const;                  // puts the dependent vertices of x where the others say
  // Adds what acts on dependent vertices (3n) to those that they depend on: W^T, held vertices included.
  void collect(VecX& forces) const;
  // Of each block, the masses (n) of the vertices that it alone moves [kg].
  VecX own_masses(const VecX& mass) const;
  // Of each block, what the masses of vertices (n) put on the diagonal of W^T M W [kg].
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
