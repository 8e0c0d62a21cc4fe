#include "python/bindings/running.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>

#include "framework/config/describe.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/experiment/retired_key_warnings.hpp"
#include "framework/output/element_fields.hpp"
#include "framework/output/frame_fields.hpp"
#include "framework/output/frame_geometry.hpp"
#include "framework/run/changed_scene.hpp"
#include "framework/setup/remesh_checks.hpp"
#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"
#include "geometry/plain_numbers.hpp"
#include "python/bindings/force_points.hpp"
#include "python/bindings/interrupts.hpp"

namespace tack::python {
namespace {

py::dict dict_of(const StepReport& report) {
  py::dict d;
  d["step"] = report.step;
  d["time"] = report.time;
  d["step_size"] = report.step_size;
  d["iterations"] = report.solve.iterations;
  d["status"] = std::string(to_string(report.solve.status));
  d["converged"] = report.converged;
  d["residual"] = report.solve.residual;
  d["halvings"] = report.rejections.cutbacks();
  d["contacts"] = report.contacts;
  d["min_distance"] = report.min_distance;
  d["min_gap"] = report.min_gap;
  d["unbalanced_force"] = report.unbalanced_force;
  d["wall_seconds"] = report.wall_seconds;
  for (const StepMetric& metric : report.metrics) d[py::str(metric.name)] = metric.value;
  return d;
}

}  // namespace

Running::Claim::Claim(std::atomic<bool>& busy) : busy_(busy) {
  if (busy_.exchange(true))
    throw std::runtime_error("a step of this simulation is under way: a minimiser may use the problem that it is called with and nothing else of the simulation, and another "
                             "thread has to wait, or needs a simulation of its own");
}

// Moves contact back to the state, after a problem has moved it.
void Running::return_to_state() {
  if (!problem_) return;
  problem_->leave();
  settle();
}

Running::Running(Load load, std::vector<std::string> overrides, int threads)
    : load_(std::move(load)), overrides_(std::move(overrides)), arena_(threads > 0 ? threads : tbb::task_arena::automatic) {
  arena_.execute([&] {
    LoadedExperiment loaded = load_(overrides_);
    if (any_remeshed(loaded.experiment))
      throw InputError("objects that are meshed anew as they flow (remesh) have vertices that come and go, and arrays in Python are of lasting ones; take `remesh` away "
                       "(set={\"objects.NAME.remesh\": None}), or use `tack run`");
    simulation_ = std::make_unique<Simulation>(std::move(loaded), collect());
    warnings_ = retired_key_warnings(simulation_->built().root(), simulation_->experiment());
    probes_.emplace(probes_of(simulation_->built()));
    simulation_->start();
    settle();
  });
  show();
}

Running::~Running() { end_problem(); }

// Moves contact to the state.
void Running::settle() {
  simulation_->world().participants.move_to(simulation_->state().x);
}

void Running::show() {
  const State& state = simulation_->state();
  const auto keep = [](std::shared_ptr<VecX>& shown, const VecX& values, Eigen::Index size) {
    // Callers keep the former array.
    if (shown->size() != size) shown = std::make_shared<VecX>(size);
    *shown = values.head(size);
  };
  const Eigen::Index size = 3 * world().mesh_vertex_count();
  keep(x_, state.x, size);
  keep(v_, state.v, size);
  shown_ = {state.time, simulation_->stepper().next_step_size(), state.step, simulation_->finished()};
}

void Running::end_problem() {
  if (problem_) problem_->end();
  problem_.reset();
}

py::dict Running::step() {
  const Claim claim(busy_);
  end_problem();
  std::optional<StepReport> report;
  try {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    report = arena_.execute([this]() -> std::optional<StepReport> {
      const int before = simulation_->state().step;
      StepReport r = simulation_->step();
      if (simulation_->state().step == before) return std::nullopt;
      settle();
      simulation_->check_stages();
      return r;
    });
  } catch (const SimulationError& error) {
    rethrow_python(error);
    throw;
  }
  show();
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  if (!report) {
    PyErr_SetNone(PyExc_KeyboardInterrupt);
    throw py::error_already_set();
  }
  return dict_of(*report);
}

void Running::minimize_by(const py::object& function) {
  if (!function.is_none() && !py::isinstance<py::function>(function) && !PyCallable_Check(function.ptr()))
    throw py::type_error("a minimiser is called with a problem, and returns the unknowns where it ended");
  const Claim claim(busy_);
  if (function.is_none()) minimizer_ = {};
  else minimizer_ = [function = py::reinterpret_borrow<py::function>(function), this] { return minimizer_of(function, *simulation_->experiment().solver, world()); };
  simulation_->solve_with(minimizer_);
  restart();
}

// The world is another one afterwards: what points into it has to be asked for again.
void Running::change(const std::vector<std::string>& overrides) {
  const Claim claim(busy_);
  end_problem();
  std::vector<std::string> all = overrides_;
  all.insert(all.end(), overrides.begin(), overrides.end());
  std::unique_ptr<Simulation> before;
  try {
    arena_.execute([&] {
      auto after = std::make_unique<Simulation>(load_(all), collect());
      State state = changed_state(*simulation_, *after);
      ProbeSet probes = probes_of(after->built());
      before = std::exchange(simulation_, std::move(after));
      simulation_->solve_with(minimizer_);
      simulation_->start_from(std::move(state));
      probes_.emplace(std::move(probes));
      settle();
    });
  } catch (...) {
    if (before) simulation_ = std::move(before);
    settle();
    throw;
  }
  overrides_ = std::move(all);
  show();
}

py::list Running::stages() {
  const Claim claim(busy_);
  py::list all;
  if (const ProtocolRun* protocols = simulation_->protocols())
    for (const StageVisit& v : protocols->visits(shown_.time)) {
      py::dict row;
      row["protocol"] = v.protocol;
      row["stage"] = v.stage;
      row["number"] = v.number;
      row["begin"] = v.begin;
      row["end"] = v.end;
      row["ended_by"] = v.ended_by;
      row["value"] = v.value;
      all.append(row);
    }
  return all;
}

// Replaces the stepper and the solver.
void Running::restart() {
  end_problem();
  const State state = simulation_->state();
  simulation_->start_from(state);
  settle();
  show();
}

void Running::move(const std::optional<Numbers>& x, const std::optional<Numbers>& v) {
  const Claim claim(busy_);
  end_problem();
  const Eigen::Index size = 3 * world().mesh_vertex_count();
  const State& state = simulation_->state();
  const VecX places = x ? VecX(vector_of(*x, size, "positions")) : VecX(state.x.head(size));
  const VecX velocities = v ? VecX(vector_of(*v, size, "velocities")) : VecX(state.v.head(size));
  try {
    simulation_->move(places, velocities);
  } catch (...) {
    settle();
    throw;
  }
  settle();
  show();
}

py::dict Running::energies() {
  const Claim claim(busy_);
  return_to_state();
  py::dict d;
  for (const NamedEnergy& energy : energies_by_term(world(), simulation_->state())) d[py::str(energy.name)] = energy.value;
  return d;
}

py::dict Running::forces() {
  const Claim claim(busy_);
  return_to_state();
  const VecX& x = simulation_->state().x;
  const Eigen::Index size = 3 * world().mesh_vertex_count();
  std::vector<std::pair<std::string, VecX>> all;
  for (const Term* term : world().terms) {
    auto same = std::find_if(all.begin(), all.end(), [&](const auto& a) { return a.first == term->name(); });
    if (same == all.end()) same = all.insert(all.end(), {term->name(), VecX::Zero(x.size())});
    add_term_gradient(*term, x, same->second);
  }
  py::dict d;
  for (auto& [name, gradient] : all) {
    gradient = -gradient;
    world().collect_on_meshes(gradient);
    d[py::str(name)] = copy(gradient.head(size), 3);
  }
  return d;
}

py::array Running::field(const std::string& name) {
  const Claim claim(busy_);
  return_to_state();
  const FrameGeometry geometry = frame_geometry(world());
  for (const FrameFieldInfo& info : frame_fields()) {
    if (info.name != name) continue;
    if (info.of_elements) {
      const std::vector<CellField> fields = element_fields({name}, world(), simulation_->state().x, geometry);
      if (!fields.empty()) return copy(fields[0].values, fields[0].components > 1 ? fields[0].components : 0);
    } else {
      const std::vector<PointField> fields = vertex_fields({name}, world(), simulation_->state(), geometry);
      if (!fields.empty()) return copy(fields[0].values, fields[0].components > 1 ? fields[0].components : 0);
    }
    throw py::value_error("nothing in this scene has the field '" + name + "'");
  }
  std::string known;
  for (const FrameFieldInfo& info : frame_fields()) known += (known.empty() ? "" : ", ") + info.name;
  throw py::value_error("there is no field '" + name + "'; there are " + known);
}

py::array Running::contacts(const std::string& force, const std::string& summand) {
  const Claim claim(busy_);
  return_to_state();
  return force_points(world(), simulation_->state().x, force, summand);
}

std::string Running::scene() const { return to_yaml(fields_of(simulation_->experiment())); }

void Running::write_frame(const std::string& path) {
  const Claim claim(busy_);
  return_to_state();
  const FrameGeometry geometry = frame_geometry(world());
  const State& state = simulation_->state();
  const std::vector<std::string> names = {"velocity", "contact_pressure", "von_mises_stress"};
  write_vtu(path, geometry, state.x.head(3 * geometry.vertices), state.time, vertex_fields(names, world(), state, geometry), element_fields(names, world(), state.x, geometry));
}

std::vector<double> Running::probe_values() {
  const Claim claim(busy_);
  return_to_state();
  return probes_->sample(world(), simulation_->state());
}

std::shared_ptr<Problem> Running::problem() {
  const Claim claim(busy_);
  end_problem();
  TimeStepper& stepper = simulation_->stepper();
  World& world = simulation_->world();
  const double h = stepper.next_step_size();
  const Step step = stepper.open(h);
  convergence_.emplace(world, simulation_->solver(), simulation_->experiment().time.step);
  convergence_->begin_step(step.potential, step.h, step.prediction.inertia);
  steps_.emplace(world, simulation_->clock(), nullptr, simulation_->solver().step_filters());
  StepPotential& potential = step.potential;
  MinimizerProblem problem{potential, {}, {}, simulation_->clock()};
  steps_->set_feasibility(potential, problem);
  convergence_->set_criteria(problem);
  VecX q;
  world.dofs.gather(step.targets, q);
  problem_ = std::make_shared<Problem>(std::move(problem), world, q);
  return problem_;
}

// Returns the warnings since the last call. Warnings of a step in progress are reported after it.
std::vector<Warning> Running::take_warnings() {
  if (busy_) return {};
  return std::exchange(warnings_, {});
}

void bind_running(py::module_& module) {
  py::class_<Body>(module, "Object", "An object of the scene: its name, its vertices among all, its elements.")
      .def_readonly("name", &Body::name)
      .def_readonly("first_vertex", &Body::first_vertex)
      .def_readonly("vertex_count", &Body::vertex_count)
      .def_property_readonly("tets", [](const Body& b) { return table(b.tets, 4); }, "(n, 4), vertices counted from 0 of the scene")
      .def_property_readonly("triangles", [](const Body& b) { return table(b.triangles, 3); }, "(n, 3): of its surface, outwards, and of sheets")
      .def_property_readonly("edges", [](const Body& b) { return table(b.edges, 2); }, "(n, 2): of rods")
      .def_property_readonly("points", [](const Body& b) { return b.points; }, "particles");

  const auto loaded = [](Running::Load load, const std::vector<std::string>& set, int threads) {
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    return std::make_unique<Running>(std::move(load), set, threads);
  };
  py::class_<Running>(module, "Running")
      .def_static("open", [loaded](const std::string& path, const std::vector<std::string>& set, int threads) {
        return loaded([path](const std::vector<std::string>& all) { return load_experiment(path, all); }, set, threads);
      })
      .def_static("parse", [loaded](const std::string& text, const std::string& name, const std::vector<std::string>& set, int threads) {
        return loaded([text, name](const std::vector<std::string>& all) { return parse_experiment(text, name, all); }, set, threads);
      })
      .def_property_readonly("name", &Running::name)
      .def_property_readonly("time", &Running::time)
      .def_property_readonly("step_count", &Running::step_count)
      .def_property_readonly("duration", &Running::duration)
      .def_property_readonly("step_size", &Running::step_size)
      .def_property_readonly("finished", &Running::finished)
      .def_property_readonly("threads", &Running::threads)
      .def_property_readonly("objects", [](const Running& r) {
        py::list all;
        for (const Body& body : r.world().bodies) all.append(py::cast(&body, py::return_value_policy::reference));
        return all;
      }, py::keep_alive<0, 1>())
      .def("step", &Running::step)
      .def("minimize_by", &Running::minimize_by)
      .def_property_readonly("x", &Running::positions)
      .def_property_readonly("v", &Running::velocities)
      .def_property_readonly("rest", &Running::rest)
      .def_property_readonly("mass", &Running::mass)
      .def("move", &Running::move, py::arg("x") = py::none(), py::arg("v") = py::none())
      .def("change", [](Running& r, const std::vector<std::string>& set) {
        const PlainNumbers plain;
        r.change(set);
      })
      .def("stages", &Running::stages)
      .def("energies", &Running::energies)
      .def("forces", &Running::forces)
      .def("field", &Running::field)
      .def("contacts", &Running::contacts, py::arg("force"), py::arg("summand"))
      .def("scene", &Running::scene)
      .def("write_frame", &Running::write_frame)
      .def("probe_columns", &Running::probe_columns)
      .def("probe_values", &Running::probe_values)
      .def("problem", &Running::problem)
      .def("take_warnings", [](Running& r) {
        py::list all;
        for (const Warning& w : r.take_warnings()) all.append(py::make_tuple(w.text, std::string(entry_of(w.kind).key)));
        return all;
      }, "Pairs of text and kind.");
}

}  // namespace tack::python
