// Which entry of contact.pairs holds for two objects. An entry names two sides: an object, a group of objects or "*", which
// is every object. Where several entries fit, the one that says more of who is meant holds: two objects before an object
// and a group, then an object and all, two groups, a group and all, all and all.
// A side may be a part of an object that it names. Such entries hold where both places are within what they name, before the entry of the whole
// objects if they say as much of who is meant: two parts before one. Two that say as much of the same places are told apart by nothing, and refused
// (SurfaceParts).
// Errors: InputError with the place of the entry for a name that is none, a part of what is no single object, an integration side that is none, and two entries
// that say as much of the same two objects.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/config/value.hpp"
#include "framework/scene/scene_config.hpp"
#include "geometry/broad_phase/object_classes.hpp"
#include "geometry/errors.hpp"

namespace tack {

// How an object is meant by a name in a pair.
enum class NamedAs { not_at_all, everything, group, object };
NamedAs named_as(const ObjectConfig& object, const std::string& name);

class PairConfigs {
 public:
  // classes: objects of one are named by the same entries (ObjectClasses).
  PairConfigs(const SceneConfig& scene, const Value& root, const ObjectClasses& classes);

  // The number of the entry of the whole objects; -1: none fits.
  int of(int a, int b) const { return entry_[classes_.index(a, b)]; }
  // Those of parts that hold before it, the ones that say more first, then as in the file.
  std::vector<int> of_parts(int a, int b) const;
  // Whether the entry's first side is on a, if it is of a and b (both may be).
  bool turned(int entry, int a, int b) const { return !(has(entries_[entry].first, a) && has(entries_[entry].second, b)); }
  // Whether two entries say as much.
  bool equal(int i, int j) const { return entries_[i].rank == entries_[j].rank && entries_[i].parts == entries_[j].parts; }
  // Whether the entry names the two objects themselves.
  bool names_objects(int entry) const { return entries_[entry].rank == most_said; }
  // Whether the integration side that the entry names is, or holds, an object.
  bool integrates(int entry, int object) const { return has(entries_[entry].integrates, object); }
  std::string place(int entry) const;  // in the file, for messages
  InputError error(int entry, const std::string& message) const { return InputError(place(entry) + message); }

 private:
  static constexpr int most_said = 6;
  struct Entry {
    std::vector<char> first, second, integrates;  // per object
    int rank = 0;                                 // how much is said of who is meant
    int parts = 0;                                // how many sides are a part
  };
  struct Side {
    std::vector<char> objects;
    int rank;
  };
  static bool has(const std::vector<char>& objects, int object) { return !objects.empty() && objects[object]; }
  bool meant(int entry, int a, int b) const { return !turned(entry, a, b) || !turned(entry, b, a); }
  Side side(int entry, const PairSide& named) const;
  void read(int entry);
  void spread(int entry);
  void take(int entry, int a, int b);

  const SceneConfig& scene_;
  const Value& root_;
  int objects_;
  const ObjectClasses& classes_;
  std::vector<Entry> entries_;
  std::vector<int> entry_;  // per pair of classes
};

}  // namespace tack
