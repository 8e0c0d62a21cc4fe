#include "framework/core/records.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/core/published_field.hpp"
#include "framework/core/term_gradient.hpp"

namespace tack {
namespace {

// Replaces the first record of the name and erases the others. Calls drop(record) for each old record.
template <class Record, class Drop>
void replace_named(std::vector<Record>& records, Record record, const char* kind, const Drop& drop) {
  const auto named = [&](const Record& r) { return r.name == record.name; };
  const auto first = std::find_if(records.begin(), records.end(), named);
  if (first == records.end()) throw std::logic_error(fmt::format("no term publishes {} named '{}', which could be replaced", kind, record.name));
  const auto at = first - records.begin();
  for (const Record& r : records)
    if (named(r)) drop(r);
  std::erase_if(records, named);
  records.insert(records.begin() + at, std::move(record));
}

}  // namespace

bool ForceRecord::has(std::string_view summand) const { return summand.empty() || std::find(summands.begin(), summands.end(), summand) != summands.end(); }

void FieldRecord::combine(double value, double& with) const {
  if (std::isnan(with)) with = value;
  else if (!std::isnan(value)) with = summed ? with + value : std::max(with, value);
}

void Records::publish(const Term& term) {
  publisher_ = &term;
  term.publish(*this);
  publisher_ = nullptr;
}

void Records::add(ForceRecord record) {
  record.term = publisher_;
  if (!record.add) {
    if (!publisher_) throw std::logic_error(fmt::format("the force '{}' has neither a term nor a function that adds it", record.name));
    record.add = [term = publisher_](const VecX& x, std::string_view, VecX& forces) {
      VecX gradient = VecX::Zero(x.size());
      add_term_gradient(*term, x, gradient);
      forces -= gradient;
    };
  }
  forces_.push_back(std::move(record));
}

void Records::add(EnergyRecord record) {
  record.term = publisher_;
  // The last ones are those of the publisher.
  for (auto other = energies_.rbegin(); publisher_ && other != energies_.rend() && other->term == publisher_; ++other)
    if (other->kind != record.kind)
      throw std::logic_error(fmt::format("the energies '{}' and '{}' of one term have different kinds", other->name, record.name));
  energies_.push_back(std::move(record));
}

void Records::add(FlowRecord record) {
  for (const FlowColumn& column : record.columns) {
    const char* prefix = column.kind == FlowKind::dissipated ? "dissipated_" : "work_";
    if (!column.name.starts_with(prefix))
      throw std::logic_error(fmt::format("the flow '{}' of '{}' does not begin with '{}'", column.name, record.name, prefix));
  }
  record.term = publisher_;
  flows_.push_back(std::move(record));
}

void Records::add(FieldRecord record) {
  const auto& registered = Registry<PublishedField>::kind().entries();
  if (!registered.contains(record.name))
    throw std::logic_error(fmt::format("the field '{}' is published and not registered (core/published_field.hpp)", record.name));
  record.term = publisher_;
  fields_.push_back(std::move(record));
}

void Records::add(StressRecord record) {
  record.term = publisher_;
  stresses_.push_back(std::move(record));
}

void Records::replace(ForceRecord record) {
  record.term = nullptr;
  replace_named(forces_, std::move(record), "a force", [&](const ForceRecord& r) {
    if (r.term && !replaced(*r.term)) replaced_.push_back(r.term);
  });
}

void Records::replace(EnergyRecord record) {
  record.term = nullptr;
  replace_named(energies_, std::move(record), "an energy", [](const EnergyRecord&) {});
}

void Records::replace(FlowRecord record) {
  record.term = nullptr;
  replace_named(flows_, std::move(record), "flows", [](const FlowRecord&) {});
}

void Records::remove_forces(const std::string& name) {
  for (const ForceRecord& r : forces_)
    if (r.name == name && r.term && !replaced(*r.term)) replaced_.push_back(r.term);
  std::erase_if(forces_, [&](const ForceRecord& r) { return r.name == name; });
}

void Records::add_forces(ForceDirection direction, const VecX& x, std::string_view summand, VecX& forces) const {
  for (const ForceRecord& r : forces_)
    if (r.direction == direction && r.has(summand)) r.add(x, summand, forces);
}

bool Records::has_forces(ForceDirection direction) const {
  return std::any_of(forces_.begin(), forces_.end(), [&](const ForceRecord& r) { return r.direction == direction; });
}

bool Records::replaced(const Term& term) const { return std::find(replaced_.begin(), replaced_.end(), &term) != replaced_.end(); }

}  // namespace tack
