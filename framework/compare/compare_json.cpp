#include "framework/compare/compare_json.hpp"

#include <nlohmann/json.hpp>

#include "framework/output/provenance_json.hpp"

namespace tack {

std::string compare_json(const CompareConfig& config, const Comparison& comparison, const Provenance& provenance,
                         double wall_seconds) {
  using Json = nlohmann::ordered_json;
  Json references = Json::array();
  for (const ReferenceRow& r : comparison.references)
    references.push_back({{"problem", r.problem},
                          {"time_step", r.time_step},
                          {"unknowns", r.unknowns},
                          {"size", r.size},
                          {"tolerance", r.tolerance == 0 ? Json() : Json(r.tolerance)},
                          {"disagreement", r.disagreement},
                          {"floor", r.floor},
                          {"different_solutions", r.other_branch},
                          {"status", r.status}});
  const Json json = {{"name", config.name},
                     {"about", config.about},
                     {"provenance", to_json(provenance)},
                     {"repeat", config.repeat},
                     {"error_limit", config.error_limit.value_or(CompareConfig::error_limit_default)},
                     {"wall_seconds", wall_seconds},
                     {"references", references}};
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace tack
