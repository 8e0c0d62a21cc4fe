#include "python/bindings/stored.hpp"

#include <pybind11/stl.h>
#include <tbb/task_arena.h>

#include <filesystem>

#include "framework/config/parse.hpp"
#include "framework/plugin/plugins.hpp"
#include "framework/run/stored_step.hpp"
#include "geometry/plain_numbers.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/interrupts.hpp"
#include "python/bindings/problem.hpp"

namespace tack::python {
namespace {

struct Answers {
  std::vector<StoredSolve> solves;
  bool has_minimum = false;
};

Answers answers_of(const std::string& path, const std::vector<std::string>& solvers,
                   const std::vector<std::string>& set, const std::vector<std::string>& plugins,
                   bool minimum, const std::vector<py::object>& functions) {
  for (const std::string& plugin : plugins) load_plugin(std::filesystem::absolute(plugin).string());
  StoredStep step(path, set);
  if (minimum && !step.has_minimum()) step.find_minimum();
  Answers answers{{}, step.has_minimum()};
  for (size_t i = 0; i < solvers.size(); ++i) {
    StoredSolveSettings settings;
    if (const py::object& function = functions[i]; !function.is_none())
      settings.make_solver = [&function](const Minimizer& like, const World& world) {
        const py::gil_scoped_acquire gil;
        return minimizer_of(py::reinterpret_borrow<py::function>(function), like, world);
      };
    answers.solves.push_back(
        step.solve(solvers[i].empty() ? Value() : parse_string(solvers[i], "solvers"), settings));
  }
  return answers;
}

py::list solved(const std::string& path, const std::vector<std::string>& solvers,
                const std::vector<std::string>& set, const std::vector<std::string>& plugins,
                int threads, bool minimum, const std::vector<py::object>& functions) {
  Answers answers;
  try {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    arena.execute([&] { answers = answers_of(path, solvers, set, plugins, minimum, functions); });
  } catch (const SimulationError& error) {
    rethrow_python(error);
    throw;
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
  py::list all;
  for (const StoredSolve& s : answers.solves) {
    py::dict d;
    d["status"] = s.status;
    d["converged"] = s.converged;
    d["iterations"] = s.iterations;
    d["evaluations"] = s.evaluations;
    d["linear_solves"] = s.linear_solves;
    d["cpu_seconds"] = s.cpu_seconds;
    d["wall_seconds"] = s.wall_seconds;
    d["residual"] = s.residual;
    d["distance"] = s.distance ? py::object(py::float_(*s.distance)) : py::object(py::none());
    d["x"] = s.x.size() > 0 ? py::object(copy(s.x, 3)) : py::object(py::none());
    all.append(d);
  }
  return all;
}

}  // namespace

void bind_stored(py::module_& module) {
  module.def("solve", &solved, py::arg("path"), py::arg("solvers"), py::arg("set"),
             py::arg("plugins"), py::arg("threads"), py::arg("minimum"), py::arg("functions"));
}

}  // namespace tack::python
