#include "framework/stepping/energy_flows.hpp"

#include <algorithm>

namespace tack {

// Tangential adhesion and bonds count as friction in the total so far (the probe of energies).
EnergyFlows::EnergyFlows()
    : published{{"work_rim", FlowKind::within, ""},
                {"work_healing", FlowKind::fed, ""},
                {"dissipated_friction", FlowKind::dissipated, "dissipated_friction"},
                {"dissipated_adhesion", FlowKind::dissipated, "dissipated_friction"},
                {"dissipated_plastic", FlowKind::dissipated, "dissipated_plastic"},
                {"dissipated_damping", FlowKind::dissipated, "dissipated_damping"}} {}

EnergyFlows::EnergyFlows(const Records& records) : EnergyFlows() {
  for (const FlowRecord& record : records.flows())
    for (const FlowColumn& column : record.columns) amount(column.name, column.kind);
}

double EnergyFlows::of(std::string_view column) const {
  for (const Published& f : published)
    if (f.column == column) return f.amount;
  return 0;
}

double& EnergyFlows::amount(const std::string& column, FlowKind kind) {
  for (Published& f : published)
    if (f.column == column) return f.amount;
  const bool dissipates = kind == FlowKind::dissipated;
  const auto first_lost = std::find_if(published.begin(), published.end(), [](const Published& f) { return f.kind == FlowKind::dissipated; });
  return published.insert(dissipates ? published.end() : first_lost, {column, kind, dissipates ? column : ""})->amount;
}

double EnergyFlows::sum(FlowKind kind) const {
  double sum = 0;
  for (const Published& f : published)
    if (f.kind == kind) sum += f.amount;
  return sum;
}

EnergyFlows& EnergyFlows::operator+=(const EnergyFlows& o) {
  loads += o.loads, prescribed_motion += o.prescribed_motion, areas += o.areas, numerics += o.numerics;
  for (const Published& f : o.published) amount(f.column, f.kind) += f.amount;
  return *this;
}

}  // namespace tack
