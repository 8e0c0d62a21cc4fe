// Which objects touch and adhere, with which laws: from the scene's contact section to a PairTable.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <tuple>

#include "framework/body/local_mesh.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/contact/rim_term.hpp"
#include "framework/scene/pair_configs.hpp"
#include "framework/setup/build_world.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "framework/setup/refined_surface.hpp"
#include "framework/world/hulls.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

struct SurfaceSize {
  double area = 0;  // of its triangles [m^2]
  int vertices = 0;
  double per_vertex() const { return vertices > 0 ? area / vertices : 0; }
};

// Rods beside triangles: their length times their width.
std::vector<double> areas_of_edges(const Mesh& mesh, const Surface& surface, double rod_width) {
  std::vector<double> areas = edge_areas(mesh, surface);
  for (const int e : surface.codim_edges) {
    const auto& [a, b] = surface.edges[e];
    areas[e] = rod_width * (mesh.vertices[a] - mesh.vertices[b]).norm();
  }
  return areas;
}

// Appends a body's surface to the collision mesh.
SurfaceSize add_surface(const Body& body, int object, const VecX& rest, bool hull, ContactSurface& all) {
  const Mesh mesh = body.surface_triangles.empty() ? local_mesh(body, rest) : surface_mesh(body, rest);
  const Surface surface = extract_surface(mesh);
  const auto areas = vertex_areas(mesh, surface);
  all.rod_width.push_back(body.section ? body.section->contact_width() : 0);
  all.particle_radius.push_back(body.radius);
  const auto edges = areas_of_edges(mesh, surface, all.rod_width.back());
  const auto global = [&](int v) {
    return v < body.vertex_count ? body.first_vertex + v : body.surface_vertices[v - body.vertex_count];
  };
  const SurfaceSize size{std::accumulate(areas.begin(), areas.end(), 0.0), static_cast<int>(surface.vertices.size())};
  all.mesh.vertex_object.insert(all.mesh.vertex_object.end(), body.vertex_count, object);
  for (const int e : surface.codim_edges)
    all.mesh.codim_edges.push_back(static_cast<int>(all.mesh.edges.size()) + e);
  for (const int v : surface.codim_points) all.mesh.codim_points.push_back(global(v));
  for (const int v : surface.vertices) all.mesh.vertices.push_back(global(v));
  for (const Edge& e : surface.edges) all.mesh.edges.push_back({global(e[0]), global(e[1])});
  for (const Triangle& t : surface.triangles) all.mesh.triangles.push_back({global(t[0]), global(t[1]), global(t[2])});
  all.edge_area.insert(all.edge_area.end(), edges.begin(), edges.end());
  // A refined surface is one of tets, or a sheet; a hull and an affine body that is a mesh of triangles enclose a volume.
  const bool closed = hull || !body.frame.empty() || (!body.surface_triangles.empty() && !body.tets.empty());
  for (int t = 0; t < static_cast<int>(surface.triangles.size()); ++t)
    all.two_sided.push_back(!closed && t >= surface.first_sheet);
  return size;
}

// An affine body is far stiffer than its contacts need: they carry the stress that strains it by 1e-4 at half their
// distance with a tenth of this part of its stiffness.
constexpr double affine_modulus = 0.01;
// What stops a soft body that moves faster than waves run in it presses with about density times speed^2, and the barrier has to
// carry that: it takes the body for as stiff, up to so many times its modulus.
constexpr double most_times = 10;
// Such a body is crushed on edges and tips, and guards are what stops it there: they act over the whole range then.
constexpr double guard_range = 0.5, guard_range_of_fast = 1;  // contact distances

