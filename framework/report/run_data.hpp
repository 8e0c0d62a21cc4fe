// What a page shows of one run, however far it came.
#pragma once

#include <filesystem>

#include "framework/report/frame_series.hpp"
#include "framework/report/page.hpp"

namespace tack {

// Keys: label, status (of summary.json; else "unfinished"), notes [text], summary (the file, or null), scene (scene_data.hpp) or null, steps, probes (number_table), laws
// (text_table), frames (frame_data) or null. What cannot be read is null, with a note that says why.
nlohmann::ordered_json run_data(const std::filesystem::path& folder, const std::string& label, int frames, PageData& page);

// {times, origin, lowest, highest, levels, vertices, positions, written, fields [{name, unit, magnitude, of, lowest, highest, levels, block}]}, and, unless
// they are known, the `elements` {triangles, edges, points, object}.
nlohmann::ordered_json frame_data(const FrameSeries& series, PageData& page, bool elements);

// Whole numbers below 2^24, as pages read them.
std::string number_bytes(const std::vector<int>& numbers);

}  // namespace tack
