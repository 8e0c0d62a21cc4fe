// tack render: pictures and films of runs, rendered in a headless browser by report/render.mjs.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/report/render_view.hpp"

namespace tack {

struct RenderSettings {
  std::vector<std::filesystem::path> folders;  // of runs, side by side
  std::filesystem::path output;  // ends in .png, .mp4 or .gif; "%04d": numbered pictures
  bool with_blender = false;     // by Cycles, the path tracer of Blender
  bool quiet = false;
  std::string version, commit;  // of the program
};

// Throws InputError for a missing run, an unknown ending, a view that does not fit the runs, and
// missing node, browser or ffmpeg.
void render(const RenderSettings& settings, const RenderView& view);

}  // namespace tack
