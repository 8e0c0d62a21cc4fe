#include "framework/calibrate/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/batch/sobol.hpp"
#include "framework/calibrate/bobyqa.hpp"
#include "framework/calibrate/confidence.hpp"
#include "framework/calibrate/polish.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int design_of_each = 32, chain_of_each = 20, final_chain_of_each = 30;  // points for each number
constexpr int polish_steps = 5;
// Tolerance of all chains but the final one, as a multiple of the search's; early_by_runs if runs
// give derivatives.
constexpr double early = 10, early_by_runs = 30;
constexpr double final_step = 3;  // initial step of the final chain, in units of those tolerances
// In differences: radius within which points are compared with the derivatives.
constexpr double reach = 3;
constexpr double most_missed = 0.5;
// In differences: largest standard deviation that derivatives at the best point alone may give.
constexpr double widest = 2;

class Search {
 public:
  Search(const std::vector<FittedNumber>& numbers, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell, bool noise_known)
      : numbers_(numbers), config_(config), evaluator_(evaluator), tell_(tell), noise_known_(noise_known) {
    for (const FittedNumber& n : numbers) {
      low_.push_back(n.low());
      high_.push_back(n.high());
    }
  }

  SearchResult run() {
    design();
    look_for_gradients();
    chains();
    if (!polished_by_runs()) {
      final_chain();
      if (config_.polish) begin("polish", 0), polish();
    }
    derivatives();
    return std::move(result_);
  }

 private:
  int count() const { return static_cast<int>(numbers_.size()); }

  std::vector<double> u_of(const Point& values) const {
    std::vector<double> u;
    for (size_t i = 0; i < numbers_.size(); ++i) u.push_back(numbers_[i].u(values[i]));
    return u;
  }

  Point point_of(const std::vector<double>& u) const {
    Point values;
    for (size_t i = 0; i < numbers_.size(); ++i) values.push_back(numbers_[i].value(u[i]));
    return values;
  }

  void begin(const std::string& phase, int points) { tell_(phase, points, result_.best.good ? &result_.best : nullptr); }

  std::vector<PointEvaluation> keep(const std::string& phase, std::vector<PointEvaluation> found) {
    for (const PointEvaluation& e : found) {
      const bool more = e.values == result_.best.values && e.good && !e.derivatives.empty() && result_.best.derivatives.empty();
      if (e.misfit < result_.best.misfit || more) result_.best = e;
      if (known_.emplace(e.values, e.asked_derivatives).second) result_.rows.push_back({phase, e});
    }
    return found;
  }

  // Requests derivatives too, as long as runs give them.
  std::vector<PointEvaluation> evaluate(const std::string& phase, const std::vector<Point>& points, bool derivatives) {
    return keep(phase, evaluator_.at(points, derivatives && gradients_));
  }

  void design() {
    int size = config_.design > 0 ? config_.design : design_of_each * count();
    if (config_.evaluations > 0) size = std::min(size, config_.evaluations);
    Point start;
    for (const FittedNumber& n : numbers_) start.push_back(six_digits(n.start));
    std::vector<Point> points{start};
    const std::vector<double> unit = sobol_points(size, count());
    for (int k = 0; k < size && static_cast<int>(points.size()) < size; ++k) {
      std::vector<double> u;
      for (int i = 0; i < count(); ++i) u.push_back(low_[i] + unit[static_cast<size_t>(k * count() + i)] * (high_[i] - low_[i]));
      if (const Point p = point_of(u); p != start) points.push_back(p);
    }
    begin("design", static_cast<int>(points.size()));
    const std::vector<PointEvaluation> found = keep("design", evaluator_.at(points));
    for (const PointEvaluation& e : found)
      if (e.good) worst_ = std::max(worst_, e.misfit);
    if (!result_.best.good)
      throw SimulationError(fmt::format("all {} points of the design failed; the first one: {}{}", found.size(), found.front().status,
                                   found.front().error.empty() ? "" : ": " + found.front().error));
  }

