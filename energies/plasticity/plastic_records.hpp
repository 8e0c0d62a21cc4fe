// What results show of terms that flow.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

// Of a step to x, what plastic flow takes, and what its viscosity does beside it: none where there is none [J].
struct PlasticFlows {
  std::function<double(const VecX& x)> work;
  std::function<double(const VecX& x)> viscous = {};
};

// Adds them and the accumulated plastic strain of each stencil, which is read where it is.
void publish_plasticity(Records& records, const std::string& term, PlasticFlows flows, const std::vector<double>& strain);
// The same, with the strain of each of some tets.
void publish_plasticity(Records& records, const std::string& term, PlasticFlows flows, std::function<VecX()> strain,
                        const std::vector<Tet>* tets);

}  // namespace tack
