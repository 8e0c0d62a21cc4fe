#include "framework/setup/pair_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/setup/contact_support.hpp"
#include "framework/setup/driven_law.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "framework/setup/pair_friction.hpp"
#include "framework/setup/sheet_stiffness.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// An affine body is much stiffer than its contacts need: with a tenth of this fraction of its
// stiffness, they carry, at half their distance, the stress that strains it by 1e-4.
constexpr double affine_modulus = 0.01;
// A soft body faster than its elastic waves presses with about density times speed^2, which the
// barrier must carry. The barrier takes the body as stiff as that, up to this multiple of its
// modulus.
constexpr double stiffness_ratio_max = 10;
// Ranges of safety barriers. A body faster than its waves is crushed on edges and tips, where only
// safety barriers stop it; there they act over the whole contact distance.
constexpr double safety_barrier_range = 0.5, safety_barrier_range_of_fast = 1;  // contact distances

// Objects are of one class if all entries of pairs match them alike and they have equal stiffness,
// speed, thickness, prescribed motion and attachments.
ObjectClasses classes_of(const SceneConfig& scene, const World& world, const std::vector<double>& pressures, const std::vector<double>& sheets, const std::vector<double>& resting) {
  std::set<std::string> names;
  for (const PairConfig& pair : scene.contact->pairs)
    for (const PairSide& side : pair.between) names.insert(side.object);
  std::vector<std::set<int>> attached(world.bodies.size());
  for (const auto& [a, b] : world.attached) attached[a].insert(b), attached[b].insert(a);
  using Key = std::tuple<std::vector<NamedAs>, std::set<int>, bool, bool, double, double, double, double, double, double, double, bool>;
  std::map<Key, int> known;
  std::vector<int> classes;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const ObjectConfig& object = scene.objects[i];
    const Body& body = world.bodies[i];
    std::vector<NamedAs> named;
    for (const std::string& name : names) named.push_back(named_as(object, name));
    const Key key{std::move(named), attached[i], body.movable, body.section.has_value(), object.contact_offset, softest_young(object), body.stiffness, pressures[i], sheets[i], resting[i], object.friction.value_or(-1), object.grain.has_value()};
    classes.push_back(known.emplace(key, static_cast<int>(known.size())).first->second);
  }
  return ObjectClasses(std::move(classes));
}

// Returns the traction from which the default barrier takes its stiffness (a twentieth): the peak
// of the adhesion. Where weight and loads exceed ten times the peak, such a barrier would leave
// almost no gap and adhesion would have no effect. The stiffness is then that of the pressure less
// ten peaks, so that it is continuous, with a gap of about half the distance. Weaker adhesion
// changes the pressure by less than a tenth, and a gap of half the distance by less than 0.02
// distances (the slope of the clamped logarithm there).
double barrier_traction(double adhesion_peak, double resting) {
  constexpr double effect_limit = 10;   // peaks of the adhesion
  constexpr double of_adhesion = 0.05;  // as in energies/barrier/clamped_log.cpp
  return adhesion_peak > 0 ? std::max(adhesion_peak, (resting - effect_limit * adhesion_peak) / of_adhesion) : 0;
}

std::vector<double> mean_areas(const std::vector<ContactPrimitives>& primitives) {
  std::vector<double> areas;
  for (const ContactPrimitives& of_object : primitives) areas.push_back(of_object.mean_area);
  return areas;
}

bool adheres(const ContactConfig& contact) {
  return std::any_of(contact.pairs.begin(), contact.pairs.end(), [](const PairConfig& pair) { return pair.adhesion != nullptr; });
}

std::vector<double> contact_offsets(const SceneConfig& scene) {
  std::vector<double> offsets;
  for (const ObjectConfig& object : scene.objects) offsets.push_back(object.contact_offset);
  return offsets;
}

}  // namespace

PairBuilder::PairBuilder(const SceneConfig& scene, const Value& root, std::vector<ContactPrimitives> primitives, const RunTimes& times, World& world, ContactPotential& potential)
    : scene_(scene), contact_(*scene.contact), root_(root), world_(world), potential_(potential), primitives_(std::move(primitives)), loadings_(loadings(scene, world, times.duration)),
      pressures_(dynamic_pressures(scene, world, loadings_)), sheets_(sheet_stiffnesses(scene, world, loadings_, times.step)),
      resting_(adheres(contact_) ? resting_pressures(scene, world, times.duration) : std::vector<double>(world.bodies.size(), 0)),
      classes_(classes_of(scene, world, pressures_, sheets_, resting_)), configs_(scene, root, classes_), regions_(scene, configs_, world), table_(classes_, mean_areas(primitives_)),
      colliding_(classes_), bonds_(classes_, contact_offsets(scene)) {
  if (regions_.any()) table_.set_regions(regions_.vertex_regions());
}

