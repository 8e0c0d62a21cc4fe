// The tables of profile.hpp as text.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "framework/profile/profile.hpp"

namespace tack {
namespace {

constexpr size_t rows_max = 12;

class Text {
 public:
  explicit Text(const Profile& profile)
      : p_(profile), all_(std::max(profile.seconds(), 1e-300)), steps_(std::max(profile.steps, 1)),
        iterations_(std::max(profile.iterations, 1L)) {}

  std::string take() {
    phases();
    pairs();
    terms();
    linear();
    iterations();
    text_ += scaling_tables(p_.scaling);
    remarks();
    return std::move(text_);
  }

 private:
  template <class... Values>
  void line(fmt::format_string<Values...> text, Values&&... values) {
    std::string row = fmt::format(text, std::forward<Values>(values)...);
    row.erase(row.find_last_not_of(' ') + 1);
    text_ += row + "\n";
  }
  // Returns the column width for names that may be long.
  template <class Rows, class Name>
  static size_t width_of(const Rows& rows, size_t least, const Name& name) {
    for (size_t i = 0; i < std::min(rows.size(), rows_max); ++i) least = std::max(least, name(rows[i]).size());
    return least + 1;
  }
  static std::string name_of(const PairCost& pair) {
    return pair.is_self() ? pair.first + " with itself" : pair.first + " - " + pair.second;
  }
  void more(size_t rows, double seconds) {
    if (rows > rows_max) line("{} more, {:.3f} s", rows - rows_max, seconds);
  }

  void phases() {
    std::array<int, phase_count> order;
    std::iota(order.begin(), order.end(), 0);
    std::stable_sort(order.begin(), order.end(), [&](int a, int b) { return p_.phases[a] > p_.phases[b]; });
    line("{:<14}{:>10}{:>7}{:>10}", "phase", "seconds", "%", "ms/it");
    for (const int i : order)
      if (p_.phases[i] > 0)
        line("{:<14}{:>10.3f}{:>7.1f}{:>10.3f}", phase_names[i], p_.phases[i], 100 * p_.phases[i] / all_,
             1e3 * p_.phases[i] / double(iterations_));
    line("{:<14}{:>10.3f}{:>7}{:>10.3f}", "total", p_.seconds(), "", 1e3 * p_.seconds() / double(iterations_));
  }

  void pairs() {
    if (p_.pairs.empty()) return;
    const size_t width = width_of(p_.pairs, 16, name_of);
    line("\n{}", contact_heading);
    line("{:<{}}{:>11}{:>9}{:>9}{:>9}{:>9}{:>10}{:>9}{:>9}{:>9}{:>10}{:>10}{:>9}{:>7}", "pair", width, "candidates", "points",
         "samples", "guards", "edges", "friction", "broad s", "narrow s", "ccd s", "stencil s", "frict. s", "total s", "%");
    ContactSeconds sum = p_.uncharged;
    PairCount counts;
    double rest = 0;
    for (size_t i = 0; i < p_.pairs.size(); ++i) {
      const PairCost& pair = p_.pairs[i];
      if (i < rows_max) pair_line(name_of(pair), width, pair.count, pair.seconds);
      else rest += pair.seconds.total();
      ContactSeconds::for_each(sum, pair.seconds, [](double& all, double part) { all += part; });
      counts += pair.count;
    }
    more(p_.pairs.size(), rest);
    pair_line(fmt::format("all {}", p_.pairs.size()), width, counts, sum);
  }
  void pair_line(const std::string& name, size_t width, const PairCount& c, const ContactSeconds& s) {
    const auto mean = [&](long sum) { return double(sum) / steps_; };
    line("{:<{}}{:>11.0f}{:>9.0f}{:>9.0f}{:>9.0f}{:>9.0f}{:>10.0f}{:>9.3f}{:>9.3f}{:>9.3f}{:>10.3f}{:>10.3f}{:>9.3f}{:>7.1f}", name,
         width, mean(c.candidates), mean(c.points), mean(c.interior_points), mean(c.safety_barriers), mean(c.edges), mean(c.friction),
         s.broad_phase, s.narrow_phase, s.ccd, s.normal_stencils(), s.friction_stencils(), s.total(),
         100 * s.total() / std::max(p_.contact_seconds(), 1e-300));
  }

  void terms() {
    const size_t width = width_of(p_.terms, 16, [](const TermCost& term) { return term.name; });
    line("\nenergies: evaluations and seconds");
    line("{:<{}}{:>10}{:>9}{:>9}{:>10}{:>9}{:>9}{:>9}{:>9}{:>7}", "term", width, "elements", "values", "s", "gradients", "s",
         "Hessians", "s", "total s", "%");
    double rest = 0;
    for (size_t i = 0; i < p_.terms.size(); ++i) {
      const TermCost& term = p_.terms[i];
      if (i >= rows_max) {
        rest += term.seconds();
        continue;
      }
      const TermTime& t = term.time;
      line("{:<{}}{:>10.0f}{:>9}{:>9.3f}{:>10}{:>9.3f}{:>9}{:>9.3f}{:>9.3f}{:>7.1f}", term.name, width, term.elements,
           t.evaluations[0], t.seconds[0], t.evaluations[1], t.seconds[1], t.evaluations[2], t.seconds[2], term.seconds(),
           100 * term.seconds() / all_);
    }
    more(p_.terms.size(), rest);
    line("{:<{}}{:>81.3f}{:>7.1f}", "gather and matrix", width, p_.gather_seconds, 100 * p_.gather_seconds / all_);
  }

  void linear() {
    const LinearCost& l = p_.linear;
    if (l.systems == 0) return;
    const double seconds = p_.phase(Phase::factorize) + p_.phase(Phase::solve);
    line("\nlinear solver: {}", l.description.empty() ? "none of its own" : l.description);
    line("{} systems, {} iterations of conjugate gradients ({:.1f} each), {} factorisations; {:.3f} s, {:.1f}%", l.systems,
         l.iterations, double(l.iterations) / double(l.systems), l.factorizations, seconds,
         100 * seconds / all_);
  }

  void iterations() {
    line("\niterations: {} in {} steps, {:.2f} on average, {} at most; {} of {} steps tried were cut", p_.iterations, p_.steps,
         double(p_.iterations) / steps_, p_.most_iterations, p_.cuts.cut, p_.cuts.tried);
    if (p_.nearness.steps > 0) line("{} steps ended in contact, with a smallest distance of {:.2g} of contact's on average", p_.nearness.steps, p_.nearness.mean());
    for (const HardStep& step : p_.hardest)
      line("step {:<6} t {:<10.6g} {:>4} iterations  {}", step.step, step.time, step.iterations, step.blocker);
  }

  void remarks() {
    const std::vector<std::string> all = remarks_on(p_);
    line("\nremarks{}", all.empty() ? ": nothing passes a threshold" : "");
    for (const std::string& remark : all) line("- {}", remark);
  }

  const Profile& p_;
  double all_;  // s
  int steps_;
  long iterations_;
  std::string text_;
};

}  // namespace

std::string profile_tables(const Profile& profile) { return Text(profile).take(); }

}  // namespace tack
