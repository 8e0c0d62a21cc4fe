// Entry of contact.pairs that applies to two objects. Each side of an entry names an object, a
// group of objects or "*" (every object). The most specific of the matching entries applies, in
// this order:
//     object and object; object and group; object and *; group and group; group and *; * and *
// A side may name a region of an object. Such an entry applies where both positions are within the
// named regions, before an entry of whole objects of the same rank; two regions precede one. Two
// entries that are equally specific for the same positions are an error (SurfaceRegions).
// Errors: InputError with the entry's source location, for an unknown name, a region of a side that
// is not a single object, an invalid integration side, and two entries equally specific for the
// same two objects.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/config/value.hpp"
#include "framework/scene/scene_config.hpp"
#include "geometry/broad_phase/object_classes.hpp"
#include "geometry/errors.hpp"

namespace tack {

// Match of a name in a pair with an object.
enum class NamedAs { not_at_all, everything, group, object };
NamedAs named_as(const ObjectConfig& object, const std::string& name);

class PairConfigs {
 public:
  // classes: objects of one class match the same entries (ObjectClasses).
  PairConfigs(const SceneConfig& scene, const Value& root, const ObjectClasses& classes);

  // Returns the index of the entry for the whole objects; -1: none matches.
  int of(int a, int b) const { return entry_[classes_.index(a, b)]; }
  // Returns the entries of regions that precede it, most specific first, then in file order.
  std::vector<int> of_regions(int a, int b) const;
  // Returns true if the entry's first side matches b, not a (false if both orders match).
  bool swapped(int entry, int a, int b) const {
    return !(has(entries_[entry].first, a) && has(entries_[entry].second, b));
  }
  // Returns true if two entries are equally specific.
  bool equal(int i, int j) const {
    return entries_[i].rank == entries_[j].rank &&
           entries_[i].region_count == entries_[j].region_count;
  }
  // Returns true if the entry names both objects themselves.
  bool names_objects(int entry) const { return entries_[entry].rank == rank_of_two_objects; }
  // Returns true if the entry's integration side is, or contains, the object.
  bool integrates(int entry, int object) const { return has(entries_[entry].integrates, object); }
  std::string location(int entry) const;  // source location, for messages
  InputError error(int entry, const std::string& message) const {
    return InputError(location(entry) + message);
  }

 private:
  static constexpr int rank_of_two_objects = 6;
  struct Entry {
    std::vector<char> first, second, integrates;  // per object
    int rank = 0;                                 // specificity of the sides
    int region_count = 0;                         // number of sides that are a region
  };
  struct Side {
    std::vector<char> objects;
    int rank;
  };
  static bool has(const std::vector<char>& objects, int object) {
    return !objects.empty() && objects[object];
  }
  bool matches(int entry, int a, int b) const {
    return !swapped(entry, a, b) || !swapped(entry, b, a);
  }
  Side side(int entry, const PairSide& named) const;
  void read(int entry);
  void assign_to_pairs(int entry);
  void assign(int entry, int a, int b);

  const SceneConfig& scene_;
  const Value& root_;
  int objects_;
  const ObjectClasses& classes_;
  std::vector<Entry> entries_;
  std::vector<int> entry_;  // per pair of classes
};

}  // namespace tack