// Throws InputError at a barrier, or a range of safety barriers, that the scene chooses and the model does not have.
void PairBuilder::refuse_unsupported_barriers() const {
  const Value* contact = root_.find("contact");
  const std::string_view model = contact_.model->type();
  if (const Value* barrier = contact ? contact->find("barrier") : nullptr)
    if (const std::string text = unsupported_text(potential_, model, ContactFeature::barrier, {}, {}); !text.empty())
      throw InputError(barrier->mark.text() + ": " + text);
  if (!contact_.safety_barrier) return;
  const double chosen = *contact_.safety_barrier, range = potential_.safety_barrier_range(chosen);
  if (chosen != range)
    throw InputError(contact_location() + fmt::format("contact.safety_barrier is {:.6g}, and contact.model: {} has barriers over {:.6g} contact distances for all pairs; take it away, or "
                                                      "choose model: area_integral", chosen, model, range));
}

void PairBuilder::build() {
  refuse_unsupported_barriers();
  for (size_t i = 0; i < scene_.objects.size(); ++i)
    if (scene_.objects[i].grain && !primitives_[i].triangles)
      throw InputError(fmt::format("object '{}': a grain is of surfaces of triangles, and it has none; take it away", scene_.objects[i].name));
  const std::set<std::pair<int, int>> all_attached(world_.attached.begin(), world_.attached.end());
  for (const auto& [a, b] : classes_.examples()) {
    const int index = configs_.of(a, b);
    const std::vector<int> regions = configs_.of_regions(a, b);
    const bool attached = all_attached.contains({a, b});
    if (attached && index >= 0 && contact_.pairs[index].contact && configs_.names_objects(index))
      throw configs_.error(index,
                           fmt::format("'{}' and '{}' touch where one is attached to the other, so there is no contact between "
                                       "them; take the pair away, or leave a gap", world_.bodies[a].name, world_.bodies[b].name));
    const bool prescribed = !world_.bodies[a].movable && !world_.bodies[b].movable, through = index >= 0 && !contact_.pairs[index].contact;
    if (!regions.empty()) check_regions(a, b, regions, attached || through);
    if (attached || (prescribed && !contact_.between_prescribed) || through) {
      colliding_.set(a, b, false);
      continue;
    }
    // No law, but the exact check detects a prescribed object driven through another.
    if (prescribed) continue;
    table_.set_offset(a, b, offset_of(a, b));
    set_roles(a, b, index, regions);
  }
}

// no_contact: the two objects have no contact.
void PairBuilder::check_regions(int a, int b, const std::vector<int>& regions, bool no_contact) const {
  for (const int entry : regions) {
    if (!contact_.pairs[entry].contact)
      throw configs_.error(entry, "objects without contact have none in any region; take `contact: false` away, or name whole objects");
    if (no_contact && configs_.names_objects(entry))
      throw configs_.error(entry, fmt::format("'{}' and '{}' have no contact, because one is attached to the other or their pair says so, and neither have regions of them; take this "
                                              "pair away", world_.bodies[a].name, world_.bodies[b].name));
  }
  regions_.require_distinct(regions, a, b);
}

std::string PairBuilder::contact_location() const {
  const Value* contact = root_.find("contact");
  return contact ? contact->mark.text() + ": " : "";
}

std::string PairBuilder::model_location() const {
  const Value* contact = root_.find("contact");
  const Value* model = contact ? contact->find("model") : nullptr;
  return model ? model->mark.text() + ": " : contact_location();
}

// Returns the tangential law of two objects whose adhesion has the given peak traction.
TangentialLaw PairBuilder::tangential_of(const PairConfig* pair, double peak_traction, int a, int b) const {
  TangentialLaw law;
  const ObjectConfig &first = scene_.objects[a], &second = scene_.objects[b];
  if (const auto friction = friction_of(pair, contact_, first, second)) {
    law.mu = friction->mu;
    law.across = across_of(*friction, pair && pair->friction, first, second);
    law.eps_v = friction->full_speed();
    if (friction->sticks()) law.elastic_slip = friction->slip_of_stick(contact_.contact_distance);
    law.mu_static = friction->largest();
    law.stribeck = friction->stribeck_speed.value_or(10 * friction->full_speed());
  }
  if (pair && pair->tangential_adhesion) {
    if (law.sticks())
      throw InputError("tangential_adhesion acts by the slip of a step, and friction of `model: stick` by the slip from an anchor; take tangential_adhesion away (bonds resist shear at "
                       "rest: `tack list adhesion`), or give this pair smoothed friction");
    if (law.across != 1)
      throw InputError("tangential_adhesion is the same in all directions; take it away, or mu_across");
    law.mu_a = pair->tangential_adhesion->mu;
    law.eps_a = pair->tangential_adhesion->eps_a.value_or(law.eps_v);
    law.peak_traction = peak_traction;
  }
  return law;
}

