// Records of terms with plastic flow.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

// Energies that plastic flow and its viscosity dissipate in a step to x [J]; no entry without viscosity.
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
