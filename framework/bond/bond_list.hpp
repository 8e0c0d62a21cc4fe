// The bonds of a configuration with their history variables, and their storage in a history: one
// array per type of law, one entry per bond. The key of an entry is (vertex of the site, object of
// the attachment point). The entry holds the position of the bond on the meshes, valid in another
// scene with the same meshes, and its history variables.
#pragma once

#include <vector>

#include "framework/bond/bond.hpp"
#include "framework/bond/bond_table.hpp"
#include "framework/contact/stencils/contact_set.hpp"
#include "framework/core/history.hpp"

namespace tack {

/// Bonds with their history variables.
class BondList {
 public:
  // Both must outlive it.
  BondList(const ContactSurface& surface, const PairTable& pairs, const BondTable& table);

  /// Bonds of 4 vertices before bonds of 6; each of these sorted by rule.
  const std::vector<Bond>& bonds() const { return bonds_; }
  std::vector<Bond>& bonds() { return bonds_; }
  double* variables(int bond) { return history_.data() + history_start_[bond]; }
  const double* variables(int bond) const { return history_.data() + history_start_[bond]; }
  int size() const { return static_cast<int>(bonds_.size()); }

  void clear();
  /// Returns an empty list of the same scene, with memory reserved for as many bonds.
  BondList none() const;
  void add(const Bond& bond, const double* history);
  /// To be called after the last add().
  void sort();
  /// Sets the bonds to those of the history. Returns whether it has any, that is, whether the run
  /// has begun to bond. Throws InputError for a history of another scene.
  bool read(const History& history);
  void write(History& history) const;
  /// Pairs that are bonded (a < b), ascending.
  std::vector<std::pair<int, int>> pairs() const;

 private:
  BondList() = default;
  void set_position(Bond& bond, const double* entry, const std::array<int, 2>& key) const;

  const ContactSurface* surface_ = nullptr;
  const PairTable* pairs_ = nullptr;
  const BondTable* table_ = nullptr;
  std::vector<int> first_triangle_;  // of each object, and the end
  std::vector<Bond> bonds_;
  std::vector<double> history_;
  std::vector<size_t> history_start_;
};

}  // namespace tack
