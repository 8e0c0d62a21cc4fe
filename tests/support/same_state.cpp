#include "tests/support/same_state.hpp"

#include <fmt/format.h>
#include <utility>

namespace tack {

std::string first_difference(const State& a, const State& b) {
  if (a.time != b.time || a.step != b.step || a.h_before != b.h_before || a.step_size.h_next != b.step_size.h_next) return "steps";
  for (const auto& [name, field] : {std::pair{"x", &State::x}, {"v", &State::v}, {"a", &State::a}, {"contact", &State::contact},
                                    {"contact_before", &State::contact_before}, {"x_before", &State::x_before}, {"v_before", &State::v_before}})
    if (a.*field != b.*field) return fmt::format("{} by {}", name, (a.*field).size() == (b.*field).size() ? (a.*field - b.*field).lpNorm<Eigen::Infinity>() : -1);
  for (const auto& [name, array] : a.history)
    if (!b.history.contains(name) || b.history.at(name) != array) return "history " + name;
  return a.history.size() == b.history.size() ? "" : "histories";
}

}  // namespace tack
