// A term is one file: the tethers of this file publish a force, an energy, flows and a field to
// probes, frames, steps.csv, summaries, the energy balance and reports. Also: records that replace
// those of a term.
#include "framework/core/records.hpp"

#include <catch2/catch.hpp>
#include <sstream>

#include "framework/body/body.hpp"
#include "framework/core/published_field.hpp"
#include "framework/core/term.hpp"
#include "framework/output/csv.hpp"
#include "framework/report/report.hpp"
#include "framework/run/recorded_run.hpp"
#include "framework/scene/energy.hpp"
#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr double fading = 0.02, winding = 0.005;  // in each step, of the stiffness

// k/2 |x_v - X_v|^2 for every vertex of an object, to where it was at rest on object 0. k fades in each accepted step, and is
// wound up by a part of that.
class TetherTerm : public Term {
 public:
  TetherTerm(const Body& body, const VecX& rest, double stiffness) : Term("tether"), rest_(rest), stiffness_(stiffness), history_name_(body.name + "/tether") {
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) vertices_.push_back(v);
  }

  void load_history(const History& history) override {
    const std::vector<double>* left = history_values(history, history_name_, 1, 1);
    left_ = left ? left->front() : 1;
  }
  void commit(const VecX&, History& history) const override { history[history_name_] = {1, {left_ * (1 - fading + winding)}, {}}; }

  double value(const VecX& x) const override {
    double sum = 0;
    for (const int v : vertices_) sum += 0.5 * k() * (vertex(x, v) - vertex(rest_, v)).squaredNorm();
    return sum;
  }
  std::vector<StencilBatch> batches() const override { return {{1, static_cast<int>(vertices_.size()), vertices_.data()}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    for (size_t i = 0; i < vertices_.size(); ++i) {
      Eigen::Map<Vec3>(gradient + 3 * i) = k() * (vertex(x, vertices_[i]) - vertex(rest_, vertices_[i]));
      if (hessian) Eigen::Map<Mat3>(hessian + 9 * i) = k() * Mat3::Identity();
    }
  }

  void publish(Records& records) const override {
    Term::publish(records);
    ForceRecord force{"tether", ForceDirection::normal, {"adhesion"}};
    force.between = [this](const VecX& x, std::string_view, ObjectPair pair) {
      Vec3 sum = Vec3::Zero();
      for (const int v : vertices_) sum -= k() * (vertex(x, v) - vertex(rest_, v));
      return pair.a == 0 ? Vec3(-sum) : sum;
    };
    records.add(std::move(force));
    records.add(FlowRecord{"tether", {{"dissipated_tethers"}, {"work_winding", FlowKind::fed}}, [this](const VecX& x, double* amounts) {
      amounts[0] = fading * value(x);
      amounts[1] = winding * value(x);
    }});
    records.add(FieldRecord{"tether_length", [this](const VecX& x) {
      VecX lengths = VecX::Constant(x.size() / 3, std::numeric_limits<double>::quiet_NaN());
      for (const int v : vertices_) lengths(v) = (vertex(x, v) - vertex(rest_, v)).norm();
      return lengths;
    }});
  }

 private:
  double k() const { return left_ * stiffness_; }

  VecX rest_;
  double stiffness_, left_ = 1;
  std::string history_name_;
  std::vector<int> vertices_;
};

class Tether : public Energy {
 public:
  void fields(Fields& f) override { f.number("stiffness", stiffness_, units::stiffness, "of each vertex").positive(); }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override { return std::make_unique<TetherTerm>(body, rest, stiffness_); }

 private:
  double stiffness_ = 1;  // N/m
};

class TetherLength : public PublishedField {
  const char* unit() const override { return "m"; }
};

TACK_REGISTER(Energy, Tether, "tether", "Holds every vertex to where it was.", "tests");
TACK_REGISTER(PublishedField, TetherLength, "tether_length", "Of the tethers that hold a vertex.", "");

const std::string tethered = R"(
time: {step: 20 ms, duration: 0.4 s, integrator: quasi_static}
objects:
  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.2, 0]}, motion: [fixed]}
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}
    place: {translate: [0, 0.2, 0]}
    energies: [{type: neo_hookean, young: 10 kPa, poisson: 0.3, density: 1000}, {type: tether, stiffness: 2}]
    motion: [{type: translate, velocity: [0, 0.1, 0], select: {type: face, direction: [0, 1, 0]}}]