double PairBuilder::offset_of(int a, int b) const { return scene_.objects[a].contact_offset + scene_.objects[b].contact_offset; }

// Both moduli are 0 if no side has one.
PairMaterials PairBuilder::materials_of(int a, int b) const {
  PairMaterials m{contact_.contact_distance};
  const auto lower = [](double& softer, double modulus) {
    if (modulus > 0 && (softer == 0 || modulus < softer)) softer = modulus;
  };
  for (const int object : {a, b}) {
    lower(m.softer_young, softest_young(scene_.objects[object]));
    lower(m.softer_stiffness, affine_modulus * world_.bodies[object].stiffness);
    lower(m.softer_stiffness, sheets_[object]);
  }
  lower(m.softer_stiffness, m.softer_young);
  const double dynamic = std::max(pressures_[a], pressures_[b]);
  if (dynamic > 0) m.softer_stiffness = std::clamp(dynamic, m.softer_stiffness, stiffness_ratio_max * m.softer_stiffness);
  return m;
}

double PairBuilder::safety_barrier_range_of(int a, int b) const {
  return potential_.safety_barrier_range(contact_.safety_barrier.value_or(std::max(pressures_[a], pressures_[b]) > 0 ? safety_barrier_range_of_fast : safety_barrier_range));
}

PairBuilder::LawIds PairBuilder::laws_of(int a, int b, int config, int region) {
  PairMaterials materials = materials_of(a, b);
  const double offset = table_.offset(a, b), barrier_range = safety_barrier_range_of(a, b), resting = std::max(resting_[a], resting_[b]);
  // Friction depends on the coefficients of both surfaces and on the number of grains.
  const ObjectConfig &first = scene_.objects[a], &second = scene_.objects[b];
  const double own_friction = first.friction && second.friction ? blended(contact_.blend, *first.friction, *second.friction) : -1;
  const int grains = first.grain.has_value() + (a != b && second.grain.has_value());
  const auto key = std::tuple{config, region, materials.softer_young, materials.softer_stiffness, offset, barrier_range, resting, own_friction, grains};
  if (const auto found = laws_.find(key); found != laws_.end()) {
    if (found->second.summary >= 0) add_to(world_.adhesion[found->second.summary], a, b);
    return found->second;
  }
  const PairConfig* pair = config >= 0 ? &contact_.pairs[config] : nullptr;
  PreparedLaws prepared;
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
    const BarrierLaw& barrier_law = pair && pair->barrier ? *pair->barrier : *contact_.barrier;
    std::shared_ptr<NormalLaw> full = barrier_law.clone(), close = barrier_law.clone();
    PairMaterials of_barrier = materials;
    of_barrier.adhesion_peak = barrier_traction(materials.adhesion_peak, resting);
    full->prepare(of_barrier);
    of_barrier.contact_distance *= barrier_range;
    close->prepare(of_barrier);
    prepared = {offset, full, close, adhesion, tangential_of(pair, materials.adhesion_peak, a, b)};
  } catch (const InputError& error) {
    if (!pair) throw InputError(contact_location() + error.what());
    throw configs_.error(config, error.what());
  }
  if (adhesion) report(a, b, region, dynamic_cast<const AdhesionLaw&>(*adhesion), prepared.barrier_and_adhesion());
  int rule = -1;
  if (bond) {
    rule = bonds_.add(rule_of(*pair, bond, prepared.barrier_and_adhesion(), config));
    report(a, b, region, *bond);
  }
  if (adhesion && pair && !pair->drive.empty())
    prepared.adhesion = std::make_shared<DrivenLaw>(adhesion, world_.drives.follow(pair->drive, FollowerKind::adhesion, fmt::format("contact.pairs[{}]", config)));
  PairSetup setup = setup_of(a, b);
  setup.region = region >= 0;
  setup.gap_adhesion = adhesion != nullptr;
  const LawIds ids{potential_.add_laws(setup, prepared, table_), adhesion || bond ? static_cast<int>(world_.adhesion.size()) - 1 : -1, rule};
  laws_.emplace(key, ids);
  return ids;
}

void PairBuilder::add_to(AdhesionSummary& summary, int a, int b) const {
  summary.pairs += classes_.pairs_like(a, b);
  summary.kinds.push_back({a, b});
}