  // Returns the best points without duplicates.
  std::vector<Point> best_points(int most) const {
    std::vector<const PointEvaluation*> sorted;
    for (const SearchRow& row : result_.rows)
      if (row.evaluation.good) sorted.push_back(&row.evaluation);
    std::stable_sort(sorted.begin(), sorted.end(), [](const PointEvaluation* a, const PointEvaluation* b) { return a->misfit < b->misfit; });
    std::vector<Point> points;
    for (size_t i = 0; i < sorted.size() && static_cast<int>(i) < most; ++i) points.push_back(sorted[i]->values);
    return points;
  }

  struct Chain {
    std::string phase;
    Point start;
    double step, tolerance;
    int most;
  };

  void run_chains(const std::vector<Chain>& chains) {
    std::vector<std::vector<PointEvaluation>> found(chains.size());
    std::vector<std::function<void(const Evaluator::Ask&)>> searches;
    for (size_t i = 0; i < chains.size(); ++i)
      searches.emplace_back([&, i](const Evaluator::Ask& ask) {
        double worst = worst_;
        bobyqa({low_, high_, chains[i].step, chains[i].tolerance, chains[i].most}, u_of(chains[i].start), [&](const std::vector<double>& u) -> std::optional<double> {
          std::optional<PointEvaluation> e = ask(point_of(u));
          if (!e) return std::nullopt;
          if (e->good) worst = std::max(worst, e->misfit);
          const double value = e->good ? e->misfit : worst;
          found[i].push_back(std::move(*e));
          return value;
        });
      });
    evaluator_.search(searches);
    for (size_t i = 0; i < chains.size(); ++i) keep(chains[i].phase, std::move(found[i]));
  }

  // Returns the remaining number of evaluations of the chains.
  int left() const { return config_.evaluations > 0 ? std::max(0, config_.evaluations - static_cast<int>(result_.rows.size())) : 1 << 20; }

  void chains() {
    const std::vector<Point> starts = best_points(config_.chains);
    if (starts.empty()) return;
    const int each = std::min(chain_of_each * count(), left() / static_cast<int>(starts.size()));
    if (each > 0) {
      begin("chains", 0);
      std::vector<Chain> all;
      for (size_t i = 0; i < starts.size(); ++i)
        all.push_back({fmt::format("chain {}", i + 1), starts[i], config_.step, std::min(ends() * config_.tolerance, 0.5 * config_.step), each});
      run_chains(all);
    }
  }

  double ends() const { return by_runs_ ? early_by_runs : early; }

  void final_chain() {
    const int most = std::min(final_chain_of_each * count(), left());
    if (config_.chains == 0 || most <= 0) return;
    begin("final chain", 0);
    run_chains({{"final chain", result_.best.values, std::min(final_step * ends() * config_.tolerance, config_.step), config_.tolerance, most}});
  }

  void polish() {
    const auto at = [&](const std::vector<double>& u) { return evaluate("polish", {point_of(u)}, true).front(); };
    PolishProblem problem{low_, high_, config_.tolerance, polish_steps, {}, {}};
    problem.residuals = [&](const std::vector<double>& u, std::vector<double>& residuals) {
      PointEvaluation e = at(u);
      residuals = std::move(e.residuals);
      return e.good;
    };
    problem.jacobian = [&](const std::vector<double>& u, Eigen::MatrixXd& jacobian) {
      Derivatives d = derivatives_of("polish", at(u));
      jacobian = std::move(d.of_residuals);
      return d.problem.empty();
    };
    tack::polish(problem, u_of(result_.best.values), static_cast<int>(result_.best.residuals.size()));
  }

  void look_for_gradients() {
    if (config_.gradients) why_ = evaluator_.without_derivatives();
    gradients_ = std::any_of(why_.begin(), why_.end(), [](const std::string& why) { return why.empty(); });
    by_runs_ = gradients_ && config_.polish;
  }

  Derivatives derivatives_of(const std::string& phase, const PointEvaluation& e) {
    return derivatives_at(numbers_, u_of(e.values), config_.difference, e, [&](const std::vector<Point>& points) { return evaluate(phase, points, false); });
  }

