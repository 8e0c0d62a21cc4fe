#include "framework/remesh/remesher.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "geometry/tets/mean_ratio.hpp"

namespace tack {
namespace {

constexpr double worse = 0.8;   // times what it was left with: it is tried again
constexpr double better = 1.1;  // times what it was: worth an exchange

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
    const std::string left = body.name + "/remesh";
    if (const auto* before = history_values(state.history, left, 1, 1); before && lowest >= worse * before->front()) continue;
    const auto& records = world.records.exchangeable();
    const auto old = std::find_if(records.begin(), records.end(), [&](const ExchangeableTets& r) { return r.body == body.name; });
    NewElements now = new_elements(i, body, *old, world.rest, state.x, config.goal);
    const bool helps = now.after >= better * now.before;
    state.history[left] = {1, {helps ? now.after : now.before}, {}};
    if (!helps || now.after < config.quality)
      warn({fmt::format("object '{}' at t = {:.6g} s: the worst of its tets, with a mean ratio of {:.2g}, {}: its surface stays as it is, and there a tet is no better "
                        "than its face; use finer or more even cells where the surface flows most, or a lower remesh.quality", body.name, state.time, now.before,
                        helps ? fmt::format("can only be brought to {:.2g}", now.after) : "cannot be exchanged for better ones"),
            "not remeshed"});
    if (helps) exchanged.push_back(std::move(now));
  }
  return exchanged;
}

}  // namespace tack
