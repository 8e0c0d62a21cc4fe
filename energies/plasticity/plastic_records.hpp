// Records of terms with plastic flow.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

// Dissipation of a step to x by plastic flow and by its viscosity [J]; `viscous` may be empty.
struct PlasticFlows {
  std::function<double(const VecX& x)> work;
  std::function<double(const VecX& x)> viscous = {};
};

// Publishes the flows and the accumulated plastic strain of each stencil. `strain` must outlive the
// records.
void publish_plasticity(Records& records, const std::string& term, PlasticFlows flows,
                        const std::vector<double>& strain);
// Publishes the flows and the accumulated plastic strain of each of `tets`.
void publish_plasticity(Records& records, const std::string& term, PlasticFlows flows,
                        std::function<VecX()> strain, const std::vector<Tet>* tets);

}  // namespace tack