// Objects are alike if every entry of pairs means them in the same way, they are as stiff, as fast, as thick and held alike, and
// attached to the same ones.
ObjectClasses classes_of(const SceneConfig& scene, const World& world, const std::vector<double>& pressures) {
  std::set<std::string> names;
  for (const PairConfig& pair : scene.contact->pairs) names.insert(pair.between.begin(), pair.between.end());
  std::vector<std::set<int>> attached(world.bodies.size());
  for (const auto& [a, b] : world.attached) attached[a].insert(b), attached[b].insert(a);
  using Key = std::tuple<std::vector<NamedAs>, std::set<int>, bool, bool, double, double, double, double>;
  std::map<Key, int> known;
  std::vector<int> classes;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const ObjectConfig& object = scene.objects[i];
    const Body& body = world.bodies[i];
    std::vector<NamedAs> named;
    for (const std::string& name : names) named.push_back(named_as(object, name));
    const Key key{std::move(named), attached[i], body.movable, body.section.has_value(), object.contact_offset, softest_young(object), body.stiffness, pressures[i]};
    classes.push_back(known.emplace(key, static_cast<int>(known.size())).first->second);
  }
  return ObjectClasses(std::move(classes));
}

std::vector<double> cells_of(const std::vector<SurfaceSize>& sizes) {
  std::vector<double> cells;
  for (const SurfaceSize& size : sizes) cells.push_back(size.per_vertex());
  return cells;
}

class PairBuilder {
 public:
  PairBuilder(const SceneConfig& scene, const Value& root, const std::vector<SurfaceSize>& sizes, World& world)
      : scene_(scene), contact_(*scene.contact), root_(root), world_(world), pressures_(dynamic_pressures(scene, world)),
        classes_(classes_of(scene, world, pressures_)),
        configs_(scene, root, classes_), table_(classes_, cells_of(sizes)), colliding_(classes_), bonds_(classes_) {
    table_.plain_sums = contact_.weights == ContactConfig::Weights::pair;
  }

  void build() {
    const std::set<std::pair<int, int>> all_attached(world_.attached.begin(), world_.attached.end());
    for (const auto& [a, b] : classes_.examples()) {
      const int index = configs_.of(a, b);
      const bool attached = all_attached.contains({a, b});
      if (attached && index >= 0 && contact_.pairs[index].contact && configs_.names_objects(index))
        throw configs_.error(index,
                             fmt::format("'{}' and '{}' touch where one is attached to the other, so there is no contact between "
                                         "them; take the pair away, or leave a gap", world_.bodies[a].name, world_.bodies[b].name));
      const bool held = !world_.bodies[a].movable && !world_.bodies[b].movable;
      if (attached || (held && !contact_.between_held) || (index >= 0 && !contact_.pairs[index].contact)) {
        colliding_.set(a, b, false);
        continue;
      }
      // Without a law, but the exact check sees one being driven through the other.
      if (held) continue;
      table_.set_offset(a, b, offset_of(a, b));
      set_roles(a, b, index);
    }
  }

  PairTable& table() { return table_; }
  BondTable& bonds() { return bonds_; }
  const CollidingObjects& colliding() const { return colliding_; }

 private:
  std::string contact_place() const {
    const Value* contact = root_.find("contact");
    return contact ? contact->mark.text() + ": " : "";
  }

  // What acts along the surfaces of a pair whose adhesion has the given peak traction.
  TangentialLaw tangential_of(const PairConfig* pair, double peak_traction) const {
    TangentialLaw law;
    if (const auto& friction = pair && pair->friction ? pair->friction : contact_.friction) {
      law.mu = friction->mu;
      law.eps_v = friction->eps_v;
    }
    if (pair && pair->tangential_adhesion) {
      law.mu_a = pair->tangential_adhesion->mu;
      law.eps_a = pair->tangential_adhesion->eps_a.value_or(law.eps_v);
      law.peak_traction = peak_traction;
    }
    return law;
  }

  double offset_of(int a, int b) const { return scene_.objects[a].contact_offset + scene_.objects[b].contact_offset; }

