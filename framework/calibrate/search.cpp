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

// Points per parameter.
constexpr int design_per_parameter = 32, chain_per_parameter = 20, final_chain_per_parameter = 30;
constexpr int polish_iterations = 5;
// Tolerance of all chains but the final one, as a multiple of the search's.
constexpr double chain_tolerance = 10, chain_tolerance_with_sensitivities = 30;
constexpr double final_chain_step = 3;  // initial step of the final chain, in units of those tolerances
// Radius within which points are compared with the sensitivities, in units of `difference`.
constexpr double comparison_radius = 3;
constexpr double missed_max = 0.5;  // largest accepted `missed` (derivatives.hpp)
// Largest standard deviation for which sensitivities at the best point suffice, in units of
// `difference`.
constexpr double local_sigma_max = 2;

class Search {
 public:
  Search(const std::vector<FittedParameter>& parameters, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& progress, bool noise_known)
      : parameters_(parameters), config_(config), evaluator_(evaluator), progress_(progress), noise_known_(noise_known) {
    for (const FittedParameter& n : parameters) {
      low_.push_back(n.low());
      high_.push_back(n.high());
    }
  }

  SearchResult run() {
    design();
    find_sensitivities();
    chains();
    if (!polish_with_run_sensitivities()) {
      final_chain();
      if (config_.polish) begin("polish", 0), polish();
    }
    derivatives();
    return std::move(result_);
  }

 private:
  int count() const { return static_cast<int>(parameters_.size()); }

  std::vector<double> u_of(const DesignPoint& values) const {
    std::vector<double> u;
    for (size_t i = 0; i < parameters_.size(); ++i) u.push_back(parameters_[i].u(values[i]));
    return u;
  }

  DesignPoint point_of(const std::vector<double>& u) const {
    DesignPoint values;
    for (size_t i = 0; i < parameters_.size(); ++i) values.push_back(parameters_[i].value(u[i]));
    return values;
  }

  void begin(const std::string& phase, int points) { progress_(phase, points, result_.best.good ? &result_.best : nullptr); }

  std::vector<PointEvaluation> record(const std::string& phase, std::vector<PointEvaluation> found) {
    for (const PointEvaluation& e : found) {
      const bool more = e.values == result_.best.values && e.good && !e.derivatives.empty() && result_.best.derivatives.empty();
      if (e.misfit < result_.best.misfit || more) result_.best = e;
      if (evaluated_.emplace(e.values, e.asked_derivatives).second) result_.rows.push_back({phase, e});
    }
    return found;
  }

  // Evaluates points; with `derivatives`, also requests sensitivities as long as runs give them.
  std::vector<PointEvaluation> evaluate(const std::string& phase, const std::vector<DesignPoint>& points, bool derivatives) {
    return record(phase, evaluator_.at(points, derivatives && run_sensitivities_));
  }

  void design() {
    int size = config_.design > 0 ? config_.design : design_per_parameter * count();
    if (config_.evaluations > 0) size = std::min(size, config_.evaluations);
    DesignPoint start;
    for (const FittedParameter& n : parameters_) start.push_back(six_digits(n.start));
    std::vector<DesignPoint> points{start};
    const std::vector<double> unit = sobol_points(size, count());
    for (int k = 0; k < size && static_cast<int>(points.size()) < size; ++k) {
      std::vector<double> u;
      for (int i = 0; i < count(); ++i) u.push_back(low_[i] + unit[static_cast<size_t>(k * count() + i)] * (high_[i] - low_[i]));
      if (const DesignPoint p = point_of(u); p != start) points.push_back(p);
    }
    begin("design", static_cast<int>(points.size()));
    const std::vector<PointEvaluation> found = record("design", evaluator_.at(points));
    for (const PointEvaluation& e : found)
      if (e.good) worst_misfit_ = std::max(worst_misfit_, e.misfit);
    if (!result_.best.good)
      throw SimulationError(fmt::format("all {} evaluations of the initial design failed; the first one: {}{}", found.size(), found.front().status,
                                   found.front().error.empty() ? "" : ": " + found.front().error));
  }

