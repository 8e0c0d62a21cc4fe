#include "framework/profile/isolated_pair.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

#include "framework/contact/contact_potential.hpp"
#include "framework/core/step_filter.hpp"

namespace tack {
namespace {

// The bodies of a pair, with vertices and objects renumbered.
class Cut {
 public:
  Cut(const World& world, ObjectIds pair) : bodies_{pair.first} {
    if (pair.second != pair.first) bodies_.push_back(pair.second);
    const std::vector<int>& object = world.contact->surface().mesh.vertex_object;
    for (int v = 0; v < static_cast<int>(object.size()); ++v) {
      const auto at = std::find(bodies_.begin(), bodies_.end(), object[v]);
      object_.push_back(at == bodies_.end() ? -1 : static_cast<int>(at - bodies_.begin()));
      number_.push_back(static_cast<int>(vertices_.size()));
      if (object_.back() >= 0) vertices_.push_back(v);
    }
  }

  int objects() const { return static_cast<int>(bodies_.size()); }
  int body(int object) const { return bodies_[object]; }
  // -1 for a vertex of another body.
  int object_of(int v) const { return object_[v]; }
  int number_of(int v) const { return number_[v]; }

  // Returns the rows of these bodies from a vector with `each` numbers per vertex.
  template <class Numbers>
  Numbers part(const Numbers& all, int each = 1) const {
    Numbers numbers(static_cast<size_t>(each) * vertices_.size());
    auto out = numbers.begin();
    for (const int v : vertices_) out = std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(each) * v, each, out);
    return numbers;
  }
  // Returns the elements of these bodies, renumbered. Calls keep(i) for each.
  template <class Element, class Keep>
  std::vector<Element> elements(const std::vector<Element>& all, const Keep& keep) const {
    std::vector<Element> own;
    for (size_t i = 0; i < all.size(); ++i) {
      if (object_of(all[i][0]) < 0) continue;
      Element& element = own.emplace_back(all[i]);
      for (int& v : element) v = number_of(v);
      keep(static_cast<int>(i));
    }
    return own;
  }
  std::vector<int> numbers(const std::vector<int>& vertices) const {
    std::vector<int> own;
    for (const int v : vertices)
      if (object_of(v) >= 0) own.push_back(number_of(v));
    return own;
  }

 private:
  std::vector<int> bodies_;
  std::vector<int> vertices_;         // of theirs, ascending
  std::vector<int> object_, number_;  // per vertex of the world
};

ContactSurface surface_of(const ContactSurface& all, const Cut& cut) {
  ContactSurface own;
  own.mesh.vertices = cut.numbers(all.mesh.vertices);
  own.mesh.codim_points = cut.numbers(all.mesh.codim_points);
  std::vector<int> edges;
  own.mesh.edges = cut.elements(all.mesh.edges, [&](int e) { edges.push_back(e); });
  for (size_t e = 0; e < edges.size(); ++e) {
    own.edge_area.push_back(all.edge_area[edges[e]]);
    if (std::binary_search(all.mesh.codim_edges.begin(), all.mesh.codim_edges.end(), edges[e]))
      own.mesh.codim_edges.push_back(static_cast<int>(e));
  }
  own.mesh.triangles = cut.elements(all.mesh.triangles, [&](int t) { own.two_sided.push_back(all.two_sided[t]); });
  for (const int object : cut.part(all.mesh.vertex_object))
    own.mesh.vertex_object.push_back(object == cut.body(0) ? 0 : 1);
  own.mesh.vertex_movable = cut.part(all.mesh.vertex_movable);
  if (!all.mesh.vertex_group.empty()) own.mesh.vertex_group = cut.part(all.mesh.vertex_group);
  for (int i = 0; i < cut.objects(); ++i) {
    own.rod_width.push_back(all.rod_width[cut.body(i)]);
    own.particle_radius.push_back(all.particle_radius[cut.body(i)]);
  }
  own.rest = cut.part(all.rest, 3);
  return own;
}

// Calls act(i, j) for the pair in both orders.
template <class Act>
void both_ways(const Cut& cut, const Act& act) {
  const int last = cut.objects() - 1;
  act(0, last);
  act(last, 0);
}

PairTable table_of(const PairTable& all, const Cut& cut) {
  std::vector<double> cells;
  for (int i = 0; i < cut.objects(); ++i) cells.push_back(all.mean_tributary_area(cut.body(i)));
  PairTable own(ObjectClasses::single(cut.objects()), std::move(cells));
  for (size_t law = 0; law < all.laws().size(); ++law)
    own.add_law(all.laws()[law], all.tangential(static_cast<int>(law)));
  both_ways(cut, [&](int i, int j) {
    own.point(i, j) = all.point(cut.body(i), cut.body(j));
    own.set_edge(i, j, all.edge(cut.body(i), cut.body(j)));
    own.set_codimensional(i, j, all.codimensional(cut.body(i), cut.body(j)));
    own.set_offset(i, j, all.offset(cut.body(i), cut.body(j)));
    if (i != j || own.region_pair_count(i, j) == 0)
      for (int part = 0; part < all.region_pair_count(cut.body(i), cut.body(j)); ++part) own.add_region_roles(i, j, all.region_roles(cut.body(i), cut.body(j), part));
  });
  if (!all.region_sets().empty()) own.set_regions(cut.part(all.region_sets()));
  return own;
}

CollidingObjects colliding_in(const Cut& cut) {
  CollidingObjects colliding(false);
  both_ways(cut, [&](int i, int j) { colliding.set(i, j, true); });
  return colliding;
}

// The shorter one of two evaluations: the first may have to fetch memory.
template <class Evaluate>
double seconds_of(const Evaluate& evaluate) {
  using Clock = std::chrono::steady_clock;
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 2; ++i) {
    const auto start = Clock::now();
    evaluate();
    least = std::min(least, std::chrono::duration<double>(Clock::now() - start).count());
  }
  return least;
}

