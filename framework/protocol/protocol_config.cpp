#include "framework/protocol/protocol_config.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "framework/config/formula.hpp"
#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

std::string formula_error(const std::string& text) {
  try {
    Formula(text, {"t"});
    return "";
  } catch (const InputError& error) {
    return error.what();
  }
}

// Returns the error of a name that becomes a column of files, or "".
std::string name_error(const std::string& name) {
  const auto fits = [](unsigned char c) { return c >= 0x80 || std::isalnum(c) || c == '_' || c == '-' || c == ' '; };
  return std::all_of(name.begin(), name.end(), fits) ? "" : fmt::format("'{}' is of letters, digits, spaces, _ and -", name);
}

}  // namespace

void DriveAction::fields(Fields& f) {
  f.optional_quantity("velocity", velocity, "constant velocity along the motion's direction, or angular velocity");
  f.optional_quantity("position", position, "displacement or angle, counted from the start of the run, that is driven to and held; needs `speed`");
  f.optional_quantity("speed", speed, "speed towards `position`; of `control` the largest speed, negative if the probe grows as the drive moves backwards");
  f.optional_number("factor", factor, units::none, "factor of a load, or of an adhesion (0 to 1)").nonnegative();
  f.optional_number("within", duration, units::time, "time in which `factor` is reached, linearly; at once unless given").positive();
  f.text("formula", formula, "added to where the drive was when the stage began [SI]: a formula of the time t since then [s]").formula({"t"});
  f.text("control", control, "probe that is kept at `target`: the position of the drive at the end of each step is found by a root search");
  f.optional_quantity("target", target, "value of the probe `control`");
  f.optional_quantity("tolerance", error, "largest error of the probe `control`; a thousandth of `target` unless given");
  f.check("velocity", [this]() -> std::string {
    const int given = velocity.has_value() + position.has_value() + factor.has_value() + !formula.empty() + !control.empty();
    return given == 1 ? "" : "give one of velocity, position, factor, formula and control; a drive that stays where it is is left out";
  });
  f.check("speed", [this]() -> std::string {
    if (position && !(speed && speed->si > 0)) return "position needs the speed (above zero) with which it is driven to";
    if (!control.empty() && !(speed && speed->si != 0))
      return "control needs the largest speed of the drive: positive if the probe grows as the drive moves forwards, negative otherwise";
    return speed && position.has_value() + !control.empty() == 0 ? "is of position and control; give velocity alone" : "";
  });
  f.check("within", [this]() -> std::string { return duration && !factor ? "is of factor; a position takes a speed" : ""; });
  f.check("target", [this]() -> std::string {
    if (control.empty()) return target || error ? "is of control, which names the probe" : "";
    if (!target) return "control needs the target of its probe";
    if (error && error->si <= 0) return "the tolerance must be positive";
    return target->si == 0 && !error ? "a target of zero needs a tolerance" : "";
  });
  f.check("formula", [this]() -> std::string { return formula.empty() ? "" : formula_error(formula); });
}

void EndCondition::fields(Fields& f) {
  f.optional_number("time", time, units::time, "time since the stage began; 0: the stage is passed over").nonnegative();
  f.text("probe", probe, "probe (column of probes.csv), with one of above, below, rate_below and drop");
  f.optional_quantity("above", above, "the stage ends when the probe rises to this value");
  f.optional_quantity("below", below, "the stage ends when the probe falls to this value");
  f.optional_quantity("rate_below", rate_below, "the stage ends when the probe changes by less than this per second, from one step to the next");
  f.optional_number("drop", drop, units::none, "the stage ends when the probe has fallen by this fraction from its largest value in the stage (break detection)")
      .range(0, 1);
  f.texts("contact", contact, "two objects: the stage ends when they come within the contact distance");
  f.text("when", when, "the stage ends when this formula of probes, and of the time t since the stage began, becomes true [SI]: `force > 0.5 && gap < 1e-3`");
  f.optional_quantity("within", within, "error that the probe's value may have at the end of the stage; a thousandth of the value unless given");
  f.check("probe", [this]() -> std::string {
    const int of_probe = above.has_value() + below.has_value() + rate_below.has_value() + drop.has_value();
    if (probe.empty()) return of_probe > 0 || within ? "above, below, rate_below, drop and within are of a probe; name it" : "";
    return of_probe == 1 ? "" : "give one of above, below, rate_below and drop; further ends stand under `or`";
  });
  f.check("time", [this]() -> std::string {
    const int given = time.has_value() + !probe.empty() + !contact.empty() + !when.empty();
    return given == 1 ? "" : "give one of time, probe, contact and when; further ends stand under `or`";
  });
  f.check("contact", [this]() -> std::string { return contact.empty() || contact.size() == 2 ? "" : "expects two object names"; });
  f.check("within", [this]() -> std::string { return within && within->si <= 0 ? "must be positive" : ""; });
  f.check("rate_below", [this]() -> std::string { return rate_below && rate_below->si <= 0 ? "must be positive" : ""; });
}