  // Returns the best points without duplicates.
  std::vector<DesignPoint> best_points(int most) const {
    std::vector<const PointEvaluation*> sorted;
    for (const SearchRow& row : result_.rows)
      if (row.evaluation.good) sorted.push_back(&row.evaluation);
    std::stable_sort(sorted.begin(), sorted.end(), [](const PointEvaluation* a, const PointEvaluation* b) { return a->misfit < b->misfit; });
    std::vector<DesignPoint> points;
    for (size_t i = 0; i < sorted.size() && static_cast<int>(i) < most; ++i) points.push_back(sorted[i]->values);
    return points;
  }

  struct Chain {
    std::string phase;
    DesignPoint start;
    double step, tolerance;
    int most;
  };

  void run_chains(const std::vector<Chain>& chains) {
    std::vector<std::vector<PointEvaluation>> found(chains.size());
    std::vector<std::function<void(const Evaluator::Ask&)>> searches;
    for (size_t i = 0; i < chains.size(); ++i)
      searches.emplace_back([&, i](const Evaluator::Ask& ask) {
        double worst = worst_misfit_;
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
    for (size_t i = 0; i < chains.size(); ++i) record(chains[i].phase, std::move(found[i]));
  }

  // Returns the remaining number of evaluations of the chains.
  int remaining_evaluations() const { return config_.evaluations > 0 ? std::max(0, config_.evaluations - static_cast<int>(result_.rows.size())) : 1 << 20; }

  void chains() {
    const std::vector<DesignPoint> starts = best_points(config_.chains);
    if (starts.empty()) return;
    const int each = std::min(chain_per_parameter * count(), remaining_evaluations() / static_cast<int>(starts.size()));
    if (each > 0) {
      begin("chains", 0);
      std::vector<Chain> all;
      for (size_t i = 0; i < starts.size(); ++i)
        all.push_back({fmt::format("chain {}", i + 1), starts[i], config_.step, std::min(tolerance_factor() * config_.tolerance, 0.5 * config_.step), each});
      run_chains(all);
    }
  }

  // Returns the tolerance of the chains over that of the search.
  double tolerance_factor() const { return from_runs_ ? chain_tolerance_with_sensitivities : chain_tolerance; }

  void final_chain() {
    const int most = std::min(final_chain_per_parameter * count(), remaining_evaluations());
    if (config_.chains == 0 || most <= 0) return;
    begin("final chain", 0);
    run_chains({{"final chain", result_.best.values, std::min(final_chain_step * tolerance_factor() * config_.tolerance, config_.step), config_.tolerance, most}});
  }

  void polish() {
    const auto at = [&](const std::vector<double>& u) { return evaluate("polish", {point_of(u)}, true).front(); };
    PolishProblem problem{low_, high_, config_.tolerance, polish_iterations, {}, {}};
    problem.residuals = [&](const std::vector<double>& u, std::vector<double>& residuals) {
      PointEvaluation e = at(u);
      residuals = std::move(e.residuals);
      return e.good;
    };
    problem.jacobian = [&](const std::vector<double>& u, Eigen::MatrixXd& jacobian) {
      Derivatives d = derivatives_of("polish", at(u));
      jacobian = std::move(d.jacobian);
      return d.problem.empty();
    };
    tack::polish(problem, u_of(result_.best.values), static_cast<int>(result_.best.residuals.size()));
  }

  void find_sensitivities() {
    if (config_.gradients) reasons_ = evaluator_.without_derivatives();
    run_sensitivities_ = std::any_of(reasons_.begin(), reasons_.end(), [](const std::string& why) { return why.empty(); });
    from_runs_ = run_sensitivities_ && config_.polish;
  }

  Derivatives derivatives_of(const std::string& phase, const PointEvaluation& e) {
    return derivatives_at(parameters_, u_of(e.values), config_.difference, e, [&](const std::vector<DesignPoint>& points) { return evaluate(phase, points, false); });
  }

  // Takes the sensitivities of the run at the best point. Returns false, and disables sensitivities,
  // if the run gives none or they do not predict the residuals of nearby points.
  bool use_run_sensitivities(const std::string& phase) {
    if (!run_sensitivities_) return false;
    PointEvaluation e = result_.best;
    if (e.derivatives.empty()) e = evaluate(phase, {e.values}, true).front();
    std::string why;
    if (!e.good || std::all_of(e.derivatives.begin(), e.derivatives.end(), [](const auto& one) { return one.empty(); })) {
      why = fmt::format("the run with sensitivities failed ({}{})", e.good ? "it has none" : e.status, e.error.empty() ? "" : ": " + e.error);
    } else {
      result_.derivatives = derivatives_of(phase, e);
      std::vector<const PointEvaluation*> others;
      for (const SearchRow& row : result_.rows) others.push_back(&row.evaluation);
      measure_accuracy(others, parameters_, e, comparison_radius * config_.difference, result_.derivatives);
      if (result_.derivatives.missed > missed_max)
        why = fmt::format("the curves have steps there: the sensitivities leave {:.0f}% of the differences to {} nearby evaluations unexplained",
                          100 * result_.derivatives.missed, result_.derivatives.compared);
    }
    for (std::string& one : reasons_)
      if (one.empty()) one = why;
    run_sensitivities_ = why.empty();
    return run_sensitivities_;
  }

  bool polish_with_run_sensitivities() {
    if (!run_sensitivities_ || !config_.polish) return false;
    begin("polish", 0);
    if (!use_run_sensitivities("polish")) return false;
    polish();
    return use_run_sensitivities("polish");
  }

  // Replaces sensitivities of loosely determined parameters by finite differences. A sensitivity at
  // one point does not represent a wide interval, and on a curve with ripples it overestimates how
  // well the parameter is determined.
  void difference_loose_parameters() {
    const Derivatives& own = result_.derivatives;
    const Confidence c = find_confidence(parameters_, result_.best.values, own.jacobian, result_.best.residuals, noise_known_);
    PointEvaluation best = result_.best;
    bool any = false;
    for (size_t i = 0; i < parameters_.size(); ++i) {
      const bool wide = !(c.sigma[i] <= local_sigma_max * config_.difference), rippled = i < own.missed_of.size() && own.missed_of[i] > missed_max;
      if (!own.from_runs[i] || (!wide && !rippled)) continue;
      best.derivatives[i].clear();
      reasons_[i] = wide ? "its interval is wide, and sensitivities are local to the best point" : "slopes between nearby evaluations differ from the sensitivities, as for curves with ripples";
      any = true;
    }
    if (!any) return;
    replace_derivatives(derivatives_of("derivatives", best));
  }

  // Replaces the derivatives, but keeps the measured accuracy of the sensitivities.
  void replace_derivatives(Derivatives d) {
    d.missed = result_.derivatives.missed;
    d.compared = result_.derivatives.compared;
    result_.derivatives = std::move(d);
  }

  void derivatives() {
    begin("derivatives", 0);
    if (use_run_sensitivities("derivatives")) {
      difference_loose_parameters();
    } else {
      PointEvaluation best = result_.best;
      best.derivatives.clear();
      replace_derivatives(derivatives_of("derivatives", best));
    }
    for (size_t i = 0; i < reasons_.size(); ++i) result_.derivatives.why[i] = reasons_[i];
  }

  const std::vector<FittedParameter>& parameters_;
  const SearchConfig& config_;
  Evaluator& evaluator_;
  const SearchProgress& progress_;
  bool noise_known_;
  std::vector<double> low_, high_;
  std::set<std::pair<DesignPoint, bool>> evaluated_;
  bool run_sensitivities_ = false;    // runs give derivatives by some of the parameters
  bool from_runs_ = false;            // the search ends with sensitivities
  std::vector<std::string> reasons_;  // reason per number without derivatives of the runs
  double worst_misfit_ = 0;           // largest misfit of the design
  SearchResult result_;
};

}  // namespace

SearchResult search_for(const std::vector<FittedParameter>& parameters, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& progress, bool noise_known) {
  return Search(parameters, config, evaluator, progress, noise_known).run();
}

}  // namespace tack
