// The bonds of a configuration with what they remember, and how they stand in a history: an array for each type of law, an entry for
// each bond with the key (vertex of the place, object of the anchor), and in it where the bond is, as it is the same on the same
// meshes in another scene, and its memory.
#pragma once

#include <vector>

#include "framework/bond/bond.hpp"
#include "framework/bond/bond_table.hpp"
#include "framework/contact/contact_set.hpp"
#include "framework/core/history.hpp"

namespace tack {

class BondList {
 public:
  // Both must outlive it.
  BondList(const ContactSurface& surface, const PairTable& pairs, const BondTable& table);

  // Those of 4 vertices before those of 6; of either, one rule after the other.
  const std::vector<Bond>& bonds() const { return bonds_; }
  std::vector<Bond>& bonds() { return bonds_; }
  double* memory(int bond) { return memory_.data() + memory_at_[bond]; }
  const double* memory(int bond) const { return memory_.data() + memory_at_[bond]; }
  int size() const { return static_cast<int>(bonds_.size()); }

  void clear();
  // Returns a list of the same scene without bonds, with room for as many.
  BondList none() const;
  void add(const Bond& bond, const double* memory);
  // After the last add().
  void sort();
  // Sets them to what is remembered: whether anything is, of a run that has begun to bond. Throws InputError for a history of
  // another scene.
  bool read(const History& history);
  void write(History& history) const;
  // Pairs that are bonded (a < b), ascending.
  std::vector<std::pair<int, int>> pairs() const;

 private:
  BondList() = default;
  void place(Bond& bond, const double* entry, const std::array<int, 2>& key) const;

  const ContactSurface* surface_ = nullptr;
  const PairTable* pairs_ = nullptr;
  const BondTable* table_ = nullptr;
  std::vector<int> first_triangle_;  // of each object, and the end
  std::vector<Bond> bonds_;
  std::vector<double> memory_;
  std::vector<size_t> memory_at_;
};

}  // namespace tack
