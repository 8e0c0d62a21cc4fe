// profile.csv.
#include <fmt/format.h>

#include "framework/output/csv.hpp"
#include "framework/profile/profile.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

class Table {
 public:
  template <class Value>
  void add(std::string_view table, const std::string& row, std::string_view quantity, const Value& value) {
    text_ += fmt::format("{},{},{},{}\n", table, csv_cell(row), quantity, csv_cell(fmt::format("{}", value)));
  }
  const std::string& text() const { return text_; }

 private:
  std::string text_ = "table,row,quantity,value\n";
};

void add_seconds(Table& t, const std::string& row, const ContactSeconds& s) {
  t.add("pair", row, "seconds_broad_phase", s.broad_phase);
  t.add("pair", row, "seconds_narrow_phase", s.narrow_phase);
  t.add("pair", row, "seconds_ccd", s.ccd);
  t.add("pair", row, "seconds_stencils", s.normal_stencils());
  t.add("pair", row, "seconds_friction", s.friction_stencils());
  t.add("pair", row, "seconds", s.total());
}

void add_pairs(Table& t, const Profile& p) {
  for (const PairCost& pair : p.pairs) {
    const std::string row = pair.first + " - " + pair.second;
    t.add("pair", row, "candidates", pair.count.candidates);
    t.add("pair", row, "points", pair.count.points);
    t.add("pair", row, "samples", pair.count.interior_points);
    t.add("pair", row, "guards", pair.count.safety_barriers);
    t.add("pair", row, "edges", pair.count.edges);
    t.add("pair", row, "friction", pair.count.friction);
    t.add("pair", row, "touching_steps", pair.touching_steps);
    add_seconds(t, row, pair.seconds);
  }
  if (!p.pairs.empty()) add_seconds(t, "none", p.uncharged);
}

void add_terms(Table& t, const Profile& p) {
  static constexpr std::array<const char*, evaluation_count> kinds = {"value", "gradient", "hessian"};
  for (const TermCost& term : p.terms) {
    t.add("term", term.name, "elements", term.elements);
    for (int i = 0; i < evaluation_count; ++i) {
      t.add("term", term.name, fmt::format("evaluations_{}", kinds[i]), term.time.evaluations[i]);
      t.add("term", term.name, fmt::format("seconds_{}", kinds[i]), term.time.seconds[i]);
    }
  }
  t.add("term", "gather", "seconds", p.gather_seconds);
}

void add_scaling(Table& t, const CoreScaling& s) {
  if (s.empty()) return;
  for (size_t k = 0; k < s.cores.size(); ++k) {
    t.add("cores", std::to_string(s.cores[k]), "speed_up", s.speed_up(k));
    t.add("cores", std::to_string(s.cores[k]), "speed_up_of_loops", s.speed_up_of_loops(k));
  }
  for (int i = 0; i < phase_count; ++i) {
    const Phase phase = static_cast<Phase>(i);
    t.add("serial", std::string(phase_names[i]), "seconds", s.serial_seconds(phase));
    t.add("serial", std::string(phase_names[i]), "seconds_all", s.seconds(phase));
  }
  for (const LoopCost& cost : s.costs) {
    const std::string row = fmt::format("{}: {}", phase_names[static_cast<int>(cost.phase)], cost.name);
    const char* table = cost.serial ? "between_loops" : "loop";
    t.add(table, row, "runs", cost.runs);
    if (!cost.serial) t.add(table, row, "chunks", cost.chunks);
    t.add(table, row, "seconds", cost.seconds);
    if (cost.serial) continue;
    for (size_t k = 0; k < s.cores.size(); ++k) t.add(table, row, fmt::format("seconds_{}", s.cores[k]), cost.on_cores[k]);
  }
}

}  // namespace

void write_profile(const std::filesystem::path& path, const Profile& p) {
  Table t;
  t.add("run", "", "steps", p.steps);
  t.add("run", "", "iterations", p.iterations);
  t.add("run", "", "most_iterations", p.most_iterations);
  t.add("run", "", "steps_tried", p.cuts.tried);
  t.add("run", "", "steps_cut", p.cuts.cut);
  if (p.nearness.steps > 0) t.add("run", "", "nearness", p.nearness.mean());
  for (int i = 0; i < phase_count; ++i) t.add("phase", std::string(phase_names[i]), "seconds", p.phases[i]);
  add_pairs(t, p);
  add_terms(t, p);
  t.add("linear", "", "solver", p.linear.description);
  t.add("linear", "", "systems", p.linear.systems);
  t.add("linear", "", "iterations", p.linear.iterations);
  t.add("linear", "", "factorizations", p.linear.factorizations);
  for (const HardStep& step : p.hardest) {
    t.add("hardest", std::to_string(step.step), "iterations", step.iterations);
    t.add("hardest", std::to_string(step.step), "blocker", step.blocker);
  }
  for (const ContactRange& r : p.contact_ranges) t.add("reach", r.object, "edges", r.range / r.edge);
  add_scaling(t, p.scaling);
  const std::vector<std::string> remarks = remarks_on(p);
  for (size_t i = 0; i < remarks.size(); ++i) t.add("remark", std::to_string(i + 1), "text", remarks[i]);
  replace_file(path, t.text());
}

}  // namespace tack
