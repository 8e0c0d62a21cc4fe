#include "framework/core/step_filter.hpp"

#include "framework/config/bind.hpp"

namespace tack {

StepFilters default_step_filters() {
  StepFilters filters;
  for (const char* name : {"ccd", "inversion"}) filters.emplace_back(Registry<StepFilter>::make(name));
  return filters;
}

std::vector<std::unique_ptr<StepFilter>> attached_filters(const FeasibilityContext& context, const StepFilters& settings) {
  std::vector<std::unique_ptr<StepFilter>> filters;
  for (const auto& setting : settings) {
    auto filter = instance_of(*setting);
    if (filter->attach(context)) filters.push_back(std::move(filter));
  }
  return filters;
}

}  // namespace tack
