#include "framework/profile/profiler.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "framework/config/bind.hpp"
#include "framework/config/describe.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/stepping/obstacle.hpp"

namespace tack {
namespace {

constexpr int interval = 10;       // iterations between two measurements of the pairs
constexpr size_t stored_steps = 5;   // those with most iterations
constexpr double hardly_cut = 0.9;  // of a step

double seconds_in(const PhaseClock::Seconds& phases, Phase phase) { return phases[static_cast<int>(phase)]; }

std::string label(const World& world, const Term& term) {
  for (const StencilBatch& batch : term.batches())
    if (batch.count > 0 && !term.dynamic())
      if (const int body = world.body_of(batch.vertices[0]); body >= 0) return fmt::format("{} of '{}'", term.name(), world.bodies[body].name);
  return term.name();
}

}  // namespace

Profiler::Profiler(const World& world, const Minimizer& solver, PhaseClock& clock, double contact_distance, const std::vector<int>& cores)
    : world_(world), solver_(solver), clock_(clock), contact_distance_(contact_distance) {
  clock_.time_terms(&times_);
  if (!cores.empty()) loops_.emplace(clock, cores);
}

void Profiler::tried(const VecX& x, const VecX& p, double feasible) {
  const Pause pause(*this);
  ++cuts_.tried;
  if (feasible >= hardly_cut) return;
  ++cuts_.cut;
  cuts_.left += feasible;
  if (feasible < cut_.feasible) cut_ = {x, p, feasible};
}

void Profiler::step(const State& state, const StepReport& report) {
  const Pause pause(*this);
  totals_.most_iterations = std::max(totals_.most_iterations, report.solve.iterations);
  totals_.lag_iterations += report.lag_iterations;
  if (report.contacts > 0 && report.min_distance < contact_distance_) {
    ++totals_.nearness.steps;
    totals_.nearness.sum += report.min_distance / contact_distance_;
  }
  store_if_hard(report);
  cut_ = {};
  if (!world_.contact) return;
  for (const auto& [ids, count] : count_pairs(*world_.contact, world_.friction.get())) {
    Pair& pair = pairs_[ids];
    pair.count += count;
    pair.touching_steps += count.stencils() > 0 ? 1 : 0;
  }
  uncharged_iterations_ += report.solve.iterations;
  if (uncharged_iterations_ >= interval) charge_pairs(state);
}

void Profiler::store_if_hard(const StepReport& report) {
  Hard hard{{report.step, report.time, report.solve.iterations, ""}, std::move(cut_)};
  const auto easier = [](const Hard& a, const Hard& b) { return a.step.iterations > b.step.iterations; };
  hardest_.insert(std::upper_bound(hardest_.begin(), hardest_.end(), hard, easier), std::move(hard));
  if (hardest_.size() > stored_steps) hardest_.pop_back();
}

// Returns the times of contact in the run so far.
ContactSeconds Profiler::contact_seconds() const {
  ContactSeconds sum;
  const PhaseClock::Seconds& phases = clock_.seconds();
  sum.broad_phase = seconds_in(phases, Phase::broad_phase);
  sum.narrow_phase = seconds_in(phases, Phase::narrow_phase);
  sum.ccd = seconds_in(phases, Phase::ccd);
  sum.normal = {};
  if (world_.contact)
    for (const auto& term : world_.contact->potential().terms()) {
      const auto& seconds = times_.of(term.get()).seconds;
      for (size_t i = 0; i < seconds.size(); ++i) sum.normal[i] += seconds[i];
    }
  sum.friction = times_.of(world_.friction.get()).seconds;
  return sum;
}

// Charges the pairs with the time of contact since the last call.
void Profiler::charge_pairs(const State& state) {
  uncharged_iterations_ = 0;
  ContactSeconds taken = contact_seconds(), alone;
  ContactSeconds::for_each(taken, charged_, [](double& part, double& before) {
    const double now = part;
    part -= std::exchange(before, now);
  });
  std::map<ObjectIds, ContactSeconds> each;
  for (const auto& [ids, count] : count_pairs(*world_.contact, world_.friction.get())) {
    ContactSeconds& seconds = each[ids] = isolate(world_, ids, state).seconds;
    ContactSeconds::for_each(alone, seconds, [](double& sum, double part) { sum += part; });
  }
  ContactSeconds ratio = taken;
  ContactSeconds::for_each(ratio, alone, [](double& part, double all) { part = all > 0 ? part / all : 0; });
  for (auto& [ids, seconds] : each) {
    ContactSeconds::for_each(seconds, ratio, [](double& part, double by) { part *= by; });
    ContactSeconds::for_each(pairs_[ids].seconds, seconds, [](double& sum, double part) { sum += part; });
    ContactSeconds::for_each(taken, seconds, [](double& left, double part) { left -= part; });
  }
  ContactSeconds::for_each(uncharged_, taken, [](double& sum, double left) { sum += std::max(left, 0.0); });
}

std::vector<PairCost> Profiler::pairs() const {
  std::vector<PairCost> all;
  for (const auto& [ids, pair] : pairs_)
    all.push_back({world_.bodies[ids.first].name, world_.bodies[ids.second].name, pair.count, pair.touching_steps,
                   pair.seconds});
  std::stable_sort(all.begin(), all.end(), [](const PairCost& a, const PairCost& b) {
    return a.seconds.total() > b.seconds.total();
  });
  return all;
}

std::vector<TermCost> Profiler::terms() const {
  PairCount sum;
  for (const auto& [ids, pair] : pairs_) sum += pair.count;
  std::vector<TermCost> all;
  for (const Term* term : world_.terms) {
    TermCost& cost = all.emplace_back();
    cost.name = label(world_, *term);
    cost.time = times_.of(term);
    for (const StencilBatch& batch : term->batches())
      if (!term->dynamic()) cost.elements += batch.count;
    if (term->dynamic())
      cost.elements = double(term == world_.friction.get() ? sum.friction : sum.stencils()) / std::max(totals_.steps, 1);
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const TermCost& a, const TermCost& b) { return a.seconds() > b.seconds(); });
  return all;
}