  // Both 0 if no side has a modulus.
  PairMaterials materials_of(int a, int b) const {
    PairMaterials m{contact_.contact_distance};
    const auto lower = [](double& softer, double modulus) {
      if (modulus > 0 && (softer == 0 || modulus < softer)) softer = modulus;
    };
    for (const int object : {a, b}) {
      lower(m.softer_young, softest_young(scene_.objects[object]));
      lower(m.softer_stiffness, affine_modulus * world_.bodies[object].stiffness);
    }
    lower(m.softer_stiffness, m.softer_young);
    const double dynamic = std::max(pressures_[a], pressures_[b]);
    if (dynamic > 0) m.softer_stiffness = std::clamp(dynamic, m.softer_stiffness, most_times * m.softer_stiffness);
    return m;
  }

  double guard_of(int a, int b) const {
    if (table_.plain_sums) return 1;
    return contact_.guard.value_or(std::max(pressures_[a], pressures_[b]) > 0 ? guard_range_of_fast : guard_range);
  }

  struct LawIds {
    int pressure, guard;
    int summary = -1;  // of world.adhesion; -1: without adhesion
    int bond = -1;     // of the bond table; -1: without bonds
  };

  LawIds laws_of(int a, int b, int config) {
    PairMaterials materials = materials_of(a, b);
    const double offset = table_.offset(a, b), guarded = guard_of(a, b);
    const auto key = std::tuple{config, materials.softer_young, materials.softer_stiffness, offset, guarded};
    if (const auto found = laws_.find(key); found != laws_.end()) {
      if (found->second.summary >= 0) add_to(world_.adhesion[found->second.summary], a, b);
      return found->second;
    }
    const PairConfig* pair = config >= 0 ? &contact_.pairs[config] : nullptr;
    PairLaw pressure(offset), guard(offset);
    std::shared_ptr<NormalLaw> adhesion;
    std::shared_ptr<BondLaw> bond;
    try {
      if (pair && pair->bonds()) {
        bond = dynamic_cast<const BondLaw&>(*pair->adhesion).clone();
        bond->prepare(materials);
        materials.adhesion_peak = bond->peak_traction();
      } else if (pair && pair->adhesion) {
        adhesion = dynamic_cast<const NormalAdhesion&>(*pair->adhesion).clone();
        adhesion->prepare(materials);
        materials.adhesion_peak = dynamic_cast<const AdhesionLaw&>(*adhesion).peak_traction();
      }
      const BarrierLaw& barrier = pair && pair->barrier ? *pair->barrier : *contact_.barrier;
      std::shared_ptr<NormalLaw> full = barrier.clone(), close = barrier.clone();
      full->prepare(materials);
      materials.contact_distance *= guarded;
      close->prepare(materials);
      pressure.add(full);
      guard.add(close);
    } catch (const InputError& error) {
      if (!pair) throw InputError(contact_place() + error.what());
      throw configs_.error(config, error.what());
    }
    if (adhesion) {
      pressure.add(adhesion);
      if (table_.plain_sums) guard.add(adhesion);
      report(a, b, dynamic_cast<const AdhesionLaw&>(*adhesion), pressure);
    }
    const TangentialLaw along = tangential_of(pair, materials.adhesion_peak);
    TangentialLaw along_guard = along;
    if (!table_.plain_sums) along_guard.mu_a = 0;  // guards do not adhere
    int rule = -1;
    if (bond) {
      rule = bonds_.add(rule_of(*pair, bond, pressure, config));
      report(a, b, *bond);
    }
    const LawIds ids{table_.add_law(pressure, along), table_.add_law(guard, along_guard),
                     adhesion || bond ? static_cast<int>(world_.adhesion.size()) - 1 : -1, rule};
    laws_.emplace(key, ids);
    return ids;
  }

  void add_to(AdhesionSummary& summary, int a, int b) const {
    summary.pairs += classes_.pairs_like(a, b);
    summary.kinds.push_back({a, b});
  }

  void report(int a, int b, const AdhesionLaw& adhesion, const PairLaw& law) {
    const PairLaw::Well well = law.well();
    world_.adhesion.push_back({{world_.bodies[a].name, world_.bodies[b].name}, classes_.pairs_like(a, b), {{a, b}},
                               adhesion.work_of_adhesion(), well.depth, well.gap,
                               adhesion.peak_traction()});
  }

