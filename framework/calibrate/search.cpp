#include "framework/calibrate/search.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "framework/batch/sobol.hpp"
#include "framework/calibrate/bobyqa.hpp"
#include "framework/calibrate/differences.hpp"
#include "framework/calibrate/polish.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int design_of_each = 32, chain_of_each = 20, final_chain_of_each = 30;  // points for each number
constexpr int polish_steps = 5;
constexpr double early = 10;      // tolerances, at which all chains end but the final one
constexpr double final_step = 3;  // of those ends

class Search {
 public:
  Search(const std::vector<FittedNumber>& numbers, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell)
      : numbers_(numbers), config_(config), evaluator_(evaluator), tell_(tell) {
    for (const FittedNumber& n : numbers) {
      low_.push_back(n.low());
      high_.push_back(n.high());
    }
  }

  SearchResult run() {
    design();
    chains();
    if (config_.polish) polish();
    begin("derivatives", 2 * count());
    result_.derivatives = differences(numbers_, u_of(result_.best.values), config_.difference, result_.best,
                                      [&](const std::vector<Point>& points) { return keep("derivatives", evaluator_.at(points)); });
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
      if (e.misfit < result_.best.misfit) result_.best = e;
      if (known_.insert(e.values).second) result_.rows.push_back({phase, e});
    }
    return found;
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

  // The best points, each once.
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

  // How many more points chains may ask for.
  int left() const { return config_.evaluations > 0 ? std::max(0, config_.evaluations - static_cast<int>(result_.rows.size())) : 1 << 20; }

  void chains() {
    const std::vector<Point> starts = best_points(config_.chains);
    if (starts.empty()) return;
    const int each = std::min(chain_of_each * count(), left() / static_cast<int>(starts.size()));
    if (each > 0) {
      begin("chains", 0);
      std::vector<Chain> all;
      for (size_t i = 0; i < starts.size(); ++i)
        all.push_back({fmt::format("chain {}", i + 1), starts[i], config_.step, std::min(early * config_.tolerance, 0.5 * config_.step), each});
      run_chains(all);
    }
    const int most = std::min(final_chain_of_each * count(), left());
    if (most <= 0) return;
    begin("final chain", 0);
    run_chains({{"final chain", result_.best.values, std::min(final_step * early * config_.tolerance, config_.step), config_.tolerance, most}});
  }

  void polish() {
    begin("polish", 0);
    const auto evaluate = [&](const std::vector<Point>& points) { return keep("polish", evaluator_.at(points)); };
    PolishProblem problem{low_, high_, config_.tolerance, polish_steps, {}, {}};
    problem.residuals = [&](const std::vector<double>& u, std::vector<double>& residuals) {
      PointEvaluation e = evaluate({point_of(u)}).front();
      residuals = std::move(e.residuals);
      return e.good;
    };
    problem.jacobian = [&](const std::vector<double>& u, Eigen::MatrixXd& jacobian) {
      const PointEvaluation middle = evaluate({point_of(u)}).front();
      Derivatives d = differences(numbers_, u, config_.difference, middle, evaluate);
      jacobian = std::move(d.of_residuals);
      return d.problem.empty();
    };
    tack::polish(problem, u_of(result_.best.values), static_cast<int>(result_.best.residuals.size()));
  }

  const std::vector<FittedNumber>& numbers_;
  const SearchConfig& config_;
  Evaluator& evaluator_;
  const SearchProgress& tell_;
  std::vector<double> low_, high_;
  std::set<Point> known_;
  double worst_ = 0;  // misfit of the design
  SearchResult result_;
};

}  // namespace

SearchResult search_for(const std::vector<FittedNumber>& numbers, const SearchConfig& config, Evaluator& evaluator, const SearchProgress& tell) {
  return Search(numbers, config, evaluator, tell).run();
}

}  // namespace tack