contact: {distance: 1 mm}
solver: {type: projected_newton, stopping: force, force_tolerance: 1e-9}
probes:
  - {name: all, type: contact_force, on: block, direction: [0, 1, 0]}
  - {name: adhesion, type: contact_force, on: block, from: floor, part: adhesion, direction: [0, 1, 0]}
  - {name: barrier, type: contact_force, on: block, part: barrier, direction: [0, 1, 0]}
  - {name: tether, type: force, of: tether, on: block, direction: [0, 1, 0]}
  - {name: on_floor, type: force, of: tether, part: adhesion, on: floor, from: block, direction: [0, 1, 0]}
  - {name: held, type: reaction, object: block, select: {type: face, direction: [0, 1, 0]}, direction: [0, 1, 0]}
  - {name: stored, type: energy, term: tether}
  - {name: total, type: energy}
  - {name: faded, type: energy, term: dissipated_tethers}
  - {name: lost, type: energy, term: dissipated}
output: {fields: [tether_length, contact_force, adhesion_force, plastic_strain], checkpoint_interval: 0.1 s}
)";

std::vector<double> column(const CsvTable& table, const std::string& name) {
  const auto at = std::find(table.columns.begin(), table.columns.end(), name) - table.columns.begin();
  INFO(name);
  REQUIRE(at < static_cast<std::ptrdiff_t>(table.columns.size()));
  std::vector<double> numbers;
  for (const auto& row : table.rows) numbers.push_back(row[at]);
  return numbers;
}

}  // namespace

TEST_CASE("force, energy, flows and field of a term are in all records", "[records]") {
  const TemporaryFolder folder;
  const auto recorded = [&](const std::string& name, int steps, bool resume) {
    RunSettings settings;
    settings.output = (folder.path() / name).string();
    settings.steps = steps;
    settings.resume = resume;
    std::ostringstream told;
    RecordedRun run(parse_experiment("name: tethered\n" + tethered, "tethered.yaml"), settings, {}, told, {});
    return run.execute();
  };
  const RunSummary summary = recorded("whole", 0, false);
  REQUIRE(summary.status == RunStatus::done);
  const auto root = folder.path() / "whole";

  const CsvTable probes = read_csv(root / "probes.csv"), steps = read_csv(root / "steps.csv");
  const auto all = column(probes, "all"), tether = column(probes, "tether"), held = column(probes, "held"), stored = column(probes, "stored");
  CHECK(tether.back() < -0.1);
  for (size_t i = 0; i < all.size(); ++i) {
    CHECK(all[i] == tether[i]);
    CHECK(column(probes, "adhesion")[i] == Approx(tether[i]).margin(1e-15));
    CHECK(column(probes, "on_floor")[i] == Approx(-tether[i]).margin(1e-15));
    CHECK(column(probes, "barrier")[i] == 0);
    CHECK(held[i] == Approx(-tether[i]).epsilon(fading).margin(1e-9));  // the block was in balance before they faded
  }

  // The part of the stored energy that did not fade remains after a step.
  const auto energy = column(steps, "energy_tether"), faded = column(steps, "dissipated_tethers"), wound = column(steps, "work_winding");
  double lost = 0, made = 0, fed = 0;
  double before = column(probes, "total")[0];
  for (size_t i = 0; i < energy.size(); ++i) {
    CHECK(energy[i] == stored[i + 1]);
    CHECK(faded[i] == Approx(fading / (1 - fading + winding) * energy[i]));
    CHECK(wound[i] == Approx(winding / (1 - fading + winding) * energy[i]));
    lost += faded[i];
    fed += wound[i];
    made += column(steps, "dissipated_numerics")[i];
    const double after = column(probes, "total")[i + 1];
    CHECK(after - before == Approx(column(steps, "work_script")[i] + wound[i] - faded[i] - column(steps, "dissipated_numerics")[i]).margin(1e-12));
    before = after;
  }
  CHECK(std::abs(made) < 0.1 * lost);
  CHECK(column(probes, "faded").back() == Approx(lost));
  CHECK(column(probes, "lost").back() == Approx(lost));

  const auto json = read_json(root / "summary.json");
  CHECK(json["energy"]["dissipated_tethers"].get<double>() == Approx(lost));
  CHECK(json["energy"]["work_winding"].get<double>() == Approx(fed));

  // Frames, which the report reads.
  write_file(folder.path() / "page.html", "<html><!--data of the report--></html>");
  ReportSettings settings;
  settings.folders = {root};
  settings.output = folder.path() / "out.html";
  settings.page = folder.path() / "page.html";
  CHECK(write_report(settings).notes.empty());
  const std::string html = file_text(folder.path() / "out.html");
  for (const char* name : {"tether_length", "energy_tether", "dissipated_tethers", "work_winding"}) CHECK(contains(html, name));

  // An interrupted and resumed run has equal records.
  recorded("parts", 7, false);
  recorded("parts", 0, true);
  CHECK(read_json(folder.path() / "parts/summary.json")["energy"] == json["energy"]);
  CHECK(read_csv(folder.path() / "parts/probes.csv").rows == probes.rows);
}

