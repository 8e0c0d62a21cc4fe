#include "framework/scene/pair_configs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "framework/config/nearest.hpp"

namespace tack {
namespace {

constexpr const char* all_objects = "*";
// Rank of a side; sums of two sides order entries as in pair_configs.hpp.
enum Rank { all = 0, group = 1, object = 3 };

bool in_group(const ObjectConfig& o, const std::string& name) {
  return std::find(o.groups.begin(), o.groups.end(), name) != o.groups.end();
}

}  // namespace

NamedAs named_as(const ObjectConfig& object, const std::string& name) {
  if (name == all_objects) return NamedAs::everything;
  if (object.name == name) return NamedAs::object;
  return in_group(object, name) ? NamedAs::group : NamedAs::not_at_all;
}

PairConfigs::PairConfigs(const SceneConfig& scene, const Value& root, const ObjectClasses& classes)
    : scene_(scene), root_(root), objects_(static_cast<int>(scene.objects.size())), classes_(classes),
      entries_(scene.contact->pairs.size()), entry_(classes.entries(), -1) {
  std::set<std::string> names;
  for (const ObjectConfig& o : scene.objects) names.insert(o.name);
  for (const ObjectConfig& o : scene.objects)
    for (const std::string& group : o.groups)
      if (names.contains(group))
        throw InputError(fmt::format("object '{}' is in a group '{}', which is the name of an object; name the group otherwise", o.name, group));
  for (int i = 0; i < static_cast<int>(entries_.size()); ++i) read(i);
  for (int i = 0; i < static_cast<int>(entries_.size()); ++i) assign_to_pairs(i);
}

std::string PairConfigs::location(int entry) const {
  const Value* contact = root_.find("contact");
  const Value* pairs = contact ? contact->find("pairs") : nullptr;
  return pairs && entry < static_cast<int>(pairs->items.size()) ? pairs->items[entry].mark.text() + ": " : "";
}

PairConfigs::Side PairConfigs::side(int entry, const PairSide& named) const {
  const std::string& name = named.object;
  Side found{std::vector<char>(objects_, name == all_objects), name == all_objects ? all : group};
  for (int i = 0; i < objects_; ++i) {
    const NamedAs as = named_as(scene_.objects[i], name);
    if (as == NamedAs::not_at_all) continue;
    found.objects[i] = 1;
    if (as == NamedAs::object) found.rank = object;
  }
  if (std::find(found.objects.begin(), found.objects.end(), 1) != found.objects.end()) {
    if (named.select && found.rank != object)
      throw error(entry, fmt::format("a region belongs to a single object, and '{}' is {}; name the object", name, name == all_objects ? "all of them" : "a group"));
    return found;
  }
  std::vector<std::string> names;
  for (const ObjectConfig& o : scene_.objects) {
    names.push_back(o.name);
    names.insert(names.end(), o.groups.begin(), o.groups.end());
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  throw error(entry, fmt::format("no object and no group is named '{}'{}", name, suggestion(name, names, "objects and groups")));
}

void PairConfigs::read(int i) {
  const PairConfig& pair = scene_.contact->pairs[i];
  const Side first = side(i, pair.between[0]), second = side(i, pair.between[1]);
  entries_[i] = {first.objects, second.objects, {}, first.rank + second.rank, (pair.between[0].select != nullptr) + (pair.between[1].select != nullptr)};
  const std::string& named = pair.integrate;
  if (named == pair.between[0].object) entries_[i].integrates = first.objects;
  else if (named == pair.between[1].object) entries_[i].integrates = second.objects;
  else if (named != "automatic" && named != "finer" && named != "both")
    throw error(i, fmt::format("integrate: '{}' is neither automatic, finer, both, nor one of the pair; name '{}' or '{}'", named,
                               pair.between[0].object, pair.between[1].object));
}

void PairConfigs::assign_to_pairs(int i) {
  if (entries_[i].region_count > 0) return;
  for (const auto& [a, b] : classes_.examples())
    if (matches(i, a, b)) assign(i, a, b);
}

std::vector<int> PairConfigs::of_regions(int a, int b) const {
  const int of_objects = of(a, b);
  std::vector<int> found;
  for (int i = 0; i < static_cast<int>(entries_.size()); ++i)
    if (entries_[i].region_count > 0 && matches(i, a, b) && (of_objects < 0 || entries_[i].rank >= entries_[of_objects].rank)) found.push_back(i);
  std::stable_sort(found.begin(), found.end(), [&](int i, int j) {
    return std::pair(entries_[i].rank, entries_[i].region_count) > std::pair(entries_[j].rank, entries_[j].region_count);
  });
  return found;
}

void PairConfigs::assign(int i, int a, int b) {
  const int earlier = of(a, b);
  if (earlier >= 0 && entries_[earlier].rank > entries_[i].rank) return;
  if (earlier >= 0 && entries_[earlier].rank == entries_[i].rank) {
    const std::string &first = scene_.objects[a].name, &second = scene_.objects[b].name;
    if (names_objects(i)) throw error(i, fmt::format("the pair '{}', '{}' is given twice", first, second));
    const PairConfig& other = scene_.contact->pairs[earlier];
    throw error(i, fmt::format("'{}' and '{}' are also a pair of '{}' and '{}'{}; say which holds by an entry that names the two "
                               "objects", first, second, other.between[0].object, other.between[1].object,
                               location(earlier).empty() ? "" : fmt::format(" ({})", location(earlier).substr(0, location(earlier).size() - 2))));
  }
  entry_[classes_.index(a, b)] = entry_[classes_.index(b, a)] = i;
}

}  // namespace tack
