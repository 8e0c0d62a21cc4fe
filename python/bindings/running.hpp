// A simulation as Python has it: nothing is written, and threads are its own.
// One call at a time: while a step is under way, calls from other threads and from its own
// minimiser throw std::runtime_error, except calls that only read the results of the newest step.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <atomic>
#include <optional>
#include <string>
#include <vector>

#include "framework/output/probe_set.hpp"
#include "framework/run/simulation.hpp"
#include "framework/stepping/convergence.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "python/bindings/arrays.hpp"
#include "python/bindings/problem.hpp"

namespace tack::python {

class Running {
 public:
  // threads: 0 for all cores. Called without the interpreter's lock. Throws InputError.
  Running(LoadedExperiment loaded, int threads);
  ~Running();

  const std::string& name() const { return simulation_->experiment().name; }
  double time() const { return shown_.time; }
  int step_count() const { return shown_.step; }
  double duration() const { return simulation_->experiment().time.duration; }
  double step_size() const { return shown_.step_size; }
  bool finished() const { return shown_.finished; }
  int threads() const { return arena_.max_concurrency(); }
  const World& world() const { return simulation_->world(); }

  // One accepted step, without the interpreter's lock. Throws SimulationError, and KeyboardInterrupt: then there was no step.
  py::dict step();
  // Who minimises from now on; none: the scene's own.
  void minimize_by(const py::object& function);

  // Of all vertices (n, 3): they show the newest step, wherever they were asked for.
  py::array positions() const { return view(x_, 3); }
  py::array velocities() const { return view(v_, 3); }
  py::array rest() const { return copy(world().rest, 3); }
  py::array mass() const { return copy(world().mass, 0); }
  // Goes on from there. Throws InputError for what intersects or is inverted.
  void move(const std::optional<Numbers>& x, const std::optional<Numbers>& v);

  py::dict energies();
  py::dict forces();
  py::array field(const std::string& name);
  // The scene with everything that it leaves open, as runs keep it.
  std::string scene() const;
  // A frame as runs write them, with some fields of it.
  void write_frame(const std::string& path);
  std::vector<std::string> probe_columns() const { return probes_->columns(); }
  std::vector<double> probe_values();

  // Of the next step: good until there is another one, or a step.
  std::shared_ptr<Problem> problem();

  // What was doubtful since the last call.
  std::vector<std::string> take_warnings();

 private:
  // Locks the simulation for one call; the constructor throws std::runtime_error if another call
  // has locked it.
  class Claim {
   public:
    explicit Claim(std::atomic<bool>& busy);
    ~Claim() { busy_ = false; }
    Claim(const Claim&) = delete;
    Claim& operator=(const Claim&) = delete;

   private:
    std::atomic<bool>& busy_;
  };
  void return_to_state();
  void show();
  void end_problem();
  void restart();
  void settle();

  tbb::task_arena arena_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<ProbeSet> probes_;
  std::shared_ptr<VecX> x_ = std::make_shared<VecX>(), v_ = std::make_shared<VecX>();
  struct Shown {
    double time = 0, step_size = 0;  // s
    int step = 0;
    bool finished = false;
  } shown_;  // of the newest step, as x_ and v_ are
  std::vector<std::string> warnings_;
  std::atomic<bool> busy_ = false;

  // Of problem().
  std::shared_ptr<Problem> problem_;
  std::optional<Convergence> convergence_;
  std::optional<FeasibleSteps> steps_;
};

void bind_running(py::module_& module);

}  // namespace tack::python
