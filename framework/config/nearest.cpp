#include "framework/config/nearest.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace tack {
namespace {

// A key by its name in other programs and papers (`foreign`) and in scenes (`key`).
struct ForeignName {
  std::string_view foreign, key;
};
constexpr ForeignName foreign_names[] = {
    {"dt", "step"}, {"h", "step"}, {"timestep", "step"}, {"time_step", "step"}, {"t_end", "duration"}, {"end_time", "duration"},
    {"e", "young"}, {"youngs_modulus", "young"}, {"young_modulus", "young"}, {"elastic_modulus", "young"}, {"shear_modulus", "young"}, {"lambda", "young"}, {"mu", "young"},
    {"nu", "poisson"}, {"poissons_ratio", "poisson"}, {"poisson_ratio", "poisson"}, {"rho", "density"},
    {"dhat", "distance"}, {"d_hat", "distance"}, {"contact_distance", "distance"}, {"kappa", "stiffness"}, {"kappa", "barrier"}, {"mu", "friction"},
    {"tol", "tolerance"}, {"max_iter", "max_iterations"}, {"backward_euler", "implicit_euler"}, {"newton", "projected_newton"},
    {"friction_coefficient", "mu"}, {"coefficient", "mu"}, {"epsv", "eps_v"}, {"v0", "velocity"}, {"initial_velocity", "velocity"},
    {"omega", "spin"}, {"angular_velocity", "spin"}, {"position", "place"}, {"transform", "place"}, {"material", "energies"},
    {"materials", "energies"}, {"mesh", "shape"}, {"geometry", "shape"}, {"boundary_conditions", "motion"}, {"dirichlet", "motion"},
};

// Returns our name for a name of other programs, if it is among `names`; "" otherwise.
std::string key_of_foreign_name(std::string_view word, const std::vector<std::string>& names) {
  std::string lower(word);
  for (char& c : lower) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  for (const auto& [foreign, key] : foreign_names)
    if (lower == foreign && std::find(names.begin(), names.end(), key) != names.end()) return std::string(key);
  return "";
}

}  // namespace

int edit_distance(std::string_view a, std::string_view b) {
  const std::size_t n = b.size() + 1;
  std::vector<int> d((a.size() + 1) * n);  // d[i * n + j]: first i of a against first j of b
  for (std::size_t i = 0; i <= a.size(); ++i) d[i * n] = static_cast<int>(i);
  for (std::size_t j = 0; j < n; ++j) d[j] = static_cast<int>(j);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j < n; ++j) {
      const int replace = d[(i - 1) * n + j - 1] + (a[i - 1] != b[j - 1]);
      int best = std::min({d[(i - 1) * n + j] + 1, d[i * n + j - 1] + 1, replace});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) best = std::min(best, d[(i - 2) * n + j - 2] + 1);
      d[i * n + j] = best;
    }
  }
  return d.back();
}

std::string nearest(std::string_view word, const std::vector<std::string>& names) {
  int best = word.size() < 4 ? 1 : std::max(2, static_cast<int>(word.size()) / 2);  // further away it is a different word
  std::string found;
  for (const std::string& name : names) {
    const int distance = edit_distance(word, name);
    const bool nothing_shared = distance >= static_cast<int>(std::max(word.size(), name.size()));
    if (distance > best || nothing_shared || (distance == best && !found.empty())) continue;
    best = distance;
    found = name;
  }
  for (const std::string& name : names) {
    if (found.empty() && word.size() > 2 && name.find(word) != name.npos) found = name;
  }
  return found;
}

std::string suggestion(std::string_view word, const std::vector<std::string>& names,
                       std::string_view label) {
  if (names.empty()) return fmt::format("; there are no {}", label);
  std::string near = key_of_foreign_name(word, names);
  if (near.empty()) near = nearest(word, names);
  const std::string list = fmt::format(" ({}: {})", label, fmt::join(names, ", "));
  return near.empty() ? list : fmt::format("; did you mean '{}'?{}", near, list);
}

}  // namespace tack
