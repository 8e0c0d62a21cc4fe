// A simulation for Python, with its own threads; it writes no files. One call at a time: during a
// step, calls from other threads and from the simulation's minimiser throw std::runtime_error,
// except calls that only read results of the last step.
#pragma once

#include <tbb/task_arena.h>

#include <memory>
#include <atomic>
#include <functional>
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
  // threads: 0 for all cores. Call it without the interpreter's lock. Throws InputError.
  // load: loads the scene with further overrides.
  using Load = std::function<LoadedExperiment(const std::vector<std::string>& overrides)>;
  Running(Load load, std::vector<std::string> overrides, int threads);
  ~Running();

  const std::string& name() const { return simulation_->experiment().name; }
  double time() const { return shown_.time; }
  int step_count() const { return shown_.step; }
  double duration() const { return simulation_->experiment().time.duration; }
  double step_size() const { return shown_.step_size; }
  bool finished() const { return shown_.finished; }
  int threads() const { return arena_.max_concurrency(); }
  const World& world() const { return simulation_->world(); }

  // Makes one accepted step, without the interpreter's lock. Throws SimulationError; on
  // KeyboardInterrupt the state does not change.
  py::dict step();
  // Sets the minimiser from now on; None: the scene's own.
  void minimize_by(const py::object& function);

  // Views of all vertices (n, 3), which always show the last step.
  py::array positions() const { return view(x_, 3); }
  py::array velocities() const { return view(v_, 3); }
  py::array rest() const { return copy(world().rest, 3); }
  py::array mass() const { return copy(world().mass, 0); }
  // Continues from these positions and velocities. Throws InputError if they intersect or invert
  // elements.
  void move(const std::optional<Numbers>& x, const std::optional<Numbers>& v);

  // Continues with a changed scene (run/changed_scene.hpp). Throws InputError, with nothing
  // changed.
  void change(const std::vector<std::string>& overrides);
  // Returns the stages of protocols that have begun: a dictionary for each row of stages.csv.
  py::list stages();

  py::dict energies();
  py::dict forces();
  py::array field(const std::string& name);
  // Returns the points at which a force between surfaces acts (force_points.hpp).
  py::array contacts(const std::string& force, const std::string& summand);
  // Returns the scene with all defaults resolved, as in results of runs.
  std::string scene() const;
  // Writes a frame as runs do, with some of the fields.
  void write_frame(const std::string& path);
  std::vector<std::string> probe_columns() const { return probes_->columns(); }
  std::vector<double> probe_values();

  // Returns the problem of the next step, valid until the next problem or step.
  std::shared_ptr<Problem> problem();

  // Returns the warnings since the last call.
  std::vector<Warning> take_warnings();

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
  std::function<void(const Warning&)> collect() {
    return [this](const Warning& w) { warnings_.push_back(w); };
  }
  void restart();
  void settle();

  Load load_;
  std::vector<std::string> overrides_;                     // of the scene as it is
  std::function<std::unique_ptr<Minimizer>()> minimizer_;  // empty: the scene's own
  tbb::task_arena arena_;
  std::unique_ptr<Simulation> simulation_;
  std::optional<ProbeSet> probes_;
  std::shared_ptr<VecX> x_ = std::make_shared<VecX>(), v_ = std::make_shared<VecX>();
  struct Shown {
    double time = 0, step_size = 0;  // s
    int step = 0;
    bool finished = false;
  } shown_;  // of the last step, as x_ and v_
  std::vector<Warning> warnings_;
  std::atomic<bool> busy_ = false;

  // Parts of problem().
  std::shared_ptr<Problem> problem_;
  std::optional<Convergence> convergence_;
  std::optional<FeasibleSteps> steps_;
};

void bind_running(py::module_& module);

}  // namespace tack::python
