#include "framework/law/law_source.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/bond/bond_term.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/laws/law_peak.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/experiment/file_kind.hpp"
#include "framework/plugin/plugins.hpp"
#include "framework/setup/adhesion_lengths.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns the law at a temperature [K].
std::shared_ptr<const BondLaw> at_temperature(const BondLaw& law, double kelvin) {
  std::shared_ptr<BondLaw> other = law.clone();
  SiteState site = law.assumed_site();
  site.temperature = kelvin;
  other->assume_site(site);
  return other;
}

std::vector<StudiedLaw> laws_of_scene(Value root, const LawSource& source) {
  if (source.contact_distance || source.barrier_stiffness)
    throw InputError(fmt::format("{}: a scene has its own barrier: give contact.distance=... or contact.barrier.stiffness=..., without --", source.file));
  BuiltExperiment built(bound_experiment(std::move(root)));
  const World& world = built.world();
  std::vector<StudiedLaw> laws;
  for (const AdhesionSummary& adhesion : world.adhesion) {
    const auto& [a, b] = adhesion.kinds.front();
    const PairTable& table = world.contact->pairs();
    StudiedLaw law;
    law.pair = table.laws()[table.codimensional(a, b, adhesion.region_pair).law];
    for (const auto& term : law.pair.laws())
      if (auto gap = std::dynamic_pointer_cast<const NormalAdhesion>(term)) law.gap = std::move(gap);
    if (const int rule = world.bonds ? world.bonds->table().between(a, b, adhesion.region_pair) : -1; rule >= 0) law.bond = world.bonds->table().rules()[rule].law;
    if (law.bond && law.bond->depends_on_temperature() && built.experiment().environment)
      law.bond = at_temperature(*law.bond, built.experiment().environment->temperature(0, world.rest.reshaped(3, world.rest.size() / 3).rowwise().mean()));
    law.name = fmt::format("{} of {}", law.law().type(), adhesion.names());
    law.contact_distance = built.experiment().contact->contact_distance;
    const PairStiffness softer = pair_stiffness(built.experiment(), world, adhesion.kinds.front());
    law.young = softer.young;
    law.bending_stiffness = softer.bending;
    law.young = source.young.value_or(law.young);
    laws.push_back(std::move(law));
  }
  if (laws.empty())
    throw InputError(fmt::format("{}: the scene has no adhesive pair; name one under contact.pairs, with `adhesion`", source.file));
  return laws;
}

std::unique_ptr<AdhesionLaw> prepared(const Value& value, const PairMaterials& materials) {
  std::unique_ptr<AdhesionLaw> law = bind_component<AdhesionLaw>(value);
  law->prepare(materials);
  return law;
}

// Returns a contact distance at which the barrier does not reduce the peak: half of the gap of the
// peak, rounded down to one digit [m]; nothing if the law has no such gap.
std::optional<double> contact_distance_below_peak(const Value& value, PairMaterials materials) {
  try {
    materials.contact_distance = 0;
    const auto law = prepared(value, materials);
    const auto* gap = dynamic_cast<const NormalLaw*>(law.get());
    const double half = gap ? last_gap_with(*gap, 0.99 * largest_traction(*gap).traction) / 2 : 0;
    if (!(half > 0) || !std::isfinite(half)) return std::nullopt;
    const double digit = std::pow(10.0, std::floor(std::log10(half)));
    return std::floor(half / digit) * digit;
  } catch (const InputError&) {
    return std::nullopt;
  }
}

StudiedLaw law_of(const Value& value, const LawSource& source) {
  PairMaterials materials{source.contact_distance.value_or(ContactConfig().contact_distance), source.young.value_or(0)};
  std::shared_ptr<AdhesionLaw> law;
  try {
    law = prepared(value, materials);
  } catch (const InputError&) {
    // The default contact distance may exceed the range of the law.
    const auto distance = source.contact_distance ? std::nullopt : contact_distance_below_peak(value, materials);
    if (!distance) throw;
    materials.contact_distance = *distance;
    law = prepared(value, materials);
  }
  StudiedLaw studied;
  studied.name = law->type();
  studied.gap = std::dynamic_pointer_cast<const NormalAdhesion>(law);
  studied.bond = std::dynamic_pointer_cast<const BondLaw>(law);
  studied.contact_distance = materials.contact_distance;
  studied.young = source.young.value_or(0);
  materials.adhesion_peak = law->peak_traction();
  Value barrier = to_value(ContactConfig().barrier.get());
  if (source.barrier_stiffness) barrier.set("stiffness", Value::number(*source.barrier_stiffness));
  std::shared_ptr<BarrierLaw> barrier_law = bind_component<BarrierLaw>(barrier);
  barrier_law->prepare(materials);
  studied.pair.add(barrier_law);
  if (studied.gap) studied.pair.add(studied.gap);
  return studied;
}

}  // namespace

namespace {

std::vector<StudiedLaw> laws_at_room_temperature(const LawSource& source) {
  if (source.file.empty() == source.type.empty())
    throw InputError(source.file.empty()
                         ? fmt::format("tack law: no law given; give a scene, the file of an adhesion, or --type NAME (one of {})",
                                       fmt::join(Registry<AdhesionLaw>::kind().names(), ", "))
                         : fmt::format("tack law: either the file '{}' or --type {}, not both", source.file, source.type));
  Value root = Value::map();
  if (source.file.empty()) {
    root.mark.file = std::make_shared<const std::string>("tack law --type " + source.type);
    root.set("type", Value::scalar(source.type));
    Registry<AdhesionLaw>::kind().entry(source.type);
  } else {
    root = parse_file(source.file);
  }
  for (const std::string& setting : source.settings) apply_override(root, setting);
  load_plugins(root);
  if (root.find("type")) return {law_of(root, source)};
  refuse_other_kind(root, FileKind::scene);
  if (!root.find("objects"))
    throw InputError(fmt::format("{}: neither a scene, with `objects`, nor an adhesion, with a `type` as first key", source.file));
  return laws_of_scene(std::move(root), source);
}

}  // namespace

std::vector<StudiedLaw> laws_of(const LawSource& source) {
  std::vector<StudiedLaw> laws = laws_at_room_temperature(source);
  if (!source.temperature) return laws;
  const auto sees = [](const StudiedLaw& law) { return law.bond && law.bond->depends_on_temperature(); };
  if (std::none_of(laws.begin(), laws.end(), sees)) throw InputError("--temperature: the law does not depend on the temperature; take it away, or choose one that does (`viscoelastic` with `shift`)");
  for (StudiedLaw& law : laws)
    if (sees(law)) law.bond = at_temperature(*law.bond, *source.temperature);
  return laws;
}

}  // namespace tack
