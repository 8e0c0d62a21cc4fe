#include "framework/output/output_config.hpp"

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/output/frame_fields.hpp"

namespace tack {
namespace {

// Returns "velocity [m/s], displacement [m] (from its placement in the scene), ...".
std::string described(bool of_elements) {
  std::string text;
  for (const FrameFieldInfo& info : frame_fields()) {
    if (info.of_elements != of_elements) continue;
    text += std::string(text.empty() ? "" : ", ") + info.name;
    if (!info.unit.empty()) text += " [" + info.unit + "]";
    if (!info.doc.empty()) text += " (" + info.doc + ")";
  }
  return text;
}

}  // namespace

void GradientConfig::fields(Fields& f) {
  f.text("key", key, "path of a number in the scene, as for --set: objects.plate.energies.0.young, contact.pairs.0.adhesion.peak_traction").required().line();
  f.text("as", as, "name in gradients.csv; its path unless given").line();
  f.optional_number("step", step, units::none, "finite-difference increment of the number, in SI; a millionth of it unless given; required if the "
                                               "number is zero").positive();
}

OutputConfig::OutputConfig() { formats.push_back(Registry<OutputFormat>::make("vtu")); }

void OutputConfig::fields(Fields& f) {
  f.flag("frames", frames, "write frames/*.vtu and run.pvd");
  f.number("frame_interval", frame_interval, units::time, "time between frames; 0: every step").nonnegative();
  f.number("frames_from", frames_from, units::time, "time of the first frame after the initial one, for short intervals about what matters").nonnegative();
  f.optional_number("checkpoint_interval", checkpoint_interval, units::time,
                    "simulated time between checkpoints, from which `tack run --resume` continues; none unless given")
      .positive();
  f.texts("fields", frame_fields, "fields in frames: " + described(false) + "; fields of elements, not a number where an object has none: " + described(true));
  f.component_list("formats", formats, "formats of the frames: vtu, and further ones that are made from the frames when the run ends, below its folder export");
  f.list("gradients", gradients, "scene parameters for sensitivities of every probe at every time: gradients.csv");
  f.check("formats", [this]() -> std::string {
    std::vector<std::string> types;
    for (const auto& format : formats) {
      const std::string type(format->type());
      if (std::find(types.begin(), types.end(), type) != types.end()) return "names '" + type + "' twice; take one of them away";
      types.push_back(type);
    }
    if (std::find(types.begin(), types.end(), "vtu") != types.end()) return "";
    return "expects vtu among them, because the others are made from these frames; add it, or write no frames at all by frames: false";
  });
  f.check("gradients", [this]() -> std::string {
    std::vector<std::string> names;
    for (const GradientConfig& g : gradients) {
      if (std::find(names.begin(), names.end(), g.name()) != names.end()) return "two of them are named '" + g.name() + "'; rename one of them (as)";
      names.push_back(g.name());
    }
    return "";
  });
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