std::vector<ContactRange> Profiler::contact_ranges() const {
  if (!world_.contact) return {};
  const ContactSurface& surface = world_.contact->surface();
  const PairTable& pairs = world_.contact->pairs();
  std::vector<double> length(world_.bodies.size()), edges(world_.bodies.size());
  for (const auto& [a, b] : surface.mesh.edges) {
    const int object = surface.mesh.vertex_object[a];
    length[object] += (vertex(surface.rest, a) - vertex(surface.rest, b)).norm();
    ++edges[object];
  }
  const auto examples = pairs.classes().examples();
  const auto kind = [&](int object) { return pairs.classes().of(object); };
  std::vector<ContactRange> all;
  for (size_t i = 0; i < world_.bodies.size(); ++i) {
    if (!world_.bodies[i].movable || edges[i] == 0) continue;
    ContactRange one{world_.bodies[i].name, length[i] / edges[i]};
    for (const auto& [a, b] : examples)
      if (kind(a) == kind(static_cast<int>(i)) || kind(b) == kind(static_cast<int>(i)))
        one.range = std::max({one.range, pairs.point(a, b).range_max(), pairs.point(b, a).range_max()});
    all.push_back(std::move(one));
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const ContactRange& a, const ContactRange& b) { return a.range / a.edge > b.range / b.edge; });
  return all;
}

// Returns the hardest steps with their blockers. Makes its own filters on the contact system.
std::vector<HardStep> Profiler::hardest() {
  const auto filters = attached_filters({world_.contact.get(), world_.tets, clock_}, solver_.step_filters());
  std::vector<HardStep> all;
  for (Hard& hard : hardest_) {
    if (hard.cut.feasible < 1) hard.step.blocker = describe_blocker(world_, filters, hard.cut.x, hard.cut.p);
    all.push_back(std::move(hard.step));
  }
  return all;
}

LinearCost Profiler::linear(const RunSummary& summary) const {
  LinearCost cost{summary.linear_solver, summary.linear_solves, summary.linear_iterations, clock_.factorizations()};
  const Value solver = to_value(&solver_);
  const Value* linear = solver.find("linear");
  const Value* type = linear && linear->is_map() ? linear->find("type") : linear;
  cost.automatic = type && type->text == "auto";
  return cost;
}

Profile Profiler::finish(const State& state, const RunSummary& summary) {
  if (loops_) totals_.scaling = loops_->finish();
  loops_.reset();
  totals_.steps = summary.steps;
  totals_.iterations = summary.newton_iterations;
  totals_.line_search_evaluations = summary.line_search_evaluations;
  totals_.searches = summary.broad_phase_builds;
  totals_.failed_solves = summary.failed_solves;
  totals_.phases = summary.phases;
  if (world_.contact && state.h_before > 0) {
    const Pause pause(*this);
    charge_pairs(state);
  }
  Profile profile = totals_;
  profile.pairs = pairs();
  profile.uncharged = uncharged_;
  profile.terms = terms();
  profile.gather_seconds = profile.phase(Phase::assembly);
  for (const TermCost& term : profile.terms)
    profile.gather_seconds -= term.time.seconds[static_cast<int>(Evaluation::gradient)] +
                              term.time.seconds[static_cast<int>(Evaluation::hessian)];
  profile.linear = linear(summary);
  profile.hardest = hardest();
  profile.cuts = cuts_;
  profile.contact_ranges = contact_ranges();
  return profile;
}

double Profile::seconds() const { return std::accumulate(phases.begin(), phases.end(), 0.0); }

double Profile::contact_seconds() const {
  double sum = uncharged.total();
  for (const PairCost& pair : pairs) sum += pair.seconds.total();
  return sum;
}

}  // namespace tack
