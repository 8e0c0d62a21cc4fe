// Output settings of a run: files and intervals.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/output/gradient_config.hpp"

namespace tack {

struct OutputConfig {
  double frame_interval = 0;  // s; 0: every step
  bool frames = true;
  std::optional<double> checkpoint_interval;  // s
  std::vector<std::string> frame_fields = {"velocity", "contact_force", "adhesion_force",
                                           "friction_force"};
  std::vector<GradientConfig> gradients;
  void fields(Fields& f);
};

}  // namespace tack