TEST_CASE("forces by name are refused with what there is", "[records]") {
  const auto probe = [&](const std::string& text) {
    std::string scene = tethered;
    scene.replace(scene.find("probes:\n"), 8, "probes:\n  - {name: asked, type: force, on: block, " + text + "}\n");
    try {
      TestRun run(scene);
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  CHECK(contains(probe("of: tethr"), "no force is named 'tethr' in this scene; did you mean 'tether'?"));
  CHECK(contains(probe("of: tether, part: adhesin"), "the force 'tether' has no part 'adhesin'; did you mean 'adhesion'?"));
  CHECK(probe("of: contact, part: barrier, from: floor").empty());
}

TEST_CASE("replaced forces of a term appear in probes, reactions and the balance", "[records]") {
  TestRun run(
      "time: {step: 0.01, duration: 1}\ngravity: [0, -10, 0]\n"
      "objects:\n"
      "  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.1, 0]}, motion: [{type: translate, velocity: [0, 0.1, 0]}]}\n"
      "  - {name: block, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, place: {translate: [0.03, 0.1004, 0.02]},\n"
      "     energies: [{type: neo_hookean, young: 1e5, density: 1000}]}\n"
      "contact: {distance: 1 mm, friction: {mu: 0.3}}\n"
      "probes:\n"
      "  - {name: contact, type: contact_force, on: block, direction: [0, 1, 0]}\n"
      "  - {name: pair, type: contact_force, on: floor, from: block, direction: [0, 1, 0]}\n"
      "  - {name: rubbing, type: friction_force, on: block}\n"
      "  - {name: held, type: reaction, object: floor, direction: [0, 1, 0]}\n"
      "  - {name: barrier, type: energy, term: barrier}\n");
  run.step();
  const double pressed = run.sample(0)[0], held = run.sample(3)[0];
  CHECK(pressed > 1);
  CHECK(run.sample(1)[0] == Approx(-pressed));
  CHECK(held == Approx(pressed));  // the floor has no mass

  // Impulses that a stepper might have found, of another size than the barrier's.
  Records& records = run.world->records;
  const int first = run.world->bodies[1].first_vertex;
  ForceRecord impulses{"contact", ForceDirection::normal, {"barrier", "adhesion"}};
  impulses.add = [first](const VecX&, std::string_view part, VecX& forces) {
    if (part == "adhesion") return;
    forces(3 * first + 1) += 7;
    forces(1) -= 7;
  };
  impulses.between = [](const VecX&, std::string_view, ObjectPair pair) { return Vec3(0, pair.a == 1 ? 7 : -7, 0); };
  records.replace(impulses);
  records.replace(EnergyRecord{"barrier", EnergyKind::contact, [](const VecX&) { return 0.25; }});
  records.remove_forces("friction");
  CHECK(records.replaced(contact_term(*run.world)));
  CHECK(run.sample(0)[0] == 7);
  CHECK(run.sample(1)[0] == -7);
  CHECK(run.sample(2) == std::vector<double>{0, 0, 0});
  CHECK(run.sample(3)[0] == Approx(7));
  CHECK(run.sample(4)[0] == 0.25);

  // The prescribed motion works against the published forces, not those of the potential: 7 N over
  // 1 mm, of which the first half belongs to the end of the step before.
  run.step();
  const StepReport report = run.step();
  CHECK(report.flows.prescribed_motion == Approx(7 * 0.1 * 0.01));
  for (const NamedEnergy& energy : report.energies)
    if (energy.name == "barrier") CHECK(energy.value == 0.25);

  CHECK_THROWS_WITH(records.replace(ForceRecord{"glue"}), Catch::Contains("no term publishes a force named 'glue'"));
  CHECK_THROWS_WITH(records.add(FlowRecord{"glue", {{"lost"}}}), Catch::Contains("does not begin with 'dissipated_'"));
  CHECK_THROWS_WITH(records.add(FieldRecord{"glue"}), Catch::Contains("not registered"));
}
