// Which pairs of objects bond, by which law and when. Over classes of objects, as PairTable.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/bond/bond_law.hpp"
#include "framework/contact/pair_law.hpp"
#include "geometry/broad_phase/object_classes.hpp"

namespace tack {

struct BondRule {
  std::shared_ptr<const BondLaw> law;  // prepared
  std::string type;                    // that it is registered by
  bool on_contact = false;             // bonds are made whenever surfaces meet, else at the start of a run alone
  double distance = 0;                 // to bond, surfaces are no farther apart than this [m]
  bool from_touching = false;          // bonds are unstressed where the surfaces touch, else as they bonded
  PairLaw barrier;                     // that presses where bonds may heal
};

class BondTable {
 public:
  explicit BondTable(ObjectClasses classes) : classes_(std::move(classes)), rule_(classes_.entries(), -1) {}

  int add(BondRule rule) {
    rules_.push_back(std::move(rule));
    return static_cast<int>(rules_.size()) - 1;
  }
  void set(int a, int b, int rule) { rule_[classes_.index(a, b)] = rule_[classes_.index(b, a)] = rule; }
  int between(int a, int b) const { return rule_[classes_.index(a, b)]; }  // -1: the two do not bond
  const std::vector<BondRule>& rules() const { return rules_; }
  bool empty() const { return rules_.empty(); }

 private:
  ObjectClasses classes_;
  std::vector<BondRule> rules_;
  std::vector<int> rule_;
};

}  // namespace tack
