#include "framework/checks/round_friction.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "framework/contact/contact_system.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "framework/scene/rolling_energy.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

// Per vertex: other vertices or motions lead it throughout.
std::vector<char> led_vertices(const World& world) {
  std::vector<char> led(world.rest.size() / 3, 0);
  for (const Dependence& d : world.constraints.lasting()) led[d.vertex] = 1;
  for (const TimedConstraint& timed : world.constraints.timed())
    for (const Dependence& d : timed.dependences) led[d.vertex] = 1;
  for (int v = 0; v < world.mesh_vertex_count(); ++v)
    if (!world.prescribed_motion.ever_free(v)) led[v] = 1;
  return led;
}

// Returns the vertices of each connected component of the edges, ordered by their smallest
// vertices.
std::vector<std::vector<int>> components_of(const std::vector<Edge>& edges) {
  int end = 0;
  for (const auto& [a, b] : edges) end = std::max({end, a + 1, b + 1});
  DisjointSets sets(end);
  std::vector<char> used(end, 0);
  for (const auto& [a, b] : edges) {
    sets.join(a, b);
    used[a] = used[b] = 1;
  }
  std::vector<std::vector<int>> components;
  std::vector<int> component_of(end);  // of each set, at its smallest vertex
  for (int v = 0; v < end; ++v) {
    if (!used[v]) continue;
    const int smallest = sets.find(v);
    if (smallest == v) {
      component_of[v] = static_cast<int>(components.size());
      components.emplace_back();
    }
    components[component_of[smallest]].push_back(v);
  }
  return components;
}

// Returns the largest coefficient of friction of two objects, wherever they touch; 0 without
// contact.
double friction_between(const PairTable& pairs, int a, int b) {
  double mu = 0;
  const auto take = [&](const PairRole& role) {
    for (const int law : {role.law, role.safety_barrier})
      if (law >= 0) mu = std::max(mu, pairs.tangential(law).mu_static);
  };
  for (int part = -1; part < pairs.region_pair_count(a, b); ++part) {
    take(pairs.point(a, b, part));
    take(pairs.point(b, a, part));
    take(pairs.edge(a, b, part));
    take(pairs.codimensional(a, b, part));
  }
  return mu;
}

class RoundFriction {
 public:
  RoundFriction(const SceneConfig& scene, const World& world) : scene_(scene), world_(world), led_(led_vertices(world)) {}

  std::vector<Warning> lines() {
    for (int i = 0; i < static_cast<int>(world_.bodies.size()); ++i) {
      const Body& body = world_.bodies[i];
      if (!body.movable || rolls(scene_.objects[i])) continue;
      if (body.section && body.section->circular()) {
        const auto rods = components_of(body.edges);
        warn(i, "rod", static_cast<int>(std::count_if(rods.begin(), rods.end(), [&](const auto& rod) { return free(rod); })), rods.size() > 1);
      }
      if (body.radius > 0)
        warn(i, "particle", static_cast<int>(std::count_if(body.points.begin(), body.points.end(), [&](int v) { return !led_[v]; })),
             body.points.size() > 1);
    }
    std::vector<Warning> warnings;
    for (const Line& line : lines_) warnings.emplace_back(WarningKind::sliding_round_bodies, text(line));
    return warnings;
  }

 private:
  // One warning for all objects with the same partner, coefficient and remedy.
  struct Line {
    std::string kind, remedy;
    std::string first;  // object
    int partner;
    double mu;
    int more = 0;  // objects
  };

  bool free(const std::vector<int>& vertices) const {
    return std::none_of(vertices.begin(), vertices.end(), [&](int v) { return led_[v] != 0; });
  }

  // several: some of the object can touch others of it.
  void warn(int i, const std::string& kind, int loose, bool several) {
    if (loose == 0) return;
    const PairTable& pairs = world_.contact->pairs();
    double mu = 0;
    int partner = -1;
    for (int j = 0; j < pairs.objects(); ++j) {
      if (j == i && !several) continue;
      if (const double here = friction_between(pairs, i, j); here > mu) mu = here, partner = j;
    }
    if (partner < 0) return;
    Line line{kind, remedy(i, kind), world_.bodies[i].name, partner, mu};
    for (Line& earlier : lines_)
      if (earlier.kind == line.kind && earlier.remedy == line.remedy && earlier.partner == partner && earlier.mu == mu) {
        ++earlier.more;
        return;
      }
    lines_.push_back(std::move(line));
  }

  std::string text(const Line& line) const {
    const std::string others = line.more > 0 ? fmt::format(", and of {} more object{},", line.more, line.more > 1 ? "s" : "") : "";
    return fmt::format("the {}s of '{}'{} are round and can rub on '{}' (mu {:g}), and they slide without turning: on a slope they stick where they "
                       "would roll; {}, or set its friction to 0",
                       line.kind, line.first, others, world_.bodies[line.partner].name, line.mu, line.remedy);
  }

  std::string remedy(int i, const std::string& kind) const {
    if (kind == "rod" && !world_.bodies[i].rod) return "give it the energy elastic_rod with `rolling: true`";
    return fmt::format("give its energy {} `rolling: true`", kind == "rod" ? "elastic_rod" : "particle");
  }

  const SceneConfig& scene_;
  const World& world_;
  std::vector<char> led_;
  std::vector<Line> lines_;
};

}  // namespace

std::vector<Warning> round_friction_warnings(const SceneConfig& scene, const World& world) {
  if (!world.contact || !world.friction) return {};
  return RoundFriction(scene, world).lines();
}

}  // namespace tack
