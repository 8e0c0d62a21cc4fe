#include "framework/remesh/remesher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry/tets/mean_ratio.hpp"

namespace tack {
namespace {

constexpr double retry_ratio = 0.8;        // of the mean ratio after the last attempt, below which the next one is made
constexpr double improvement_ratio = 1.1;  // smallest ratio of mean ratios for which tets are exchanged

double lowest_mean_ratio(const std::vector<Tet>& tets, const VecX& x) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Tet& t : tets) lowest = std::min(lowest, mean_ratio(t, x));
  return lowest;
}

}  // namespace

Remesher::Remesher(const SceneConfig& scene) : scene_(scene) {
  for (size_t i = 0; i < scene.objects.size(); ++i)
    if (scene.objects[i].remesh) objects_.push_back(static_cast<int>(i));
}

std::vector<NewElements> Remesher::exchange(const World& world, State& state, const WarningFunction& warn) const {
  std::vector<NewElements> exchanged;
  for (const int i : objects_) {
    const RemeshConfig& config = *scene_.objects[i].remesh;
    const Body& body = world.bodies[i];
    const double lowest = lowest_mean_ratio(body.tets, state.x);
    if (lowest >= config.quality) continue;
    const std::string history_name = body.name + "/remesh";
    if (const auto* before = history_values(state.history, history_name, 1, 1); before && lowest >= retry_ratio * before->front()) continue;
    const auto& records = world.records.exchangeable();
    const auto old = std::find_if(records.begin(), records.end(), [&](const ExchangeableTets& r) { return r.body == body.name; });
    NewElements now = new_elements(i, body, *old, world.rest, state.x, config.goal);
    const bool helps = now.after >= improvement_ratio * now.before;
    state.history[history_name] = {1, {helps ? now.after : now.before}, {}};
    if (!helps || now.after < config.quality)
      warn({WarningKind::not_remeshed, fmt::format("object '{}' at t = {:.6g} s: the worst of its tets, with a mean ratio of {:.2g}, {}: its surface stays as it is, and there a tet is no better "
                        "than its face; use finer or more even cells where the surface flows most, or a lower remesh.quality", body.name, state.time, now.before,
                        helps ? fmt::format("can only be brought to {:.2g}", now.after) : "cannot be exchanged for better ones"),
            });
    if (helps) exchanged.push_back(std::move(now));
  }
  return exchanged;
}

}  // namespace tack
