// The protocols of a run: which stage is under way, whether a step meets an end of it, and what
// comes next. All of it that outlasts a step is history, so that checkpoints have it:
//    "protocol/NAME"         stage, its begin, ..., visits of stages, values of probes at its ends
//    "protocol/NAME/stages"  the stages that have ended (StageVisit)
//    "drive/NAME"            path of a drive (protocol/drives.hpp)
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/formula.hpp"
#include "framework/experiment/built_experiment.hpp"
#include "framework/output/stages_csv.hpp"
#include "framework/run/control_search.hpp"
#include "framework/run/end_search.hpp"
#include "framework/stepping/step_events.hpp"

namespace tack {

class ProtocolRun : public StepEvents {
 public:
  // Throws InputError, with the source location, for probes that are not there and units that do
  // not fit. built must outlive it.
  explicit ProtocolRun(BuiltExperiment& built);

  void start(State& state) override;
  void begin_step(double t) override;
  double next_stop(double t) const override;
  void begin_try(double h) override;
  std::optional<double> repetition(const State& state, double h) override;
  void accept(State& state) override;
  bool finished() const override;
  std::vector<StepMetric> metrics() const override;

  // Takes up the present actions of drives in a state of another run with the same stages. Throws
  // InputError if the stages differ.
  void renew(State& state);
  // Returns why the run cannot go on: a stage that did not end. over: the run is at its end.
  std::string fault(double t, bool over) const;
  // Returns all stages so far, the present ones last, with t [s] as their end.
  std::vector<StageVisit> visits(double t) const;
  int ended_stages() const;
  // Returns the present stage of each protocol: "tack: approach".
  std::string stages_text() const;

 private:
  // An end of a stage, ready to be evaluated.
  struct End {
    EndCondition config;
    int column = -1;                 // of the probe
    int contact = -1;                // of the probes of contact
    std::optional<Formula> formula;  // of `when`
    double error = 0;                // accepted error of the probe's value
    Unit unit = units::none;
  };
  struct Stage {
    std::vector<End> ends;
  };
  struct Protocol {
    const ProtocolConfig* config;
    std::vector<Stage> stages;
    double time_tolerance;  // s
    // history
    int stage = 0;
    bool over = false;
    double begin = 0;                   // s
    double tries = 0;                   // steps that were repeated in the stage
    std::vector<int> repeats;           // per stage: how often `next` was followed
    std::vector<double> last, largest;  // per end of the stage
    std::vector<StageVisit> log;
  };

  void prepare(const Value& root);
  void prepare_end(const EndCondition& config, const StageConfig& stage,
                   const ProtocolConfig& protocol, End& end);
  void load(const History& history);
  void store(History& history) const;
  void sample(const State& state);
  const std::vector<End>& ends(const Protocol& p) const { return p.stages[p.stage].ends; }
  double value_of(const End& end) const;
  EndSearch::Excess excess(const Protocol& p, const End& end, double value, double largest,
                           double last, double h, double t) const;
  std::vector<EndSearch::Excess> excesses(double t, double h) const;
  void note_values(Protocol& p);
  void end_stage(Protocol& p, int cause, double t);
  void begin_stage(Protocol& p, int stage, double t);
  void begin_values(Protocol& p);
  std::optional<double> time_left(const Protocol& p, double t) const;
  std::string missed(const Protocol& p) const;
  Drive* controlled(const DriveAction** action);

  BuiltExperiment& built_;
  World& world_;
  ProbeSet probes_;
  std::vector<std::unique_ptr<const Probe>> contact_specs_;
  std::optional<ProbeSet> contacts_;
  std::vector<Protocol> protocols_;
  std::vector<double> values_, gaps_;   // of the last sample; values_ begin with the time
  std::vector<std::string> variables_;  // of `when`: t, then probes
  std::vector<int> variable_columns_;
  double step_begin_ = 0, step_size_ = 0;  // of the present step [s]
  double asked_ = 0;                       // size of the try that the search wants [s]; 0: none
  EndSearch search_;
  ControlSearch control_;
  bool controls_ = false;  // a drive is under control in this step
  double control_h_ = 0;   // size for which control_ searches [s]
};

}  // namespace tack
