#include "framework/compare/compare_config.hpp"

#include <fmt/format.h>

#include <set>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/experiment/file_kind.hpp"
#include "framework/plugin/plugins.hpp"
#include "framework/stepping/time_config.hpp"

namespace tack {

void SolverEntry::fields(Fields& f) {
  f.text("name", name, "name in tables and plots").required().line();
  f.raw("solver", solver, "merged over the scene's solver; another `type` replaces it");
  f.raw("stepper", stepper, "merged over the scene's time.stepper; another `type` replaces it");
  f.raw("time", time, "merged over the scene's time: another integrator, or adaptive steps. A `step` given here replaces time_steps");
  f.check("solver", [this]() -> std::string {
    return solver.is_null() && stepper.is_null() && time.is_null() ? "give a solver, a stepper, a time, or several of them" : "";
  });
  f.check("time", [this]() -> std::string {
    for (const char* key : {"duration", "wall_limit", "stepper"})
      if (time.find(key)) return fmt::format("takes no {}: {}", key, key == std::string("stepper") ? "give it beside `time`" : "the comparison sets the end time");
    return "";
  });
}

std::optional<double> SolverEntry::own_step() const {
  if (!time.find("step")) return std::nullopt;
  TimeConfig own;
  bind(time, own, "time");
  return own.step;
}

void BaseEntry::fields(Fields& f) {
  f.text("name", name, "name in tables; the scene's own name unless given").line();
  f.path("file", file, "the experiment").required();
  f.texts("set", set, "overrides, as `time.step=1 ms`");
  f.integer("steps", steps, "number of its own time steps; 0: to its end").at_least(0);
}

void CompareConfig::fields(Fields& f) {
  f.text("name", name, "name of the results folder").required().line();
  f.text("about", about, "purpose of the comparison");
  f.paths("plugins", plugins, plugins_doc);
  f.path("base", base, "a scene, solved from its start");
  f.texts("set", set, "overrides of the base, as `time.step=1 ms`");
  f.list("bases", bases, "several scenes, each with its own overrides and steps");
  f.paths("problems", problems, "files of `tack run --dump-problem`, one step each");
  f.list("solvers", solvers, "solvers that are compared").required().nonempty();
  f.numbers("tolerances", tolerances, units::velocity, "values of each solver's `tolerance`, in turn")
      .required().nonempty().positive();
  f.numbers("time_steps", time_steps, units::time,
            "time steps to solve with; the scene's own unless given. A run's end stays where it is").positive();
  f.integer("steps", steps, "number of the base's own time steps; 0: to its end").at_least(0);
  f.integer("repeat", repeat, "number of repeated measurements; medians count").at_least(1);
  f.number("reference_tolerance", reference_tolerance, units::velocity, "tolerance of the reference solutions")
      .positive();
  f.optional_number("reference_time_step", reference_time_step, units::time,
                    "time step of the reference, so that errors include time discretisation; unless given, each time "
                    "step has its own reference and errors are those of the solver alone").positive();
  f.optional_number("error_limit", error_limit, units::none,
                    "largest error of a vertex, relative to the size of what moves (`relative_error`), up to which a converged result counts as solved; unless "
                    "given 1e-3, and no limit for runs whose time step is not that of the reference").positive();
  f.check("base", [this]() -> std::string {
    return base.empty() && bases.empty() && problems.empty() ? "give an experiment (base, bases) or stored steps (problems)" : "";
  });
  f.check("solvers", [this]() -> std::string {
    std::set<std::string> names;
    for (const SolverEntry& s : solvers)
      if (!names.insert(s.name).second) return fmt::format("two solvers are named '{}'; names must differ", s.name);
    return "";
  });
  f.check("reference_time_step", [this]() -> std::string {
    return reference_time_step && !problems.empty() ? "is for a base only: it would change the end time of a single step" : "";
  });
}

CompareConfig load_comparison(const std::string& path, const std::vector<std::string>& overrides) {
  Value root = parse_file(path);
  for (const std::string& assignment : overrides) apply_override(root, assignment);
  refuse_other_kind(root, FileKind::comparison);
  load_plugins(root);
  CompareConfig config;
  bind(root, config, "the comparison");
  return config;
}

}  // namespace tack
