#include "framework/experiment/experiment.hpp"

#include "framework/plugin/plugins.hpp"

namespace tack {

void Experiment::fields(Fields& f) {
  f.text("name", name, "what the results folder is called").required().line();
  f.text("about", about, "what the experiment must show");
  f.paths("plugins", plugins, plugins_doc);
  f.quantities("parameters", parameters, "numbers with names: expressions of them, `2 * width`, may stand wherever a number does, and formulas know them in SI. Each may be an "
               "expression of others");
  f.object("time", time, "time stepping");
  SceneConfig::fields(f);
  f.component("solver", solver, "minimiser of each step");
  f.component_list("probes", probes, "quantities recorded every step");
  f.object("output", output, "what is written");
  f.list("expect", expect, "what must hold for the run to exit with 0");
}

}  // namespace tack