void EndConditions::fields(Fields& f) {
  EndCondition::fields(f);
  f.list("or", others, "further ends; the first one that is met ends the stage");
}

void StageConfig::fields(Fields& f) {
  f.text("name", name, "name in results").required().line();
  f.map("drive", drive, "what it does with drives, by their names; a drive that is not named stays where it is");
  f.optional_object("until", until, "when it ends; the last stage may do without, and lasts to the end of the run");
  f.optional_number("longest", longest, units::time, "time after which a stage that has not ended is an error; the duration of the run unless given").positive();
  f.optional_number("step", step, units::time, "largest time step of the stage, if it is smaller than that of the run").positive();
  f.text("next", next, "stage that follows, or `end`; the one below unless given");
  f.optional_integer("repeat", repeat, "how often `next` is gone to before the stage below follows; always unless given").at_least(1);
  f.check("name", [this] { return name == "end" ? std::string("'end' means the end of the protocol; choose another name") : name_error(name); });
  f.check("repeat", [this]() -> std::string { return repeat && next.empty() ? "needs `next`, the stage to go back to" : ""; });
  f.check("next", [this]() -> std::string {
    const std::vector<EndCondition> all = ends();
    const bool passed_over = std::any_of(all.begin(), all.end(), [](const EndCondition& end) { return end.time == 0.0; });
    return passed_over && !next.empty() && next != "end" ? "a stage of 0 s goes to the stage below; take `next` away, or let it last" : "";
  });
  f.check("until", [this]() -> std::string {
    return until || (!longest && next.empty()) ? "" : "a stage with next, repeat or longest needs an end";
  });
}

std::vector<EndCondition> StageConfig::ends() const {
  if (!until) return {};
  std::vector<EndCondition> all{*until};
  all.insert(all.end(), until->others.begin(), until->others.end());
  return all;
}

void ProtocolConfig::fields(Fields& f) {
  f.text("name", name, "name in results").required().line();
  f.list("stages", stages, "stages, in their order").required().nonempty();
  f.optional_number("time_tolerance", time_tolerance, units::time,
                    "time within which the end of a stage is found where the probe jumps; a thousandth of time.step unless given").positive();
  f.check("name", [this] { return name_error(name); });
  f.check("stages", [this]() -> std::string {
    std::set<std::string> names;
    std::vector<std::string> known{"end"};
    for (const StageConfig& stage : stages) {
      if (!names.insert(stage.name).second) return fmt::format("two stages are named '{}'", stage.name);
      known.push_back(stage.name);
    }
    for (size_t i = 0; i < stages.size(); ++i) {
      const StageConfig& stage = stages[i];
      if (!stage.next.empty() && stage.next != "end" && index_of(stage.next) < 0)
        return fmt::format("stage '{}' goes on to '{}', which is no stage{}", stage.name, stage.next, suggestion(stage.next, known, "stages"));
      if (!stage.until && i + 1 < stages.size()) return fmt::format("stage '{}' has no `until`: the stage below it would never begin", stage.name);
    }
    return "";
  });
}

int ProtocolConfig::index_of(const std::string& stage) const {
  const auto found = std::find_if(stages.begin(), stages.end(), [&](const StageConfig& s) { return s.name == stage; });
  return found == stages.end() ? -1 : static_cast<int>(found - stages.begin());
}

void need_stage(const std::vector<ProtocolConfig>& protocols, const std::string& stage) {
  std::vector<std::string> names;
  for (const ProtocolConfig& protocol : protocols)
    for (const StageConfig& one : protocol.stages) names.push_back(one.name);
  if (std::find(names.begin(), names.end(), stage) == names.end())
    throw InputError(fmt::format("no protocol has a stage '{}'{}", stage, suggestion(stage, names, "stages")));
}

}  // namespace tack