void PairBuilder::report(int a, int b, int region, const AdhesionLaw& adhesion, const PairLaw& law) {
  const PairLaw::Well well = law.well();
  world_.adhesion.push_back({{world_.bodies[a].name, world_.bodies[b].name}, classes_.pairs_like(a, b), {{a, b}}, region,
                             adhesion.work_of_adhesion(), well.depth, well.gap,
                             adhesion.peak_traction()});
}

PairSetup PairBuilder::setup_of(int a, int b) const {
  PairSetup setup;
  setup.a = a;
  setup.b = b;
  const ContactPrimitives &first = primitives_[a], &second = primitives_[b];
  setup.surfaces = first.triangles && second.triangles;
  setup.rods = first.rods || second.rods;
  setup.particles = first.particles || second.particles;
  return setup;
}

// Throws InputError at an entry of contact.pairs if the model does not support a feature of it.
void PairBuilder::refuse_unsupported(const PairSetup& setup, int config, ContactFeature feature) const {
  const std::string text = unsupported_text(potential_, contact_.model->type(), feature, setup, {world_.bodies[setup.a].name, world_.bodies[setup.b].name});
  if (!text.empty()) throw configs_.error(config, text);
}

// Throws InputError at contact.model for rods and particles that the model does not support.
void PairBuilder::refuse_unsupported_primitives(const PairSetup& setup) const {
  for (const auto& [feature, has] : {std::pair{ContactFeature::rods, &ContactPrimitives::rods}, {ContactFeature::particles, &ContactPrimitives::particles}})
    for (const int object : {setup.a, setup.b}) {
      if (!(primitives_[object].*has)) continue;
      const std::string text = unsupported_text(potential_, contact_.model->type(), feature, setup, {world_.bodies[object].name});
      if (!text.empty()) throw InputError(model_location() + text);
    }
}

// Throws InputError for features of an entry of contact.pairs that the model does not support. region: it is of regions.
void PairBuilder::refuse_unsupported(const PairSetup& setup, int config, bool region) const {
  if (config < 0) return;
  const PairConfig& pair = contact_.pairs[config];
  if (region) refuse_unsupported(setup, config, ContactFeature::regions);
  if (pair.bonds()) refuse_unsupported(setup, config, ContactFeature::bonds);
  if (pair.adhesion && !pair.bonds()) refuse_unsupported(setup, config, ContactFeature::adhesion);
  if (pair.tangential_adhesion) refuse_unsupported(setup, config, ContactFeature::tangential_adhesion);
  if (pair.barrier) refuse_unsupported(setup, config, ContactFeature::barrier);
  if (setup.side != IntegrationSide::automatic) refuse_unsupported(setup, config, ContactFeature::integration_side);
  if (setup.side == IntegrationSide::both) refuse_unsupported(setup, config, ContactFeature::both_sides);
}

void PairBuilder::refuse_bond(int a, int b, int config) const {
  if (!primitives_[a].triangles && !primitives_[b].triangles)
    throw configs_.error(config, fmt::format("neither '{}' nor '{}' has a surface: bonds are anchored in triangles; choose an adhesion of the gap for rods and "
                                             "particles among each other (tack list adhesion)", world_.bodies[a].name, world_.bodies[b].name));
}

// Reports bonds, which exist without the barrier and hold from the gap at which they form, or from
// touching.
void PairBuilder::report(int a, int b, int region, const BondLaw& bond) {
  world_.adhesion.push_back({{world_.bodies[a].name, world_.bodies[b].name}, classes_.pairs_like(a, b), {{a, b}}, region,
                             bond.work_of_adhesion(), bond.work_of_adhesion(), 0, bond.peak_traction()});
}

BondRule PairBuilder::rule_of(const PairConfig& pair, std::shared_ptr<const BondLaw> law, const PairLaw& barrier, int config) {
  const double distance = pair.bond_distance.value_or(contact_.contact_distance);
  if (distance > 2 * contact_.contact_distance)
    throw configs_.error(config, fmt::format("bond_distance is {:.6g} m, and contact sees twice its distance, {:.6g} m; lower it, or raise contact.distance",
                                             distance, 2 * contact_.contact_distance));
  using Bonding = PairConfig::Bonding;
  const bool on_contact = pair.bond == Bonding::on_contact || pair.bond == Bonding::first_contact || (pair.bond == Bonding::automatic && law->bonds_on_contact());
  table_.set_bond_range(distance + barrier.offset());
  const std::string type(law->type());
  const bool once = pair.bond == Bonding::first_contact;
  return {std::move(law), type, on_contact, once, pair.bond_pressure.value_or(0), distance, pair.unstressed == PairConfig::Unstressed::touching, barrier};
}

}  // namespace tack
