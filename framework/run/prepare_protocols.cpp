// Preparation of the protocols of a run: the ends of their stages against the probes of the scene, and what
// is under control.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <map>

#include "framework/config/bind.hpp"
#include "framework/config/nearest.hpp"
#include "framework/run/protocol_run.hpp"
#include "framework/run/stage_ends.hpp"
#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool is_variable(const std::string& name) {
  if (name.empty() || name == "t" || name == "pi" || std::isdigit(static_cast<unsigned char>(name.front()))) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_'); });
}

void check_unit(const std::optional<Quantity>& quantity, const Unit& unit, const char* key) {
  if (!quantity) return;
  try {
    quantity->check(unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{}: {}", key, error.what()));
  }
}

// Checks a change per second. A unit that the tables of units cannot divide is not checked.
void check_rate_unit(const std::optional<Quantity>& quantity, const Unit& unit) {
  if (!quantity || quantity->written.empty()) return;
  const std::string per_second = unit.plain() ? "1/s" : fmt::format("{}/s", unit.si);
  std::map<std::string, int> dimension;
  try {
    dimension = base_dimension(per_second);
  } catch (const InputError&) {
    return;
  }
  quantity->check({per_second, "change per second"});
}

}  // namespace

void ProtocolRun::prepare(const Value& root) {
  const Experiment& e = built_.experiment();
  const auto at_protocols = [&](const auto& check) { with_source_location(root.find("protocols"), check); };
  at_protocols([&] {
    if (!e.output.gradients.empty()) throw InputError("output.gradients do not know the times at which stages end; take the gradients or the protocols away");
    if (e.time.stepper->type() == std::string("path_following")) throw InputError("the stepper path_following finds the load of a step itself; take it or the protocols away");
  });
  variables_ = {"t"};
  for (size_t i = 0; i < probes_.columns().size(); ++i)
    if (is_variable(probes_.columns()[i])) variables_.push_back(probes_.columns()[i]), variable_columns_.push_back(static_cast<int>(i));
  double tolerance = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < e.protocols.size(); ++i) {
    const ProtocolConfig& config = e.protocols[i];
    with_source_location(entry_of(root.find("protocols"), i), [&] {
      for (size_t j = 0; j < i; ++j)
        if (e.protocols[j].name == config.name) throw InputError(fmt::format("two protocols are named '{}'", config.name));
      Protocol& p = protocols_.emplace_back();
      p.config = &config;
      p.time_tolerance = config.time_tolerance.value_or(time_tolerance * e.time.step);
      tolerance = std::min(tolerance, p.time_tolerance);
      p.repeats.resize(config.stages.size(), 0);
      for (const StageConfig& stage : config.stages) {
        Stage& made = p.stages.emplace_back();
        for (const EndCondition& end : stage.ends()) prepare_end(end, stage, config, made.ends.emplace_back());
        int controls = 0;
        for (const auto& [name, action] : stage.drive) {
          if (action.control.empty()) continue;
          ++controls;
          const auto found = std::find(probes_.columns().begin(), probes_.columns().end(), action.control);
          const std::string where = fmt::format("protocol '{}', stage '{}', drive '{}'", config.name, stage.name, name);
          if (found == probes_.columns().end())
            throw InputError(fmt::format("{}: control: no probe has the column '{}'{}", where, action.control, suggestion(action.control, probes_.columns(), "probes")));
          const Unit& unit = probes_.units()[static_cast<size_t>(found - probes_.columns().begin())];
          try {
            check_unit(action.target, unit, "target");
            check_unit(action.error, unit, "tolerance");
          } catch (const InputError& error) {
            throw InputError(fmt::format("{}: {}", where, error.what()));
          }
          controls_ = true;
        }
        if (controls > 1) throw InputError(fmt::format("protocol '{}', stage '{}': two drives are under control; one may be", config.name, stage.name));
      }
    });
  }
  int controlling = 0;
  for (const ProtocolConfig& config : e.protocols)
    controlling += std::any_of(config.stages.begin(), config.stages.end(), [](const StageConfig& s) {
      return std::any_of(s.drive.begin(), s.drive.end(), [](const auto& drive) { return !drive.second.control.empty(); });
    });
  at_protocols([&] {
    if (controlling > 1) throw InputError("two protocols have drives under control; one may have");
  });
  search_ = EndSearch(tolerance);
  if (contact_specs_.empty()) return;
  contacts_.emplace(contact_specs_, Value(), world_);
}

void ProtocolRun::prepare_end(const EndCondition& config, const StageConfig& stage, const ProtocolConfig& protocol, End& end) {
  end.config = config;
  try {
    if (!config.probe.empty()) {
      const auto found = std::find(probes_.columns().begin(), probes_.columns().end(), config.probe);
      if (found == probes_.columns().end()) throw InputError(fmt::format("no probe has the column '{}'{}", config.probe, suggestion(config.probe, probes_.columns(), "probes")));
      end.column = static_cast<int>(found - probes_.columns().begin());
      end.unit = probes_.units()[static_cast<size_t>(end.column)];
      for (const auto& [quantity, key] : {std::pair{&config.above, "above"}, {&config.below, "below"}, {&config.within, "within"}}) check_unit(*quantity, end.unit, key);
      check_rate_unit(config.rate_below, end.unit);
      const double limit = config.above ? config.above->si : config.below ? config.below->si : 0;
      end.error = config.within ? config.within->si : value_error * std::abs(limit);
    }
    if (!config.contact.empty()) {
      if (!built_.experiment().contact) throw InputError("contact: the scene has none; give it a contact section");
      Value spec = Value::map(), between = Value::sequence();
      for (const std::string& object : config.contact) between.items.push_back(Value::scalar(object));
      end.contact = static_cast<int>(contact_specs_.size());
      spec.set("type", Value::scalar("gap"));
      spec.set("name", Value::scalar(fmt::format("contact {}", end.contact)));
      spec.set("between", between);
      for (const std::string& object : config.contact) world_.index_of(object, "contact: ");
      contact_specs_.push_back(bind_component<Probe>(spec));
      end.error = contact_error * built_.experiment().contact->contact_distance;
      end.unit = units::length;
    }
    if (!config.when.empty()) end.formula.emplace(config.when, variables_);
  } catch (const InputError& error) {
    throw InputError(fmt::format("protocol '{}', stage '{}', until: {}", protocol.name, stage.name, error.what()));
  }
}

}  // namespace tack
