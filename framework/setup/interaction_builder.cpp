#include "framework/setup/interaction_builder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/config/nearest.hpp"
#include "framework/load/following_load.hpp"
#include "framework/scene/pair_configs.hpp"
#include "framework/setup/add_loads.hpp"
#include "framework/setup/build_world.hpp"
#include "framework/world/embedding.hpp"
#include "framework/world/joint_relations.hpp"
#include "geometry/errors.hpp"

namespace tack {

void ObjectVertices::fields(Fields& f) {
  f.text("object", object, "name of the object").required();
  f.component("select", select, "selected vertices");
}

void Interaction::fields(Fields& f) {
  f.text("name", name_, "name in probes and messages; unless given, its type and its index in the list, from 0").line();
}

InteractionBuilder::InteractionBuilder(const SceneConfig& scene, World& world, std::string name, std::string type)
    : scene_(scene), world_(world), acting_{std::move(name), std::move(type), {}, {}, {}} {}

int InteractionBuilder::body(const std::string& object) const { return world_.index_of(object, fmt::format("interaction '{}': ", name())); }

std::vector<int> InteractionBuilder::bodies(const std::string& name) const {
  std::vector<int> found;
  for (size_t i = 0; i < scene_.objects.size(); ++i)
    if (named_as(scene_.objects[i], name) != NamedAs::not_at_all) found.push_back(static_cast<int>(i));
  if (!found.empty()) return found;
  std::vector<std::string> names;
  for (const ObjectConfig& o : scene_.objects) {
    names.push_back(o.name);
    names.insert(names.end(), o.groups.begin(), o.groups.end());
  }
  throw InputError(fmt::format("interaction '{}': no object or group is named '{}'{}", acting_.name, name, suggestion(name, names, "objects and groups")));
}

std::vector<int> InteractionBuilder::vertices(const ObjectVertices& of) const {
  return select(*of.select, world_.selection_context(body(of.object)));
}

int InteractionBuilder::attachment_point(int body, const Vec3& at) {
  const Embedding embedding(world_, body);
  const Embedding::Attachment attachment = embedding.of(at);
  const std::string& object = world_.bodies[body].name;
  if (attachment.on.empty())
    throw InputError(fmt::format("interaction '{}': '{}' has neither tets nor triangles that could be the host of a point; select vertices of it", name(), object));
  if (attachment.error > Embedding::touching * embedding.size())
    throw InputError(fmt::format("interaction '{}': the point ({:.6g}, {:.6g}, {:.6g}) m is {:.4g} m away from '{}', which has no tets that a point could follow "
                                 "beyond its surface; choose one on it", name(), at.x(), at.y(), at.z(), attachment.error, object));
  Unknowns own = unknowns();
  const int v = own.add_vector_dofs("anchor", std::vector{at})[0];
  if (const std::vector<int>& frame = world_.bodies[body].frame; frame.empty()) {
    own.make_dependent({v, attachment.on});
  } else {
    std::array<double, 4> weights{};
    for (const auto& [on, weight] : attachment.on) weights[static_cast<size_t>(std::find(frame.begin(), frame.end(), on) - frame.begin())] = weight;
    world_.constraints.add_dependent(frame[0], {v, weights});
  }
  return v;
}

int InteractionBuilder::fixed_vertex(const Vec3& at) {
  Unknowns own = unknowns();
  const std::vector<int> v = own.add_vector_dofs("fixed", std::vector{at});
  own.fix(v);
  return v[0];
}

void InteractionBuilder::make_dependent(Dependences dependences, double from, double until) {
  for (const Dependence& d : dependences)
    if (world_.prescribed_motion.ever_fixed(d.vertex)) {
      const int i = world_.body_of(d.vertex);
      throw InputError(fmt::format("interaction '{}': vertex {} of '{}' is prescribed by a motion as well; take it out of one of the two", name(),
                                   i < 0 ? d.vertex : world_.index_in_body(d.vertex), i < 0 ? name() : world_.bodies[i].name));
    }
  world_.constraints.add(TimedConstraint{fmt::format("interaction '{}'", name()), std::move(dependences), from, until});
}

namespace {

int redundant_relation_count(const std::vector<Joint>& joints, const World& world) {
  const std::vector<char> free(static_cast<size_t>(world.rest.size() / 3), 1);
  return solve_joints(joints, world.constraints.frames(), free, world.constraints.unjoined_at(free, std::vector<char>(world.constraints.timed().size(), 0))).redundant;
}

// Throws if a joint of the same bodies already has all relations of this one.
void refuse_duplicate(const Joint& joint, const World& world) {
  for (const Joint& other : world.constraints.joints()) {
    if (!std::is_permutation(joint.bodies.begin(), joint.bodies.end(), other.bodies.begin(), other.bodies.end())) continue;
    const int relation_count = static_cast<int>(joint.relations.size() - joint.own_vertices.size());
    if (redundant_relation_count({other, joint}, world) - redundant_relation_count({other}, world) >= relation_count)
      throw InputError(fmt::format("joint '{}' repeats the relations of '{}'; take one of them away", joint.name, other.name));
  }
}

}  // namespace

void InteractionBuilder::add(Joint joint) {
  joint.name = name();
  bool any = false;
  for (const int i : joint.bodies) {
    const Body& body = world_.bodies[i];
    if (body.frame.empty() || !body.movable) continue;
    any = true;
    if (std::any_of(body.frame.begin(), body.frame.end(), [&](int v) { return world_.prescribed_motion.ever_fixed(v); }))
      throw InputError(fmt::format("joint '{}': a motion of '{}' fixes some of its directions (along, across), which joints do not support; use a hinge or a "
                                   "slider", name(), body.name));
  }
  if (!any)
    throw InputError(fmt::format("joint '{}' moves nothing: none of '{}' is an affine body that may move; give one of them `body: affine`, tie deformable "
                                 "objects by `attach` or springs, and remove joints between fixed objects", name(),
                                 fmt::join([&] {
                                   std::vector<std::string> names;
                                   for (const int i : joint.bodies) names.push_back(world_.bodies[i].name);
                                   return names;
                                 }(), "', '")));
  refuse_duplicate(joint, world_);
  world_.constraints.add(std::move(joint));
}

void InteractionBuilder::exclude_contact(int body, int other) {
  if (body != other) world_.attached.emplace_back(std::min(body, other), std::max(body, other));
}

void InteractionBuilder::add_term(std::unique_ptr<Term> term) {
  acting_.terms.push_back(term.get());
  if (auto* load = dynamic_cast<FollowingLoad*>(term.get())) register_following_load(*load, world_);
  world_.elastic_terms.push_back(std::move(term));
}

std::string InteractionBuilder::add_history(const std::string& what, int width, int entries) {
  acting_.history.push_back({name() + "/" + what, width, entries});
  return acting_.history.back().name;
}

ActingInteraction InteractionBuilder::finish() { return std::move(acting_); }

std::string interaction_name(const SceneConfig& scene, size_t i) {
  const Interaction& interaction = *scene.interactions[i];
  return interaction.given_name().empty() ? fmt::format("{} {}", interaction.type(), i) : interaction.given_name();
}

void add_interactions(const SceneConfig& scene, const Value& root, World& world) {
  std::set<std::string> names;
  const Value* list = root.find("interactions");
  for (size_t i = 0; i < scene.interactions.size(); ++i)
    with_source_location(entry_of(list, i), [&] {
      const Interaction& interaction = *scene.interactions[i];
      const std::string name = interaction_name(scene, i);
      if (!names.insert(name).second) throw InputError(fmt::format("two interactions are named '{}'; names must differ", name));
      if (world.body_index(name) >= 0)
        throw InputError(fmt::format("interaction '{}' has the name of an object; name one of them otherwise", name));
      InteractionBuilder builder(scene, world, name, std::string(interaction.type()));
      std::set<int> bodies;
      for (const std::string& object : interaction.objects())
        for (const int body : builder.bodies(object)) bodies.insert(body);
      interaction.build(builder);
      ActingInteraction acting = builder.finish();
      acting.bodies.assign(bodies.begin(), bodies.end());
      world.interactions.push_back(std::move(acting));
    });
}

}  // namespace tack
