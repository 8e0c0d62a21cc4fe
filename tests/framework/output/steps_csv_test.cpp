#include "framework/output/steps_csv.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

StepReport report(int step, double time) {
  StepReport r;
  r.step = step;
  r.time = time;
  r.step_size = 0.01;
  r.rejections[Rejection::solve] = 1;
  r.solve = {MinimizerStatus::converged, 4, 5, 11, 6, 0.25};
  r.converged = true;
  r.unbalanced_force = 0.5;
  r.tolerated_force = 2;
  r.contacts = 7;
  r.candidates = 80;
  r.min_distance = 1e-4;
  r.min_gap = 2e-4;
  r.energies = {{"kinetic", 0.5}, {"barrier", 1e-3}};
  const double flows[] = {1, 2, 9, 10, 3, 4, 5, 6, 7, 8};
  const double* next = flows;
  EnergyFlows::for_each(r.flows, [&](const std::string&, double& amount) { amount = *next++; });
  r.lag_iterations = 3;
  r.friction_residual = 0.0625;
  r.wall_seconds = 0.125;
  for (int i = 0; i < phase_count; ++i) r.phases[i] = i;
  return r;
}

const std::string header =
    "step,time,step_size,halvings,newton_iterations,linear_solves,linear_iterations,line_search_evaluations,contacts,"
    "candidates,min_distance,min_gap,energy_kinetic,energy_barrier,work_loads,work_script,work_rim,work_healing,dissipated_friction,"
    "dissipated_adhesion,dissipated_plastic,dissipated_damping,dissipated_areas,dissipated_numerics,residual,unbalanced_force,tolerated_force,converged,"
    "lag_iterations,friction_residual,wall_seconds,"
    "seconds_other,seconds_assembly,seconds_projection,seconds_factorize,seconds_solve,"
    "seconds_broad_phase,seconds_narrow_phase,seconds_ccd,seconds_line_search,seconds_check,"
    "seconds_io,"
    "rejected_solve,rejected_inversion,rejected_intersection,rejected_tunnelling,rejected_debonding,rejected_error,rejected_energy_contact,rejected_energy_free\n";
const std::string first =
    "1,0.01,0.01,1,4,5,11,6,7,80,0.0001,0.0002,0.5,0.001,1,2,9,10,3,4,5,6,7,8,0.25,0.5,2,1,3,0.0625,0.125,"
    "0,1,2,3,4,5,6,7,8,9,10,1,0,0,0,0,0,0,0\n";
const std::string second =
    "2,0.02,0.01,1,4,5,11,6,7,80,0.0001,0.0002,0.5,0.001,1,2,9,10,3,4,5,6,7,8,0.25,0.5,2,0,3,0.0625,0.125,"
    "0,1,2,3,4,5,6,7,8,9,10,1,0,0,0,0,0,0,0\n";

}  // namespace

TEST_CASE("steps.csv has the documented columns") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "steps.csv";
  StepsCsv steps(path);
  steps.add(report(1, 0.01));
  CHECK(text_of(path) == header + first);
  StepReport failed = report(2, 0.02);
  failed.converged = false;
  steps.add(failed);
  CHECK(text_of(path) == header + first + second);
}

TEST_CASE("the energies of the first step fix the columns of steps.csv") {
  const TemporaryFolder folder;
  StepsCsv steps(folder.path() / "steps.csv");
  steps.add(report(1, 0.01));
  StepReport other = report(2, 0.02);
  std::swap(other.energies[0], other.energies[1]);
  CHECK_THROWS_AS(steps.add(other), std::logic_error);
}

TEST_CASE("steps.csv is continued from a given time") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "steps.csv";
  std::ofstream(path) << header << first << second << "3,0.0";
  StepsCsv steps = StepsCsv::continued(path, 0.01);
  CHECK(text_of(path) == header + first + second + "3,0.0");
  StepReport again = report(2, 0.02);
  again.converged = false;
  steps.add(again);
  CHECK(text_of(path) == header + first + second);

  StepReport other = report(2, 0.02);
  other.energies.pop_back();
  StepsCsv mismatched = StepsCsv::continued(path, 0.01);
  CHECK_THROWS_AS(mismatched.add(other), InputError);
  StepsCsv fresh = StepsCsv::continued(folder.path() / "none.csv", 1);
  fresh.add(report(1, 0.01));
  CHECK(text_of(folder.path() / "none.csv") == header + first);
}
