#include "framework/run/protocol_run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/protocol/stage_metrics.hpp"
#include "framework/run/stage_ends.hpp"
#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double round_off = 1e-9;  // of time.step
constexpr int fixed_numbers = 4;    // of a protocol's history, before its lists
constexpr int visit_width = 6;      // numbers of a stage that has ended
const double infinity = std::numeric_limits<double>::infinity();

std::string history_name(const ProtocolConfig& protocol) { return "protocol/" + protocol.name; }

// Returns the index of an end after 0 s, as of the dwell of a series over dwell times; -1: none. No
// step has that size: such a stage is passed over.
template <class End>
int end_at_once(const std::vector<End>& ends) {
  const auto at = std::find_if(ends.begin(), ends.end(), [](const End& end) { return end.config.time == 0.0; });
  return at == ends.end() ? -1 : static_cast<int>(at - ends.begin());
}

}  // namespace

ProtocolRun::ProtocolRun(BuiltExperiment& built)
    : built_(built), world_(built.world()), probes_(probes_of(built)), search_(time_tolerance * built.experiment().time.step) {
  prepare(built.root());
}

// The values of probes at the start are those of the state, unless the history has them.
void ProtocolRun::start(State& state) {
  if (state.history.contains(history_name(*protocols_.front().config))) return load(state.history);
  sample(state);
  for (Protocol& p : protocols_) {
    p.begin = state.time;
    begin_values(p);
    if (const int at_once = end_at_once(ends(p)); at_once >= 0) end_stage(p, at_once, state.time);
  }
  store(state.history);
}

void ProtocolRun::load(const History& history) {
  for (Protocol& p : protocols_) {
    const std::vector<double>& v = history.at(history_name(*p.config)).values;
    p.stage = static_cast<int>(v[0]);
    p.over = v[1] != 0;
    p.begin = v[2];
    p.tries = v[3];
    auto at = v.begin() + fixed_numbers;
    for (int& count : p.repeats) count = static_cast<int>(*at++);
    const size_t ends = this->ends(p).size();
    p.last.assign(at, at + static_cast<std::ptrdiff_t>(ends));
    p.largest.assign(at + static_cast<std::ptrdiff_t>(ends), v.end());
    p.log.clear();
    const auto log = history.find(history_name(*p.config) + "/stages");
    if (log == history.end()) continue;
    for (int i = 0; i < log->second.entries(); ++i) {
      const double* n = &log->second.values[static_cast<size_t>(visit_width) * i];
      const int stage = static_cast<int>(n[0]), cause = static_cast<int>(n[3]);
      const End& end = p.stages[stage].ends[cause];
      p.log.push_back({p.config->name, p.config->stages[stage].name, stage + 1, n[1], n[2], text_of(end.config, end.unit), n[4], static_cast<int>(n[5]), cause});
    }
  }
}

void ProtocolRun::renew(State& state) {
  for (const Protocol& p : protocols_) {
    const auto known = state.history.find(history_name(*p.config));
    const size_t fixed = fixed_numbers + p.stages.size();
    if (known == state.history.end() || known->second.values.size() < fixed || known->second.values[0] >= static_cast<double>(p.stages.size()) ||
        known->second.values.size() != fixed + 2 * p.stages[static_cast<size_t>(known->second.values[0])].ends.size())
      throw InputError(fmt::format("protocol '{}': protocols, stages and their ends cannot be added or taken away between steps; change their numbers", p.config->name));
  }
  load(state.history);
  world_.drives.load_history(state.history);
  for (const Protocol& p : protocols_)
    for (Drive& drive : world_.drives.all()) {
      const DriveAction* action = &drive.protocol() == p.config && !p.over ? drive.action(p.stage) : nullptr;
      if (action && (action->velocity || action->position || action->factor)) drive.begin_stage(p.stage, state.time);
    }
  store(state.history);
}

void ProtocolRun::store(History& history) const {
  for (const Protocol& p : protocols_) {
    HistoryArray now;
    now.values = {static_cast<double>(p.stage), p.over ? 1.0 : 0.0, p.begin, p.tries};
    now.values.insert(now.values.end(), p.repeats.begin(), p.repeats.end());
    now.values.insert(now.values.end(), p.last.begin(), p.last.end());
    now.values.insert(now.values.end(), p.largest.begin(), p.largest.end());
    history[history_name(*p.config)] = std::move(now);
    HistoryArray log;
    log.width = visit_width;
    for (const StageVisit& v : p.log)
      log.values.insert(log.values.end(), {static_cast<double>(v.number - 1), v.begin, v.end, static_cast<double>(v.cause), v.value, static_cast<double>(v.repeated)});
    if (!log.values.empty()) history[history_name(*p.config) + "/stages"] = std::move(log);
  }
  world_.drives.store(history);
}

