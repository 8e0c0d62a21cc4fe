#include "framework/experiment/experiment.hpp"

#include "framework/config/parameters.hpp"
#include "framework/plugin/plugins.hpp"

namespace tack {

void Experiment::fields(Fields& f) {
  f.text("name", name, "name of the results folder").required().line();
  f.text("about", about, "purpose of the scene");
  f.paths("plugins", plugins, plugins_doc);
  // Parameters keep their units, which a stored scene needs when it is read again.
  f.quantities("parameters", parameters, "scene parameters, named numbers: an expression of them, `2 * width`, may "
                                         "replace any number, and formulas see them in SI. A parameter may be an "
                                         "expression of others").write = [this] {
    Value as_written = Value::map(), kept = Value::map(), root = Value::map();
    for (const auto& [key, quantity] : parameters) as_written.set(key, Value::scalar(quantity.written));
    root.set("parameters", as_written);
    const Parameters all = Parameters::of(root);
    for (const auto& [key, quantity] : parameters) kept.set(key, Value::scalar(all.like(key, quantity.si)));
    return kept;
  };
  f.object("time", time, "time stepping");
  SceneConfig::fields(f);
  f.component("solver", solver, "minimiser of each step");
  f.component_list("probes", probes, "quantities recorded every step");
  f.object("output", output, "files that are written");
  f.list("expect", expect, "expectations: all must hold for exit code 0");
}

}  // namespace tack
