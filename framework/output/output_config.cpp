#include "framework/output/output_config.hpp"

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/output/frame_fields.hpp"

namespace tack {
namespace {

// "velocity [m/s], displacement [m] (from where the scene puts it), ...".
std::string described(bool of_elements) {
  std::string text;
  for (const FrameFieldInfo& info : frame_fields()) {
    if (info.of_elements != of_elements) continue;
    text += std::string(text.empty() ? "" : ", ") + info.name;
    if (*info.unit) text += std::string(" [") + info.unit + "]";
    if (*info.doc) text += std::string(" (") + info.doc + ")";
  }
  return text;
}

}  // namespace

void OutputConfig::fields(Fields& f) {
  f.flag("frames", frames, "write frames/*.vtu and run.pvd");
  f.number("frame_interval", frame_interval, units::time, "time between frames; 0: every step").nonnegative();
  f.optional_number("checkpoint_interval", checkpoint_interval, units::time,
                    "simulated time between checkpoints, which `tack run --resume` goes on from; none unless given")
      .positive();
  f.texts("fields", frame_fields, "what frames hold: " + described(false) + "; and of elements, not a number where an object has none: " + described(true));
  f.check("fields", [this]() -> std::string {
    std::vector<std::string> names;
    for (const FrameFieldInfo& info : tack::frame_fields()) names.push_back(info.name);
    for (const std::string& field : frame_fields)
      if (std::find(names.begin(), names.end(), field) == names.end())
        return "unknown field '" + field + "'" + suggestion(field, names, "fields");
    return "";
  });
}

}  // namespace tack