void ProtocolRun::sample(const State& state) {
  values_ = probes_.sample(world_, state);
  if (contacts_) gaps_ = contacts_->sample(world_, state);
}

double ProtocolRun::value_of(const End& end) const {
  if (end.column >= 0) return values_[static_cast<size_t>(end.column)];
  return end.contact >= 0 ? gaps_[static_cast<size_t>(end.contact)] : std::nan("");
}

// Ends at a time are met by the size of the step (next_stop); a rate is met or not at the end of a
// step. Both are no matter of the search.
EndSearch::Excess ProtocolRun::excess(const Protocol& p, const End& end, double value, double largest, double last, double h, double t) const {
  const EndCondition& c = end.config;
  const auto bounded = [&](double g) -> EndSearch::Excess { return {std::isnan(g) ? -infinity : g, end.error}; };
  if (c.above) return bounded(value - c.above->si);
  if (c.below) return bounded(c.below->si - value);
  if (end.contact >= 0) return bounded(built_.experiment().contact->contact_distance - value);
  if (c.drop) return largest > 0 ? EndSearch::Excess{(1 - *c.drop) * largest - value, value_error * largest} : EndSearch::Excess{-infinity, 0};
  if (end.formula) {
    std::vector<double> arguments{t - p.begin};
    for (const int column : variable_columns_) arguments.push_back(values_[static_cast<size_t>(column)]);
    return {(*end.formula)(arguments) > 0 ? 0.0 : -infinity, 0};
  }
  // A step that was shortened to less than the tolerance of time says nothing about a rate.
  if (c.rate_below && h > p.time_tolerance && t > p.begin + h * (1 + round_off) && std::abs(value - last) < c.rate_below->si * h) return {0, infinity};
  return {-infinity, 0};
}

std::vector<EndSearch::Excess> ProtocolRun::excesses(double t, double h) const {
  std::vector<EndSearch::Excess> all;
  for (const Protocol& p : protocols_) {
    if (p.over) continue;
    for (size_t i = 0; i < ends(p).size(); ++i) {
      const End& end = ends(p)[i];
      const double value = value_of(end);
      all.push_back(excess(p, end, value, p.largest[i], p.last[i], h, t));
    }
  }
  return all;
}

void ProtocolRun::begin_step(double t) {
  step_begin_ = t;
  asked_ = 0;
  control_h_ = 0;
  std::vector<EndSearch::Excess> start;
  for (const Protocol& p : protocols_) {
    if (p.over) continue;
    for (size_t i = 0; i < ends(p).size(); ++i) {
      const End& end = ends(p)[i];
      // The values of a formula at the start are not kept: it counts as not met.
      start.push_back(end.formula || end.config.rate_below ? EndSearch::Excess{-infinity, 0} : excess(p, end, p.last[i], p.largest[i], p.last[i], 0, t));
    }
  }
  search_.begin(t, std::move(start));
}

std::optional<double> ProtocolRun::time_left(const Protocol& p, double t) const {
  std::optional<double> first;
  for (const End& end : ends(p))
    if (end.config.time && (!first || *end.config.time < *first)) first = end.config.time;
  if (!first) return first;
  return p.begin + *first - t;
}

double ProtocolRun::next_stop(double t) const {
  const double tolerance = round_off * built_.experiment().time.step;
  double stop = infinity;
  for (const Protocol& p : protocols_) {
    if (p.over) continue;
    if (const auto& step = p.config->stages[p.stage].step) stop = std::min(stop, t + *step);
    if (const auto left = time_left(p, t)) stop = std::min(stop, t + *left);
    if (const auto& longest = p.config->stages[p.stage].longest; longest && p.begin + *longest > t + tolerance) stop = std::min(stop, p.begin + *longest);
  }
  for (const Drive& drive : world_.drives.all()) {
    const double corner = drive.path().time + drive.path().duration;
    if (corner > t + tolerance && corner < stop) stop = corner;
  }
  return stop;
}

