// Output settings of a run: files and intervals.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/output/gradient_config.hpp"
#include "framework/output/output_format.hpp"

namespace tack {

struct OutputConfig {
  OutputConfig();
  double frame_interval = 0;  // s; 0: every step
  double frames_from = 0;     // s, the first frame after the initial one
  bool frames = true;
  std::optional<double> checkpoint_interval;  // s
  std::vector<std::string> frame_fields = {"velocity", "contact_force", "adhesion_force",
                                           "friction_force"};
  std::vector<std::unique_ptr<OutputFormat>> formats;  // vtu, and what is made from it at the end
  std::vector<GradientConfig> gradients;
  void fields(Fields& f);
};

}  // namespace tack