  bool has_surface(int object) const { return !world_.bodies[object].triangles.empty() || !world_.bodies[object].surface_triangles.empty(); }

  void set_bond(int a, int b, int rule, int config) {
    if (!has_surface(a) && !has_surface(b))
      throw configs_.error(config, fmt::format("neither '{}' nor '{}' has a surface: bonds are anchored in triangles; choose an adhesion of the gap for rods and "
                                               "particles among each other (tack list adhesion)", world_.bodies[a].name, world_.bodies[b].name));
    bonds_.set(a, b, rule);
    if (table_.plain_sums)
      throw configs_.error(config, "bonds stand for areas, and contact.weights: pair counts close pairs instead; take it away, or choose an adhesion of the gap");
  }

  // Bonds are there without the barrier, and hold from the gap that they are made at, or from touching.
  void report(int a, int b, const BondLaw& bond) {
    world_.adhesion.push_back({{world_.bodies[a].name, world_.bodies[b].name}, classes_.pairs_like(a, b), {{a, b}},
                               bond.work_of_adhesion(), bond.work_of_adhesion(), 0, bond.peak_traction()});
  }

  BondRule rule_of(const PairConfig& pair, std::shared_ptr<const BondLaw> law, const PairLaw& barrier, int config) {
    const double distance = pair.bond_distance.value_or(contact_.contact_distance);
    if (distance > 2 * contact_.contact_distance)
      throw configs_.error(config, fmt::format("bond_distance is {:.6g} m, and contact sees twice its distance, {:.6g} m; lower it, or raise contact.distance",
                                               distance, 2 * contact_.contact_distance));
    using Bonding = PairConfig::Bonding;
    const bool on_contact = pair.bond == Bonding::on_contact || (pair.bond == Bonding::automatic && law->bonds_on_contact());
    table_.set_bond_reach(distance + barrier.offset());
    const std::string type(law->type());
    return {std::move(law), type, on_contact, distance, pair.unstressed == PairConfig::Unstressed::touching, barrier};
  }

  void set_roles(int a, int b, int config) {
    const LawIds ids = laws_of(a, b, config);
    if (ids.bond >= 0) set_bond(a, b, ids.bond, config);
    const double range = table_.laws()[ids.pressure].range(), range_of_guard = table_.laws()[ids.guard].range();
    const PairRole guard{ids.guard, 1, range_of_guard, false};
    // An edge pair's area is half the mean of its two edges' (they count the surface twice).
    table_.set_edge(a, b, {ids.guard, 0.25, range_of_guard, false});
    table_.set_thin(a, b, {ids.pressure, 1, range});
    if (table_.plain_sums) {
      table_.point(a, b) = table_.point(b, a) = {ids.pressure, 1, range, false};
      return;
    }
    PairRole pressure{ids.pressure, 1, range, true, ids.guard, range_of_guard};
    pressure.covered = a != b && config >= 0 && contact_.pairs[config].adhesion;
    pressure.bonds = ids.bond >= 0;
    const std::string& side = config >= 0 ? contact_.pairs[config].integrate : PairConfig().integrate;
    pressure.by_size = a != b && side == "automatic" && !pressure.covered;
    // Both may be of the group that is named.
    const bool both = side == "both" || (config >= 0 && configs_.integrates(config, a) && configs_.integrates(config, b));
    if (a == b || both || pressure.by_size) {
      pressure.share = 0.5;
      table_.point(a, b) = table_.point(b, a) = pressure;
    } else if (side == "automatic") {
      pressure.automatic = true;
      table_.point(a, b) = table_.point(b, a) = pressure;
    } else if (side == "finer") {
      pressure.finer = true;
      table_.point(a, b) = table_.point(b, a) = pressure;
    } else {
      const bool first = configs_.integrates(config, a);
      table_.point(a, b) = first ? pressure : guard;
      table_.point(b, a) = first ? guard : pressure;
    }
  }

