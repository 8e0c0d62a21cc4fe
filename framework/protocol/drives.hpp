// Drives of the protocols of a world. A drive is a number over time,
//    u(t) = u0 + v min(t - t0, duration) + f(t - t0),   t0 <= t,
// from the time t0 at which its path began: at the start of a stage, and of every step under
// control. Motions, loads and adhesion laws that follow a drive read u(t).
// Its path is history (core/history.hpp), so that checkpoints have it, and a rejected step leaves
// it as it was.
#pragma once

#include <deque>
#include <limits>
#include <optional>
#include <string>

#include "framework/config/formula.hpp"
#include "framework/core/step_participant.hpp"
#include "framework/protocol/protocol_config.hpp"

namespace tack {

// Kind of the followers of a drive, which gives the drive its unit.
enum class FollowerKind { unused, displacement, angle, load, adhesion };
const Unit& unit_of(FollowerKind kind);    // m, rad, 1
Unit velocity_unit_of(FollowerKind kind);  // m/s, rad/s, 1/s
bool is_factor(FollowerKind kind);

struct DrivePath {
  double start = 0;                                           // u0
  double time = 0;                                            // t0 [s]
  double velocity = 0;                                        // v
  double duration = std::numeric_limits<double>::infinity();  // s
  int stage = -1;     // of the protocol, for its formula; -1: none
  double slope = 0;   // under control: of the probe by the drive, as last seen; 0: unknown
  double before = 0;  // value just before t0: a stage may set a factor at once
};

class Drive {
 public:
  Drive(std::string name, const ProtocolConfig& protocol);
  const std::string& name() const { return name_; }
  const ProtocolConfig& protocol() const { return protocol_; }
  FollowerKind kind() const { return kind_; }
  // Sets what follows it. Throws InputError if something of another kind does.
  void follow(FollowerKind kind, const std::string& follower);

  double at(double t) const;
  // Returns its value at the end of the present step.
  double now() const { return now_; }
  // Returns its value before the present step.
  double before() const { return before_; }
  const DrivePath& path() const { return path_; }
  void set(const DrivePath& path) { path_ = path; }
  // Sets the velocity of the present try of a step under control; nothing: that of the path.
  void try_velocity(std::optional<double> velocity) { tried_ = velocity; }
  // Starts stage `stage` at time t [s].
  void begin_stage(int stage, double t);
  // Returns its action in a stage; null: it stays where it is.
  const DriveAction* action(int stage) const;

 private:
  friend class Drives;
  std::string name_;
  const ProtocolConfig& protocol_;
  FollowerKind kind_ = FollowerKind::unused;
  std::string follower_;
  std::vector<std::optional<Formula>> formulas_;  // per stage
  DrivePath path_;
  std::optional<double> tried_;  // no history: each try sets it
  double now_ = 0, before_ = 0;
};

class Drives : public StepParticipant {
 public:
  // Adds the drives that stages name. protocols must outlive it. Throws InputError for a drive of
  // two protocols.
  void add(const std::vector<ProtocolConfig>& protocols);
  bool empty() const { return drives_.empty(); }
  // Returns the drive that `follower` names, and notes it. Throws InputError if there is none.
  Drive& follow(const std::string& name, FollowerKind kind, const std::string& follower);
  // Checks actions against what follows the drives. Throws InputError.
  void check() const;
  // Starts all protocols at time t [s].
  void begin(double t, History& history);

  Drive* find(const std::string& name);
  std::deque<Drive>& all() { return drives_; }
  void store(History& history) const;
  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;

  // Returns whether the present step changes the factor of an adhesion.
  bool adhesion_changes() const;
  // Exchanges the factors of adhesion at the start and at the end of the present step.
  void exchange_adhesion();
  // Returns the positions at the start of the present step (3n) [m]; known if adhesion changes.
  const VecX& step_start() const { return step_start_; }

 private:
  std::deque<Drive> drives_;  // at fixed addresses
  VecX step_start_;
};

}  // namespace tack