std::array<double, evaluation_count> seconds_of_stencils(const Term& term, const VecX& x) {
  size_t vertices = 0, blocks = 0;
  for (const StencilBatch& batch : term.batches()) {
    vertices += static_cast<size_t>(batch.arity) * batch.count;
    blocks += static_cast<size_t>(hessian_blocks(batch.arity)) * batch.count;
  }
  if (vertices == 0) return {};
  std::vector<double> gradient(3 * vertices), hessian(9 * blocks);
  // At other positions each time: terms may keep the value of the last ones.
  VecX at = x;
  return {seconds_of([&] {
            at(0) = std::nextafter(at(0), std::numeric_limits<double>::infinity());
            term.value(at);
          }),
          seconds_of([&] { term.derivatives(x, Projection::none, gradient.data(), nullptr); }),
          seconds_of([&] { term.derivatives(x, Projection::clamp, gradient.data(), hessian.data()); })};
}

void bound_step(ContactSystem& contact, const VecX& x, const VecX& p, PhaseClock& clock) {
  const std::vector<Tet> no_tets;
  for (const auto& filter : attached_filters({&contact, no_tets, clock})) filter->largest_step(x, p, 1);
}

}  // namespace

double ContactSeconds::normal_stencils() const { return std::accumulate(normal.begin(), normal.end(), 0.0); }
double ContactSeconds::friction_stencils() const { return std::accumulate(friction.begin(), friction.end(), 0.0); }
double ContactSeconds::total() const {
  return broad_phase + narrow_phase + ccd + normal_stencils() + friction_stencils();
}

IsolatedPair isolate(const World& world, ObjectIds pair, const State& state) {
  const Cut cut(world, pair);
  const VecX before = cut.part(state.x_before, 3), now = cut.part(state.x, 3);
  std::vector<char> free(world.rest.size() / 3);
  for (size_t v = 0; v < free.size(); ++v) free[v] = world.dofs.moves(static_cast<int>(v));

  PhaseClock clock;
  ContactSystem contact(surface_of(world.contact->surface(), cut), table_of(world.contact->pairs(), cut),
                        colliding_in(cut), clock, world.contact->potential().isolated(cut.body(0), cut.body(cut.objects() - 1)));
  contact.set_free(cut.part(free));
  std::optional<FrictionTerm> friction;
  if (world.friction) friction.emplace(contact);

  StepParticipants participants;
  participants.add(&contact);
  for (const auto& term : contact.potential().terms()) participants.add(term.get());
  if (friction) participants.add(&*friction);
  participants.begin_step({before, state.time, state.h_before});
  bound_step(contact, before, now - before, clock);
  participants.move_to(now);

  IsolatedPair alone;
  for (const auto& [ids, count] : count_pairs(contact, friction ? &*friction : nullptr)) alone.count += count;
  ContactSeconds& seconds = alone.seconds;
  const PhaseClock::Seconds& phases = clock.seconds();
  seconds.broad_phase = phases[static_cast<int>(Phase::broad_phase)];
  seconds.narrow_phase = phases[static_cast<int>(Phase::narrow_phase)];
  seconds.ccd = phases[static_cast<int>(Phase::ccd)];
  for (const auto& term : contact.potential().terms()) {
    const auto of_term = seconds_of_stencils(*term, now);
    for (size_t i = 0; i < of_term.size(); ++i) seconds.normal[i] += of_term[i];
  }
  if (friction) seconds.friction = seconds_of_stencils(*friction, now);
  return alone;
}

}  // namespace tack