  const SceneConfig& scene_;
  const ContactConfig& contact_;
  const Value& root_;
  World& world_;
  const std::vector<double> pressures_;  // dynamic ones, of objects [Pa]
  ObjectClasses classes_;
  PairConfigs configs_;
  PairTable table_;
  CollidingObjects colliding_;
  BondTable bonds_;
  std::map<std::tuple<int, double, double, double, double>, LawIds> laws_;
};

// With a range beyond the scene's own size, everything is in contact with everything: a mistake in a unit, and
// pairs without end.
void check_range(const PairTable& table, const Value& root, const VecX& rest) {
  double range = 0;
  for (const auto& law : table.laws()) range = std::max(range, law.range());
  const auto points = rest.reshaped(3, rest.size() / 3);
  const double size = (points.rowwise().maxCoeff() - points.rowwise().minCoeff()).norm();
  if (range <= 10 * size) return;
  const Value* contact = root.find("contact");
  throw InputError(fmt::format("{}contact reaches over {:g} m, and the whole scene is {:g} m large; lower contact.distance or "
                               "the range of the adhesion", contact ? contact->mark.text() + ": " : "", range, size));
}

// What a script holds rigidly, and affine bodies; empty without either.
std::vector<int> rigid_groups(const World& world) {
  if (world.script.holds().empty() && world.bindings.frames().empty()) return {};
  std::vector<int> groups;
  for (int v = 0; v < world.dofs.vertex_count(); ++v) groups.push_back(world.script.rigid_group(v));
  int next = static_cast<int>(world.script.holds().size()) + 1;
  for (const AffineFrame& body : world.bindings.frames()) {
    const bool held = std::all_of(body.carried.begin(), body.carried.end(),
                                  [&](const AffineFrame::Carried& c) { return groups[c.vertex] >= 0; });
    ++next;
    for (const AffineFrame::Carried& c : body.carried)
      if (!held) groups[c.vertex] = next;
  }
  for (const Dependence& d : world.bindings.lasting()) {
    const int group = groups[d.on.front().first];
    const bool one = std::all_of(d.on.begin(), d.on.end(), [&](const auto& on) { return groups[on.first] == group; });
    groups[d.vertex] = one ? group : -1;
  }
  return groups;
}

}  // namespace

void build_contact(const SceneConfig& scene, const Value& root, PhaseClock& clock, World& world) {
  if (!scene.contact) return;
  ContactSurface surface;
  std::vector<SurfaceSize> sizes;
  const std::vector<char> hulls = find_hulls(world);
  for (size_t i = 0; i < world.bodies.size(); ++i)
    sizes.push_back(add_surface(world.bodies[i], static_cast<int>(i), world.rest, hulls[i], surface));
  std::sort(surface.mesh.vertices.begin(), surface.mesh.vertices.end());
  surface.rest = world.rest;
  surface.mesh.vertex_movable.resize(world.rest.size() / 3);
  for (int v = 0; v < world.dofs.vertex_count(); ++v)
    surface.mesh.vertex_movable[v] = world.dofs.moves(v) || world.script.may_move(v);
  surface.mesh.vertex_object.insert(surface.mesh.vertex_object.end(), world.extra_object.begin(), world.extra_object.end());
  surface.mesh.vertex_group = rigid_groups(world);
  PairBuilder builder(scene, root, sizes, world);
  builder.build();
  BondTable bonds = std::move(builder.bonds());
  check_range(builder.table(), root, world.rest);
  world.contact = std::make_unique<ContactSystem>(std::move(surface), std::move(builder.table()),
                                                  builder.colliding(), clock);
  world.contact_term = std::make_unique<ContactTerm>(*world.contact);
  if (world.contact->pairs().any_rim()) world.rim = std::make_unique<RimTerm>(*world.contact);
  if (!bonds.empty()) world.bonds = std::make_unique<BondTerm>(*world.contact, *world.contact_term, std::move(bonds));
  if (world.contact->pairs().any_tangential())
    world.friction = std::make_unique<FrictionTerm>(*world.contact, *world.contact_term);
}

}  // namespace tack
