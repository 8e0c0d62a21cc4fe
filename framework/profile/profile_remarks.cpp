// The remarks of profile.hpp. Each follows from measured numbers that pass a threshold; docs/profiling.md lists them.
#include <fmt/format.h>

#include <algorithm>

#include "framework/profile/profile.hpp"

namespace tack {
namespace {

constexpr size_t most = 5;

constexpr double contact_matters = 0.2;   // of the run's time
constexpr double pair_dominates = 0.4;    // of contact's time
constexpr double idle_matters = 0.1;      // of the run's time, by pairs that never touch
constexpr double long_range = 1;          // edges
constexpr double search_matters = 0.15;   // of the run's time
constexpr double often_searched = 0.5;    // of the iterations
constexpr double often_cut = 0.2;         // of the steps that are tried
constexpr double pressed_flat = 0.02;     // of the contact distance
constexpr double kept_apart = 0.2;        // of the contact distance
constexpr double crawling = 30;           // iterations of a step
constexpr double often_failed = 0.01;     // of the steps
constexpr double linear_matters = 0.5;    // of the run's time
constexpr double many_iterations = 30;    // of conjugate gradients for a system
constexpr double many_evaluations = 1.5;  // of the line search for an iteration
constexpr double many_lags = 2;           // solves of a step
constexpr double io_matters = 0.15;       // of the run's time
constexpr double idle_cores = 0.5;        // of the cores asked for

struct Remark {
  double weight;  // part of the run that it is about
  std::string text;
};

class Remarks {
 public:
  explicit Remarks(const Profile& profile) : p_(profile), all_(std::max(profile.seconds(), 1e-300)) {}

  std::vector<std::string> take() {
    if (p_.contact_seconds() >= contact_matters * all_) {
      dominating_pair();
      long_reach();
    }
    idle_pairs();
    searches();
    cut_steps();
    failed_solves();
    linear_solver();
    line_search();
    lagging();
    output();
    cores();
    std::stable_sort(remarks_.begin(), remarks_.end(), [](const Remark& a, const Remark& b) { return a.weight > b.weight; });
    std::vector<std::string> lines;
    for (size_t i = 0; i < std::min(most, remarks_.size()); ++i) lines.push_back(std::move(remarks_[i].text));
    return lines;
  }

 private:
  template <class... Values>
  void add(double seconds, fmt::format_string<Values...> text, Values&&... values) {
    remarks_.push_back({seconds / all_, fmt::format(text, std::forward<Values>(values)...)});
  }
  static double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }
  bool dominates(const PairCost& pair) const { return pair.seconds.total() >= pair_dominates * p_.contact_seconds(); }
  static bool idle(const PairCost& pair) { return pair.touching_steps == 0; }

  void dominating_pair() {
    if (p_.pairs.empty() || !dominates(p_.pairs[0]) || !idle(p_.pairs[0])) return;
    const PairCost& pair = p_.pairs[0];
    const std::string who = pair.is_self() ? fmt::format("'{}' with itself", pair.first)
                                           : fmt::format("'{}' and '{}'", pair.first, pair.second);
    add(pair.seconds.total(), "{:.0f}% of contact's time is {}, which did not touch in {} steps: `contact.pairs: "
        "[{{between: [{}, {}], contact: false}}]` if they cannot", percent(pair.seconds.total(), p_.contact_seconds()), who,
        p_.steps, pair.first, pair.second);
  }

  void idle_pairs() {
    double seconds = 0;
    int count = 0, selves = 0;
    std::string example;
    for (const PairCost& pair : p_.pairs) {
      if (!idle(pair) || (&pair == &p_.pairs[0] && dominates(pair))) continue;
      seconds += pair.seconds.total();
      selves += pair.is_self() ? 1 : 0;
      if (count++ == 0) example = fmt::format("[{}, {}]", pair.first, pair.second);
    }
    if (seconds >= idle_matters * all_)
      add(seconds, "pairs of objects that did not touch ({}, {} of them objects with themselves) take {:.0f}% of the run, {} the "
          "most: `contact: false` in `contact.pairs` for those that cannot", count, selves, percent(seconds, all_), example);
  }

  void long_reach() {
    if (p_.contact_ranges.empty() || p_.contact_ranges[0].range < long_range * p_.contact_ranges[0].edge) return;
    const ContactRange& r = p_.contact_ranges[0];
    add(p_.contact_seconds(), "contact reaches over {:.2g} edges of '{}' ({:.3g} m, edges of {:.3g} m), and takes {:.0f}% of "
        "the run: lower `contact.distance` (or the range of its adhesion), or coarsen that mesh",
        r.range / r.edge, r.object, r.range, r.edge, percent(p_.contact_seconds(), all_));
  }

