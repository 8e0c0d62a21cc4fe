#include "framework/protocol/drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr int path_width = 7;  // numbers of a path

std::string history_name(const std::string& drive) { return "drive/" + drive; }

std::string text_of(FollowerKind kind) {
  switch (kind) {
    case FollowerKind::displacement: return "a displacement";
    case FollowerKind::angle: return "an angle";
    case FollowerKind::load: return "the factor of a load";
    case FollowerKind::adhesion: return "the factor of an adhesion";
    case FollowerKind::unused: break;
  }
  return "nothing";
}

// Throws InputError if an action does not fit what follows the drive.
void check_action(const Drive& drive, const StageConfig& stage, const DriveAction& action) {
  const std::string where = fmt::format("protocol '{}', stage '{}', drive '{}'", drive.protocol().name, stage.name, drive.name());
  const auto check = [&](const std::optional<Quantity>& quantity, const Unit& unit, const char* key) {
    if (!quantity) return;
    try {
      quantity->check(unit);
    } catch (const InputError& error) {
      throw InputError(fmt::format("{}: {}: {}", where, key, error.what()));
    }
  };
  if (is_factor(drive.kind())) {
    if (!action.factor && action.formula.empty())
      throw InputError(fmt::format("{}: is {}, which `factor` or `formula` sets; velocity, position and control are of motions", where, text_of(drive.kind())));
    if (drive.kind() == FollowerKind::adhesion && !(action.factor && *action.factor <= 1))
      throw InputError(fmt::format("{}: the factor of an adhesion is a number from 0 to 1; give the pair the largest adhesion that it ever has", where));
    return;
  }
  if (action.factor)
    throw InputError(fmt::format("{}: is {}, and factor is of loads and adhesion; give velocity, position, formula or control", where, text_of(drive.kind())));
  check(action.velocity, velocity_unit_of(drive.kind()), "velocity");
  check(action.position, unit_of(drive.kind()), "position");
  check(action.speed, velocity_unit_of(drive.kind()), "speed");
}

}  // namespace

const Unit& unit_of(FollowerKind kind) { return kind == FollowerKind::displacement ? units::length : kind == FollowerKind::angle ? units::angle : units::none; }

Unit velocity_unit_of(FollowerKind kind) {
  return kind == FollowerKind::displacement ? units::velocity : kind == FollowerKind::angle ? units::angular_velocity : units::rate;
}

bool is_factor(FollowerKind kind) { return kind == FollowerKind::load || kind == FollowerKind::adhesion; }

// Until its protocol begins, a drive has the largest factor of its stages: estimates of loads before
// the run (setup/dynamic_pressure.hpp) see that.
Drive::Drive(std::string name, const ProtocolConfig& protocol) : name_(std::move(name)), protocol_(protocol) {
  for (const StageConfig& stage : protocol.stages) {
    formulas_.emplace_back();
    const auto found = stage.drive.find(name_);
    if (found == stage.drive.end()) continue;
    if (!found->second.formula.empty()) formulas_.back().emplace(found->second.formula, std::vector<std::string>{"t"});
    if (found->second.factor) path_.start = std::max(path_.start, *found->second.factor);
  }
}

void Drive::follow(FollowerKind kind, const std::string& follower) {
  if (kind_ != FollowerKind::unused && kind_ != kind)
    throw InputError(fmt::format("{} follows the drive '{}' as {}, and {} as {}; give them drives of their own", follower, name_, text_of(kind), follower_, text_of(kind_)));
  kind_ = kind;
  follower_ = follower;
  if (kind == FollowerKind::adhesion) now_ = 1;
}

double Drive::at(double t) const {
  const double since = std::max(t - path_.time, 0.0);
  double u = path_.start + tried_.value_or(path_.velocity) * std::min(since, path_.duration);
  if (path_.stage >= 0 && formulas_[path_.stage]) u += (*formulas_[path_.stage])(std::array{since});
  return u;
}

const DriveAction* Drive::action(int stage) const {
  if (stage < 0 || stage >= static_cast<int>(protocol_.stages.size())) return nullptr;
  const auto found = protocol_.stages[stage].drive.find(name_);
  return found == protocol_.stages[stage].drive.end() ? nullptr : &found->second;
}

