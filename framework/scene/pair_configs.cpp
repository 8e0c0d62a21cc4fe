#include "framework/scene/pair_configs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/config/nearest.hpp"

namespace tack {
namespace {

constexpr const char* all_objects = "*";
// Of a side; the rank of an entry orders as pair_configs.hpp says.
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
  for (int i = 0; i < static_cast<int>(entries_.size()); ++i) spread(i);
}

std::string PairConfigs::place(int entry) const {
  const Value* contact = root_.find("contact");
  const Value* pairs = contact ? contact->find("pairs") : nullptr;
  return pairs && entry < static_cast<int>(pairs->items.size()) ? pairs->items[entry].mark.text() + ": " : "";
}

PairConfigs::Side PairConfigs::side(int entry, const std::string& name) const {
  Side found{std::vector<char>(objects_, name == all_objects), name == all_objects ? all : group};
  for (int i = 0; i < objects_; ++i) {
    const NamedAs as = named_as(scene_.objects[i], name);
    if (as == NamedAs::not_at_all) continue;
    found.objects[i] = 1;
    if (as == NamedAs::object) found.rank = object;
  }
  if (std::find(found.objects.begin(), found.objects.end(), 1) != found.objects.end()) return found;
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
  entries_[i] = {first.objects, second.objects, {}, first.rank + second.rank};
  const std::string& named = pair.integrate;
  if (named == pair.between[0]) entries_[i].integrates = first.objects;
  else if (named == pair.between[1]) entries_[i].integrates = second.objects;
  else if (named != "automatic" && named != "finer" && named != "both")
    throw error(i, fmt::format("integrate: '{}' is neither automatic, finer, both, nor one of the pair; name '{}' or '{}'", named,
                               pair.between[0], pair.between[1]));
}

void PairConfigs::spread(int i) {
  const Entry& e = entries_[i];
  for (const auto& [a, b] : classes_.examples())
    if ((e.first[a] && e.second[b]) || (e.first[b] && e.second[a])) take(i, a, b);
}

void PairConfigs::take(int i, int a, int b) {
  const int known = of(a, b);
  if (known >= 0 && entries_[known].rank > entries_[i].rank) return;
  if (known >= 0 && entries_[known].rank == entries_[i].rank) {
    const std::string &first = scene_.objects[a].name, &second = scene_.objects[b].name;
    if (names_objects(i)) throw error(i, fmt::format("the pair '{}', '{}' is given twice", first, second));
    const PairConfig& other = scene_.contact->pairs[known];
    throw error(i, fmt::format("'{}' and '{}' are also a pair of '{}' and '{}'{}; say which holds by an entry that names the two "
                               "objects", first, second, other.between[0], other.between[1],
                               place(known).empty() ? "" : fmt::format(" ({})", place(known).substr(0, place(known).size() - 2))));
  }
  entry_[classes_.index(a, b)] = entry_[classes_.index(b, a)] = i;
}

}  // namespace tack