  void searches() {
    const double seconds = p_.phase(Phase::broad_phase);
    if (seconds < search_matters * all_ || double(p_.searches) < often_searched * double(p_.iterations)) return;
    add(seconds, "candidates were searched {} times in {} iterations, {:.0f}% of the run, because vertices leave the boxes "
        "that they were searched in: a smaller `time.step`", p_.searches, p_.iterations, percent(seconds, all_));
  }

  void cut_steps() {
    const TruncatedSteps& c = p_.cuts;
    if (double(c.cut) < often_cut * double(c.tried) || c.cut == 0) return;
    add(all_ * double(c.cut) / double(c.tried), "contact or inversion cut {:.0f}% of {} Newton steps, to {:.2g} of their length on average: {}",
        percent(double(c.cut), double(c.tried)), c.tried, c.left / double(c.cut), remedy_of_cuts());
  }

  // A barrier that is too soft lets surfaces meet before it pushes; one that is too stiff acts like
  // a wall within its distance.
  std::string remedy_of_cuts() const {
    const double near = p_.nearness.mean(), its = double(p_.iterations) / std::max(p_.steps, 1);
    const std::string measured = fmt::format("surfaces end their steps {:.2g} of `contact.distance` apart", near);
    if (p_.nearness.steps > 0 && near < pressed_flat)
      return fmt::format("{}, so the barrier is soft for what it stops: ten times the `contact.barrier.stiffness`", measured);
    if (near > kept_apart && its >= crawling)
      return fmt::format("{} in {:.2g} iterations each, so the barrier may be stiffer than it need be: a tenth of the `contact.barrier.stiffness`", measured, its);
    return "a smaller `time.step`, or a larger `contact.distance`, so that surfaces push before they meet";
  }

  void failed_solves() {
    if (p_.failed_solves == 0 || p_.failed_solves < often_failed * p_.steps) return;
    add(all_ * p_.failed_solves / (p_.failed_solves + p_.steps), "{} solves failed and were repeated in halves, in {} steps: a smaller `time.step`, or more "
        "`solver.max_iterations`", p_.failed_solves, p_.steps);
  }

  void linear_solver() {
    const double seconds = p_.phase(Phase::factorize) + p_.phase(Phase::solve);
    const LinearCost& l = p_.linear;
    if (seconds < linear_matters * all_ || l.systems == 0) return;
    const double iterations = double(l.iterations) / double(l.systems);
    const std::string measured = fmt::format("linear systems take {:.0f}% of the run, with {:.2g} iterations and {:.2g} "
                                             "factorisations each", percent(seconds, all_), iterations,
                                             double(l.factorizations) / double(l.systems));
    if (!l.automatic)
      add(seconds, "{}: `solver.linear: auto` chooses between a factor and iterations", measured);
    else if (iterations >= many_iterations)
      add(seconds, "{}: `solver.type: newton_pcg` solves early systems loosely", measured);
    else
      add(seconds, "{}; that grows with the mesh: fewer `shape.cells`", measured);
  }

  void line_search() {
    const double evaluations = double(p_.line_search_evaluations) / double(std::max(p_.iterations, 1L));
    if (evaluations < many_evaluations) return;
    add(p_.phase(Phase::line_search), "the line search took {:.2g} evaluations an iteration: where surfaces slide, a larger "
        "`eps_v` of `contact.friction`; else another `solver.line_search`", evaluations);
  }

  void lagging() {
    const double lags = double(p_.lag_iterations) / std::max(p_.steps, 1);
    if (lags < many_lags) return;
    add(all_ * (1 - 1 / lags), "each step was solved {:.2g} times for friction: a larger `contact.lagging.until`", lags);
  }

  void output() {
    const double seconds = p_.phase(Phase::io);
    if (seconds < io_matters * all_) return;
    add(seconds, "writing and probes take {:.0f}% of the run: a longer `output.frame_interval`, or fewer probes",
        percent(seconds, all_));
  }

  void cores() {
    const CoreScaling& s = p_.scaling;
    if (s.empty()) return;
    const size_t k = s.index_of_asked();
    const double speed_up = s.speed_up(k);
    if (speed_up >= idle_cores * s.asked) return;
    add(all_ * (1 - speed_up / s.asked), "{} cores would run the steps at most {:.2g} times as fast as one, because {:.0f}% of their time is serial and loops have few chunks: "
        "run several scenes at once (`tack batch`), or refine the mesh; {}",
        s.asked, speed_up, percent(s.serial_seconds(), s.seconds()), s.costs.empty() ? "" : largest_loss(s));
  }
  static std::string largest_loss(const CoreScaling& s) {
    return fmt::format("{:.0f}% of the loss is {}{}", 100 * s.share_lost(s.costs[0]), s.costs[0].serial ? "serial code from " : "", s.costs[0].name);
  }

  const Profile& p_;
  double all_;  // s
  std::vector<Remark> remarks_;
};

}  // namespace

std::vector<std::string> remarks_on(const Profile& profile) { return Remarks(profile).take(); }

}  // namespace tack