void Drive::begin_stage(int stage, double t) {
  DrivePath path{at(t), t};
  path.slope = path_.slope;
  path.before = path.start;
  if (const DriveAction* action = this->action(stage)) {
    path.stage = action->formula.empty() ? -1 : stage;
    if (action->velocity) path.velocity = action->velocity->si;
    if (action->position) {
      const double distance = action->position->si - path.start;
      path.duration = std::abs(distance) / action->speed->si;
      path.velocity = std::copysign(action->speed->si, distance);
    }
    if (action->factor && action->duration) path.duration = *action->duration, path.velocity = (*action->factor - path.start) / *action->duration;
    else if (action->factor) path.start = *action->factor;
  }
  path_ = path;
}

void Drives::add(const std::vector<ProtocolConfig>& protocols) {
  for (const ProtocolConfig& protocol : protocols)
    for (const StageConfig& stage : protocol.stages)
      for (const auto& [name, action] : stage.drive) {
        const Drive* known = find(name);
        if (known && &known->protocol() != &protocol)
          throw InputError(fmt::format("the drive '{}' is of the protocols '{}' and '{}'; one protocol drives it", name, known->protocol().name, protocol.name));
        if (!known) drives_.emplace_back(name, protocol);
      }
}

Drive* Drives::find(const std::string& name) {
  const auto found = std::find_if(drives_.begin(), drives_.end(), [&](const Drive& d) { return d.name() == name; });
  return found == drives_.end() ? nullptr : &*found;
}

Drive& Drives::follow(const std::string& name, FollowerKind kind, const std::string& follower) {
  Drive* drive = find(name);
  if (!drive) {
    std::vector<std::string> names;
    for (const Drive& d : drives_) names.push_back(d.name());
    throw InputError(fmt::format("{} follows the drive '{}', and no stage of a protocol drives it{}", follower, name,
                                 names.empty() ? "; give the scene `protocols`" : suggestion(name, names, "drives")));
  }
  drive->follow(kind, follower);
  return *drive;
}

void Drives::check() const {
  for (const Drive& drive : drives_) {
    if (drive.kind() == FollowerKind::unused)
      throw InputError(fmt::format("protocol '{}': nothing follows the drive '{}'; name it as `drive` of a motion of type driven, of a load or of a pair", drive.protocol().name,
                                   drive.name()));
    for (const StageConfig& stage : drive.protocol().stages)
      if (const auto found = stage.drive.find(drive.name()); found != stage.drive.end()) check_action(drive, stage, found->second);
  }
}

void Drives::begin(double t, History& history) {
  for (Drive& drive : drives_) {
    drive.path_ = {drive.kind() == FollowerKind::adhesion ? 1.0 : 0.0, t};
    drive.begin_stage(0, t);
    drive.now_ = drive.path_.before = drive.at(t);
  }
  store(history);
}

void Drives::store(History& history) const {
  for (const Drive& drive : drives_) {
    const DrivePath& p = drive.path_;
    history[history_name(drive.name())] = {path_width, {p.start, p.time, p.velocity, p.duration, static_cast<double>(p.stage), p.slope, p.before}, {}};
  }
}

void Drives::load_history(const History& history) {
  for (Drive& drive : drives_)
    if (const auto* values = history_values(history, history_name(drive.name()), path_width, 1))
      drive.path_ = {(*values)[0], (*values)[1], (*values)[2], (*values)[3], static_cast<int>((*values)[4]), (*values)[5], (*values)[6]};
}

void Drives::begin_step(const StepStart& start) {
  for (Drive& drive : drives_) {
    drive.before_ = start.time > drive.path_.time ? drive.at(start.time) : drive.path_.before;
    drive.now_ = drive.at(start.time + start.h);
  }
  if (adhesion_changes()) step_start_ = start.x;
}

bool Drives::adhesion_changes() const {
  return std::any_of(drives_.begin(), drives_.end(), [](const Drive& d) { return d.kind() == FollowerKind::adhesion && d.before_ != d.now_; });
}

void Drives::exchange_adhesion() {
  for (Drive& drive : drives_)
    if (drive.kind() == FollowerKind::adhesion) std::swap(drive.before_, drive.now_);
}

}  // namespace tack
