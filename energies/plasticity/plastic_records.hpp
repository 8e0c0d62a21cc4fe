// What results show of terms that flow.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

// Adds the plastic work of a step to x [J] and the accumulated plastic strain of each stencil, which is read where it is.
void publish_plasticity(Records& records, const std::string& term, std::function<double(const VecX& x)> work,
                        const std::vector<double>& strain);
// The same, with the strain of each of some tets.
void publish_plasticity(Records& records, const std::string& term, std::function<double(const VecX& x)> work,
                        std::function<VecX()> strain, const std::vector<Tet>* tets);

}  // namespace tack
