#include "framework/bond/bond_list.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "geometry/errors.hpp"
#include "geometry/mesh/object_elements.hpp"

namespace tack {
namespace {

const std::string prefix = "contact/bonds/", begun_name = "contact/bonds_begun";

// Position of a bond: triangle (of the object; -1: the vertex of the key), u, v; opposite triangle,
// u, v; area, rest; lever and side of either surface.
constexpr int position_width = 12;

std::array<int, 2> key_of(const Bond& bond) { return {bond.vertices[0], bond.b}; }

}  // namespace

BondList::BondList(const ContactSurface& surface, const PairTable& pairs, const BondTable& table)
    : surface_(&surface), pairs_(&pairs), table_(&table), first_triangle_(first_of_objects(surface.mesh, surface.mesh.triangles)) {}

void BondList::clear() {
  bonds_.clear();
  history_.clear();
  history_start_.clear();
}

BondList BondList::none() const {
  BondList list;
  list.surface_ = surface_;
  list.pairs_ = pairs_;
  list.table_ = table_;
  list.first_triangle_ = first_triangle_;
  list.bonds_.reserve(bonds_.size());
  list.history_.reserve(history_.size());
  list.history_start_.reserve(history_start_.size());
  return list;
}

void BondList::add(const Bond& bond, const double* history) {
  bonds_.push_back(bond);
  history_start_.push_back(history_.size());
  history_.insert(history_.end(), history, history + table_->rules()[bond.rule].law->width());
}

void BondList::sort() {
  std::vector<int> order(bonds_.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) {
    const Bond &p = bonds_[i], &q = bonds_[j];
    return std::tuple(p.site_count, p.rule, key_of(p), p.triangle) < std::tuple(q.site_count, q.rule, key_of(q), q.triangle);
  });
  BondList sorted = none();
  for (const int i : order) sorted.add(bonds_[i], variables(i));
  bonds_ = std::move(sorted.bonds_);
  history_ = std::move(sorted.history_);
  history_start_ = std::move(sorted.history_start_);
}

void BondList::set_position(Bond& bond, const double* entry, const std::array<int, 2>& key) const {
  const auto& [own, u, v] = std::tie(entry[0], entry[1], entry[2]);
  const std::vector<int>& object = surface_->mesh.vertex_object;
  const auto refuse = [] {
    throw InputError("the stored bonds do not fit the objects, because another scene stored them; start the run again");
  };
  const int vertices = static_cast<int>(object.size()), objects = static_cast<int>(first_triangle_.size()) - 1;
  if (key[0] < 0 || key[0] >= vertices || key[1] < 0 || key[1] >= objects) refuse();
  bond.a = object[key[0]];
  bond.b = key[1];
  const auto triangle_of = [&](int of, double number) {
    const int t = first_triangle_[of] + static_cast<int>(number);
    if (!(number >= 0) || t >= first_triangle_[of + 1]) refuse();
    return t;
  };
  if (own < 0) {
    bond.site_count = 1;
    bond.vertices[0] = key[0];
    bond.c[0] = 1;
  } else {
    bond.triangle = triangle_of(bond.a, own);
    const Triangle& t = surface_->mesh.triangles[bond.triangle];
    std::copy(t.begin(), t.end(), bond.vertices.begin());
    bond.c = {1 - u - v, u, v};
  }
  bond.opposite_triangle = triangle_of(bond.b, entry[3]);
  const Triangle& t = surface_->mesh.triangles[bond.opposite_triangle];
  std::copy(t.begin(), t.end(), bond.vertices.begin() + bond.site_count);
  bond.rule = rule_of(bond, *table_, *pairs_, surface_->mesh);
  const std::array<double, 3> c = {1 - entry[4] - entry[5], entry[4], entry[5]};
  for (int i = 0; i < 3; ++i) bond.c[bond.site_count + i] = -c[i];
  bond.area = entry[6];
  bond.rest = entry[7];
  bond.lever = {entry[8], entry[9]};
  bond.side = {entry[10], entry[11]};
}

bool BondList::read(const History& history) {
  clear();
  for (auto it = history.lower_bound(prefix); it != history.end() && it->first.starts_with(prefix); ++it) {
    const HistoryArray& array = it->second;
    const std::string type = it->first.substr(prefix.size());
    for (int i = 0; i < array.entries(); ++i) {
      Bond bond;
      const double* entry = &array.values[static_cast<size_t>(i) * array.width];
      set_position(bond, entry, array.keys[i]);
      // History of pairs that bond by another law here is skipped.
      if (bond.rule < 0 || table_->rules()[bond.rule].type != type) continue;
      if (array.width != position_width + table_->rules()[bond.rule].law->width())
        throw InputError(fmt::format("stored bonds of the law '{}' have {} history variables, but the law has {}; another law of that name stored them: start the run again", type,
                                     array.width - position_width, table_->rules()[bond.rule].law->width()));
      add(bond, entry + position_width);
    }
  }
  sort();
  return history.contains(begun_name);
}

void BondList::write(History& history) const {
  history[begun_name] = {1, {1}, {}};
  std::set<std::string> types;
  for (const BondRule& rule : table_->rules()) types.insert(rule.type);
  for (const std::string& type : types) {
    std::vector<int> of_type;
    int width = position_width;
    for (int i = 0; i < size(); ++i)
      if (table_->rules()[bonds_[i].rule].type == type) of_type.push_back(i);
    for (const BondRule& rule : table_->rules())
      if (rule.type == type) width = position_width + rule.law->width();
    std::stable_sort(of_type.begin(), of_type.end(), [&](int i, int j) { return key_of(bonds_[i]) < key_of(bonds_[j]); });
    HistoryArray& array = history[prefix + type] = {width, {}, {}};
    for (const int i : of_type) {
      const Bond& b = bonds_[i];
      const bool in_triangle = b.triangle >= 0;
      array.keys.push_back(key_of(b));
      const int opposite = b.opposite_triangle - first_triangle_[b.b], own = in_triangle ? b.triangle - first_triangle_[b.a] : -1;
      array.values.insert(array.values.end(), {double(own), in_triangle ? b.c[1] : 0.0, in_triangle ? b.c[2] : 0.0, double(opposite), -b.c[b.site_count + 1],
                                               -b.c[b.site_count + 2], b.area, b.rest, b.lever[0], b.lever[1], b.side[0], b.side[1]});
      array.values.insert(array.values.end(), variables(i), variables(i) + width - position_width);
    }
  }
}

std::vector<std::pair<int, int>> BondList::pairs() const {
  std::set<std::pair<int, int>> found;
  for (const Bond& b : bonds_) found.insert(std::minmax(b.a, b.b));
  return {found.begin(), found.end()};
}

}  // namespace tack
