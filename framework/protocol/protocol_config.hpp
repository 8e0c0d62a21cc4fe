// Protocol: how a laboratory runs a test, as named stages. A stage says what moves (drives), until
// when, and what comes next:
//    protocols:
//      - name: tack
//        stages:
//          - {name: approach, drive: {head: {velocity: -0.1 mm/s}}, until: {probe: force, above:
//          0.5 N}}
//          - {name: dwell, until: {time: 1 s}}
//          - {name: retract, drive: {head: {velocity: 1 mm/s}}, until: {probe: gap, above: 1 mm}}
// A drive is a number over time: the displacement or angle of a motion (motion/driven_motion.cpp),
// the factor of a load, the factor of an adhesion. A drive that a stage does not name stays where
// it is. docs/protocols.md says how to write one, docs/decisions/86-protocols.md why it is so.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

// Action of a stage on a drive: one of velocity, position, factor, formula, control.
struct DriveAction {
  std::optional<Quantity> velocity;  // m/s or rad/s
  std::optional<Quantity> position;  // from where the run began [m or rad]
  std::optional<Quantity> speed;     // of position; of control its limit [m/s or rad/s]
  std::optional<double> factor;
  std::optional<double> duration;  // `within`: of a change of the factor [s]; none: at once
  std::string formula;             // added to the position at the start of the stage
  std::string control;             // probe
  std::optional<Quantity> target;  // of the probe
  std::optional<Quantity> error;   // `tolerance`: of the probe
  void fields(Fields& f);
};

// An end of a stage.
struct EndCondition {
  std::optional<double> time;  // since the stage began [s]
  std::string probe;           // with one of the next four
  std::optional<Quantity> above, below;
  std::optional<Quantity> rate_below;  // of its absolute value, per second
  std::optional<double> drop;          // fraction of its largest value in the stage
  std::vector<std::string> contact;    // two objects
  std::string when;                    // formula of probes and of the time t since the stage began
  std::optional<Quantity> within;      // error of the probe's value at the end
  void fields(Fields& f);
  bool given() const { return time || !probe.empty() || !contact.empty() || !when.empty(); }
};

struct EndConditions : EndCondition {
  std::vector<EndCondition> others;  // `or`
  void fields(Fields& f);
};

struct StageConfig {
  std::string name;
  std::map<std::string, DriveAction> drive;
  std::optional<EndConditions> until;  // none: to the end of the run
  std::optional<double> longest;       // s
  std::optional<double> step;          // largest time step [s]; none: time.step
  std::string next;                    // stage, or "end"; empty: the following one
  std::optional<int> repeat;           // how often `next` is followed; none: always
  void fields(Fields& f);
  // Returns all ends.
  std::vector<EndCondition> ends() const;
};

struct ProtocolConfig {
  std::string name;
  std::vector<StageConfig> stages;
  std::optional<double> time_tolerance;  // s
  void fields(Fields& f);
  // Returns the index of a stage; -1: none.
  int index_of(const std::string& stage) const;
};

// Throws InputError, with the nearest name, if no protocol has the stage.
void need_stage(const std::vector<ProtocolConfig>& protocols, const std::string& stage);

}  // namespace tack