// Returns the drive under control, and its action; null: none.
Drive* ProtocolRun::controlled(const DriveAction** action) {
  if (!controls_) return nullptr;
  for (const Protocol& p : protocols_) {
    if (p.over) continue;
    for (Drive& drive : world_.drives.all())
      if (&drive.protocol() == p.config)
        if (const DriveAction* a = drive.action(p.stage); a && !a->control.empty()) {
          *action = a;
          return &drive;
        }
  }
  return nullptr;
}

void ProtocolRun::begin_try(double h) {
  const DriveAction* action = nullptr;
  Drive* drive = controlled(&action);
  if (!drive) return;
  if (control_h_ != h) {
    const double velocity = control_h_ > 0 ? control_.velocity() : drive->path().velocity, slope = control_h_ > 0 ? control_.slope() : drive->path().slope;
    const double tolerance = action->error ? action->error->si : value_error * std::abs(action->target->si);
    control_.begin(h, velocity, slope, action->speed->si, tolerance);
    control_h_ = h;
  }
  drive->try_velocity(control_.velocity());
}

std::optional<double> ProtocolRun::repetition(const State& state, double h) {
  sample(state);
  step_size_ = h;
  const auto count = [&] {
    for (Protocol& p : protocols_)
      if (!p.over) ++p.tries;
  };
  const DriveAction* action = nullptr;
  if (controlled(&action)) {
    const auto column = std::find(probes_.columns().begin(), probes_.columns().end(), action->control) - probes_.columns().begin();
    if (control_.next(values_[static_cast<size_t>(column)] - action->target->si)) {
      count();
      return h;
    }
  }
  const std::vector<EndSearch::Excess> excess = excesses(state.time, h);
  // A try that was cut back, so that it ends before the end that is looked for, is a step like others.
  if (asked_ > 0 && h < asked_ * (1 - round_off) && std::none_of(excess.begin(), excess.end(), [](const EndSearch::Excess& e) { return e.value >= 0; })) return std::nullopt;
  const std::optional<double> time = search_.next(state.time, excess);
  if (!time) return std::nullopt;
  count();
  asked_ = *time - step_begin_;
  return asked_;
}

void ProtocolRun::note_values(Protocol& p) {
  for (size_t i = 0; i < ends(p).size(); ++i) {
    p.last[i] = value_of(ends(p)[i]);
    if (std::isfinite(p.last[i])) p.largest[i] = std::max(p.largest[i], p.last[i]);
  }
}

void ProtocolRun::accept(State& state) {
  const DriveAction* action = nullptr;
  if (Drive* drive = controlled(&action)) {
    DrivePath path{drive->at(state.time), state.time, control_.velocity()};
    path.slope = control_.slope();
    drive->try_velocity(std::nullopt);
    drive->set(path);
  }
  const double tolerance = round_off * built_.experiment().time.step;
  int first = 0;  // index of the protocol's first end among those of all
  for (Protocol& p : protocols_) {
    if (p.over) continue;
    const int count = static_cast<int>(ends(p).size());
    int cause = search_.met() >= first && search_.met() < first + count ? search_.met() - first : -1;
    // Another end, of this or of another protocol, may be met by the same step.
    for (int i = 0; i < count && cause < 0; ++i) {
      const End& end = ends(p)[static_cast<size_t>(i)];
      if (end.config.time && state.time >= p.begin + *end.config.time - tolerance - 1e-10 * state.time) cause = i;
      else if (excess(p, end, value_of(end), p.largest[i], p.last[i], step_size_, state.time).value >= 0) cause = i;
    }
    first += count;
    note_values(p);
    if (cause >= 0) end_stage(p, cause, state.time);
  }
  store(state.history);
}

void ProtocolRun::end_stage(Protocol& p, int cause, double t) {
  const StageConfig& stage = p.config->stages[p.stage];
  const End& end = ends(p)[static_cast<size_t>(cause)];
  p.log.push_back({p.config->name, stage.name, p.stage + 1, p.begin, t, text_of(end.config, end.unit), value_of(end), static_cast<int>(p.tries), cause});
  int next = p.stage + 1;
  int& followed = p.repeats[p.stage];
  if (!stage.next.empty() && (!stage.repeat || followed < *stage.repeat)) {
    ++followed;
    next = stage.next == "end" ? static_cast<int>(p.config->stages.size()) : p.config->index_of(stage.next);
  } else {
    followed = 0;
  }
  begin_stage(p, next, t);
}

