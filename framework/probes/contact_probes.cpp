// Probes of contact between surfaces: sliding speed, contact area and attached objects.
#include <algorithm>
#include <span>
#include <tuple>

#include "framework/bond/bond_term.hpp"
#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

// Returns the contact points of the wanted laws.
ContactPoints points_of(const World& world, const State& state, const std::vector<char>& wanted) {
  return contact_points({*world.contact, wanted, state.x});
}

// Mean of |u| / h over the contact points of a pair, weighted by area, with the slip u of the last
// step; 0 without contact points.
class SlidingSpeed : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    between_.fields(f);
  }
  void prepare(const World& world) override {
    require_contact(world, name_);
    std::tie(a_, b_) = between_.prepare(world, name_);
    wanted_ = integrated_laws(world.contact->pairs(), a_, b_);
  }
  Unit unit() const override { return units::velocity; }
  std::vector<double> sample(const World& world, const State& state) override {
    if (state.h_before == 0) return {0};
    double area = 0, sum = 0;
    for_each_record(points_of(world, state, wanted_), [&](const auto& c) {
      if (!c.between(a_, b_)) return;
      area += c.area;
      sum += c.area * (c.tangents.transpose() * c.moved(state.x, state.x_before)).norm() / state.h_before;
    });
    return {area > 0 ? sum / area : 0};
  }

 private:
  ObjectNames between_;
  int a_ = -1, b_ = -1;
  std::vector<char> wanted_;  // per law
};

// Area over which two objects are within range of each other's laws: that of their contact points.
class ContactArea : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    between_.fields(f);
    f.choice("part", part_,
             {{"all", LawTerm::all, "within the range of barrier or adhesion"},
              {"barrier", LawTerm::barrier, "closer than the contact distance"},
              {"adhesion", LawTerm::adhesion, "within the range of adhesion"}},
             "laws that count");
  }
  void prepare(const World& world) override {
    require_contact(world, name_);
    std::tie(a_, b_) = between_.prepare(world, name_);
    wanted_ = integrated_laws(world.contact->pairs(), a_, b_);
  }
  Unit unit() const override { return units::area; }
  std::vector<double> sample(const World& world, const State& state) override {
    const std::vector<PairLaw>& laws = world.contact->pairs().laws(part_);
    double area = 0;
    for_each_record(points_of(world, state, wanted_), [&](const auto& c) {
      if (c.between(a_, b_) && c.gap < laws[c.law].range()) area += c.area;
    });
    return {area};
  }

 private:
  ObjectNames between_;
  LawTerm part_ = LawTerm::all;
  int a_ = -1, b_ = -1;
  std::vector<char> wanted_;  // per law
};

// Number of other objects within range of an object's adhesion, or connected by bonds, anywhere or at selected vertices.
class AttachedObjects : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("to", to_, "name of the object that they adhere to").required();
    f.texts("of", of_, "objects that count; with `fill`, all of their copies; empty: all").line();
    f.component("select", select_, "vertices of `to` that they adhere to, or to elements with such a vertex");
  }
  void prepare(const World& world) override {
    require_contact(world, name_);
    index_ = object_index(world, to_, name_);
    const auto& adhesion = world.contact->pairs().laws(LawTerm::adhesion);
    adhesive_.clear();
    for (const PairLaw& law : adhesion) adhesive_.push_back(!law.laws().empty());
    counted_.assign(world.bodies.size(), of_.empty() ? 1 : 0);
    for (const std::string& name : of_)
      for (const int i : copies_of(world, name, name_)) counted_[i] = 1;
    selected_.assign(static_cast<size_t>(world.dofs.vertex_count()), 0);
    for (const int v : select(*select_, world.selection_context(index_))) selected_[v] = 1;
    select_finer_surface(world);
  }
  Unit unit() const override { return units::none; }
  std::vector<double> sample(const World& world, const State& state) override {
    std::vector<char> attached(world.bodies.size(), 0);
    world.contact->potential().visit_active([&](const ActivePair& pair) {
      const int a = pair.object, b = pair.opposite;
      if (!adhesive_[pair.law] || !selected(pair.vertices)) return;
      if (a == index_ && b != index_) attached[b] = 1;
      if (b == index_ && a != index_) attached[a] = 1;
    });
    // Some models adhere without stencils of the system.
    for_each_record(points_of(world, state, adhesive_), [&](const auto& c) {
      if (!selected(c.vertices)) return;
      if (c.object == index_ && c.opposite != index_) attached[c.opposite] = 1;
      if (c.opposite == index_ && c.object != index_) attached[c.object] = 1;
    });
    if (world.bonds) add_bonded(*world.bonds, attached);
    for (size_t i = 0; i < attached.size(); ++i) attached[i] &= counted_[i];
    return {static_cast<double>(std::count(attached.begin(), attached.end(), 1))};
  }

 private:
  // Selects the vertices of a finer contact surface that depend on selected vertices alone.
  void select_finer_surface(const World& world) {
    const std::vector<int>& finer = world.bodies[index_].surface_vertices;  // ascending
    for (const Dependence& d : world.constraints.lasting())
      if (std::binary_search(finer.begin(), finer.end(), d.vertex))
        selected_[d.vertex] = std::all_of(d.on.begin(), d.on.end(), [this](const auto& on) { return on.second == 0 || selected_[on.first]; });
  }
  bool selected(std::span<const int> vertices) const {
    return std::any_of(vertices.begin(), vertices.end(), [this](int v) { return selected_[v]; });
  }
  // Counts bonds with some strength, without those that begin to form.
  void add_bonded(const BondTerm& bonds, std::vector<char>& attached) const {
    constexpr double intensity_min = 0.01;
    for (int i = 0; i < bonds.list().size(); ++i) {
      const Bond& bond = bonds.list().bonds()[i];
      if (bond.a == bond.b || (bond.a != index_ && bond.b != index_)) continue;
      if (!selected({bond.vertices.data(), static_cast<size_t>(bond.count())})) continue;
      if (bonds.intensity(i) > intensity_min) attached[bond.a == index_ ? bond.b : bond.a] = 1;
    }
  }

  std::string to_;
  std::vector<std::string> of_;
  std::unique_ptr<Selection> select_ = Registry<Selection>::make("all");
  std::vector<char> counted_;   // per object
  std::vector<char> selected_;  // per vertex of x
  int index_ = -1;
  std::vector<char> adhesive_;  // per law
};

TACK_REGISTER(Probe, SlidingSpeed, "sliding_speed",
              "Mean speed of one surface along another where they touch or adhere, in the last step [m/s].", "");
TACK_REGISTER(Probe, ContactArea, "contact_area", "The area over which two objects touch or adhere [m^2].", "");
TACK_REGISTER(Probe, AttachedObjects, "attached_objects",
              "Number of other objects within the adhesion range of an object, or bonded to it.", "");

}  // namespace
}  // namespace tack
