// tack run: simulates an experiment.

#include <csignal>

#include "framework/app/commands.hpp"
#include "framework/app/experiment.hpp"
#include "framework/core/interrupt.hpp"

namespace tack {
namespace {

extern "C" void request_interrupt(int) { interrupt_requested = true; }

}  // namespace

void add_run_command(CLI::App& app, int& exit_code) {
  auto options = std::make_shared<ExperimentOptions>();
  CLI::App* run = app.add_subcommand("run", "Simulate an experiment");
  add_scene_options(*run, options->scene);
  run->add_option("-o,--output", options->output, "results folder (default: results/NAME)");
  run->add_option("--steps", options->steps, "stop after this many steps")->check(CLI::PositiveNumber);
  run->add_option("--threads", options->threads, "threads (default: all cores)")->check(CLI::PositiveNumber);
  run->add_flag("--resume", options->resume, "go on from the newest checkpoint of the results folder");
  run->add_option("--dump-problem", options->dump_problems,
                  "store a step to minimise it again: step=K, or hardest=N for those with most iterations (repeatable)")
      ->take_all()->allow_extra_args(false);
  run->add_flag("-q,--quiet", options->quiet, "print errors only");
  run->add_flag("-v,--verbose", options->verbose, "print a line for every step");
  run->callback([options, &exit_code] {
    settle(options->scene);
    std::signal(SIGINT, request_interrupt);
    std::signal(SIGTERM, request_interrupt);
    exit_code = run_experiment(*options);
  });
}

}  // namespace tack
