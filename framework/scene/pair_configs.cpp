#include "framework/scene/pair_configs.hpp"

#include <fmt/format.h>

#include <algorithm>

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

PairConfigs::PairConfigs(const SceneConfig& scene, const Value& root)
    : scene_(scene), root_(root), objects_(static_cast<int>(scene.objects.size())),
      entries_(scene.contact->pairs.size()), entry_(static_cast<size_t>(objects_) * objects_, -1) {
  for (const ObjectConfig& o : scene.objects)
    for (const ObjectConfig& other : scene.objects)
      if (in_group(o, other.name))
        throw InputError(fmt::format("object '{}' is in a group '{}', which is the name of an object; name the group otherwise",
                                     o.name, other.name));
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
    if (scene_.objects[i].name == name) found.objects[i] = 1, found.rank = object;
    if (in_group(scene_.objects[i], name)) found.objects[i] = 1;
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
  for (int a = 0; a < objects_; ++a)
    for (int b = a; b < objects_; ++b)
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
  entry_[static_cast<size_t>(a) * objects_ + b] = entry_[static_cast<size_t>(b) * objects_ + a] = i;
}

}  // namespace tack