void ProtocolRun::begin_stage(Protocol& p, int stage, double t) {
  p.over = stage >= static_cast<int>(p.config->stages.size());
  if (!p.over) p.stage = stage;
  p.begin = t;
  p.tries = 0;
  for (Drive& drive : world_.drives.all())
    if (&drive.protocol() == p.config) drive.begin_stage(p.over ? -1 : stage, t);
  begin_values(p);
  if (p.over) return;
  if (const int at_once = end_at_once(ends(p)); at_once >= 0) end_stage(p, at_once, t);
}

void ProtocolRun::begin_values(Protocol& p) {
  p.last.assign(ends(p).size(), 0);
  p.largest.assign(ends(p).size(), -infinity);
  note_values(p);
}

bool ProtocolRun::finished() const {
  return std::all_of(protocols_.begin(), protocols_.end(), [](const Protocol& p) { return p.over; });
}

std::vector<StepMetric> ProtocolRun::metrics() const {
  std::vector<StepMetric> all;
  for (const Protocol& p : protocols_) all.push_back(stage_metric(*p.config, p.stage));
  return all;
}

// Returns what the stage waits for: "force was last 0.2 N, not above 0.5 N".
std::string ProtocolRun::missed(const Protocol& p) const {
  std::string text;
  for (size_t i = 0; i < ends(p).size(); ++i) {
    const End& end = ends(p)[i];
    if (!text.empty()) text += "; ";
    if (!end.config.probe.empty()) text += fmt::format("{} was last {}, and the stage ends with {}", end.config.probe, with_unit(p.last[i], end.unit), text_of(end.config, end.unit));
    else if (end.contact >= 0) text += fmt::format("the gap was last {}, and the stage ends with the {}", with_unit(p.last[i], end.unit), text_of(end.config, end.unit));
    else if (end.formula) {
      text += fmt::format("the stage ends when {}", end.config.when);
      for (size_t v = 1; v < variables_.size(); ++v)
        if (end.config.when.find(variables_[v]) != std::string::npos)
          text += fmt::format(", {} was last {}", variables_[v], with_unit(values_[static_cast<size_t>(variable_columns_[v - 1])], probes_.units()[static_cast<size_t>(variable_columns_[v - 1])]));
    } else text += fmt::format("the stage ends after {}", text_of(end.config, end.unit));
  }
  return text;
}

std::string ProtocolRun::fault(double t, bool over) const {
  const double tolerance = round_off * built_.experiment().time.step + 1e-10 * t;
  for (const Protocol& p : protocols_) {
    const StageConfig& stage = p.config->stages[p.stage];
    if (p.over || !stage.until) continue;
    const bool too_long = stage.longest && t >= p.begin + *stage.longest - tolerance;
    if (!too_long && !over) continue;
    return fmt::format("protocol '{}': stage '{}' began at {:.6g} s and has not ended {}: {}; {}", p.config->name, stage.name, p.begin,
                       too_long ? fmt::format("within {:.6g} s (longest)", *stage.longest) : fmt::format("when the run ends, at {:.6g} s", t), missed(p),
                       too_long ? "change its `until` or the direction of its drives, or raise `longest`" : "change its `until` or the direction of its drives, or raise time.duration");
  }
  return "";
}

std::vector<StageVisit> ProtocolRun::visits(double t) const {
  std::vector<StageVisit> all;
  for (const Protocol& p : protocols_) {
    all.insert(all.end(), p.log.begin(), p.log.end());
    if (!p.over) all.push_back({p.config->name, p.config->stages[p.stage].name, p.stage + 1, p.begin, t, "", std::nan(""), static_cast<int>(p.tries)});
  }
  return all;
}

int ProtocolRun::ended_stages() const {
  int count = 0;
  for (const Protocol& p : protocols_) count += static_cast<int>(p.log.size());
  return count;
}

std::string ProtocolRun::stages_text() const {
  std::string text;
  for (const Protocol& p : protocols_)
    text += fmt::format("{}{}: {}", text.empty() ? "" : ", ", p.config->name, p.over ? "end" : p.config->stages[p.stage].name);
  return text;
}

}  // namespace tack