  // Takes derivatives at the best point from its run. Returns false, and disables them, if the run
  // gives none or they do not predict the residuals of nearby points.
  bool take_from_runs(const std::string& phase) {
    if (!gradients_) return false;
    PointEvaluation e = result_.best;
    if (e.derivatives.empty()) e = evaluate(phase, {e.values}, true).front();
    std::string why;
    if (!e.good || std::all_of(e.derivatives.begin(), e.derivatives.end(), [](const auto& one) { return one.empty(); })) {
      why = fmt::format("the run with derivatives failed ({}{})", e.good ? "it has none" : e.status, e.error.empty() ? "" : ": " + e.error);
    } else {
      result_.derivatives = derivatives_of(phase, e);
      std::vector<const PointEvaluation*> others;
      for (const SearchRow& row : result_.rows) others.push_back(&row.evaluation);
      compare_with(others, numbers_, e, reach * config_.difference, result_.derivatives);
      if (result_.derivatives.missed > most_missed)
        why = fmt::format("the curves have steps there: the runs' own derivatives miss {:.0f}% of what {} points nearby differ by", 100 * result_.derivatives.missed,
                          result_.derivatives.compared);
    }
    for (std::string& one : why_)
      if (one.empty()) one = why;
    gradients_ = why.empty();
    return gradients_;
  }

  bool polished_by_runs() {
    if (!gradients_ || !config_.polish) return false;
    begin("polish", 0);
    if (!take_from_runs("polish")) return false;
    polish();
    return take_from_runs("polish");
  }

  // Replaces derivatives of loosely determined numbers by differences: a derivative at a point says
  // nothing about a wide interval, and with ripples in a curve it overestimates how well a number
  // is determined.
  void difference_what_is_loose() {
    const Derivatives& own = result_.derivatives;
    const Confidence c = confidence_of(numbers_, result_.best.values, own.of_residuals, result_.best.residuals, noise_known_);
    PointEvaluation best = result_.best;
    bool any = false;
    for (size_t i = 0; i < numbers_.size(); ++i) {
      const bool wide = !(c.sigma[i] <= widest * config_.difference), rippled = i < own.missed_of.size() && own.missed_of[i] > most_missed;
      if (!own.by_runs[i] || (!wide && !rippled)) continue;
      best.derivatives[i].clear();
      why_[i] = wide ? "its interval is wide, and the run's own hold near the best point" : "points nearby have other slopes than the run's own, as where curves have ripples";
      any = true;
    }
    if (!any) return;
    take(derivatives_of("derivatives", best));
  }

  // Replaces the derivatives of the runs, but keeps the record of their accuracy.
  void take(Derivatives d) {
    d.missed = result_.derivatives.missed;
    d.compared = result_.derivatives.compared;
    result_.derivatives = std::move(d);
  }

  void derivatives() {
    begin("derivatives", 0);
    if (take_from_runs("derivatives")) {
      difference_what_is_loose();
    } else {
      PointEvaluation best = result_.best;
      best.derivatives.clear();
      take(derivatives_of("derivatives", best));
    }
    for (size_t i = 0; i < why_.size(); ++i) result_.derivatives.why[i] = why_[i];
  }

  const std::vector<FittedNumber>& numbers_;
  const SearchConfig& config_;
  Evaluator& evaluator_;
  const SearchProgress& tell_;
  bool noise_known_;
  std::vector<double> low_, high_;
  std::set<std::pair<Point, bool>> known_;
  bool gradients_ = false;        // runs give derivatives by some of the numbers
  bool by_runs_ = false;          // the search ends with them
  std::vector<std::string> why_;  // reason per number without derivatives of the runs
  double worst_ = 0;  // largest misfit of the design
  SearchResult result_;
};

}  // namespace

SearchResult search_for(const std::vector<FittedNumber>& numbers, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell, bool noise_known) {
  return Search(numbers, config, evaluator, tell, noise_known).run();
}

}  // namespace tack
