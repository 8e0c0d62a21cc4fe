// Page data of one run, finished or not.
#pragma once

#include <filesystem>

#include "framework/report/frame_series.hpp"
#include "framework/report/page.hpp"

namespace tack {

// Returns the data of a run. Unreadable files are null, with a note. Keys:
//    label, notes [text]
//    status       of summary.json; else "unfinished"
//    summary      the file, or null
//    scene        scene_data.hpp, or null
//    steps, probes   number_table
//    laws         text_table
//    frames       frame_data, or null
nlohmann::ordered_json run_data(const std::filesystem::path& folder, const std::string& label,
                                int frames, PageData& page);

// Returns {times, origin, lowest, highest, levels, vertices, positions, written, fields [{name,
// unit, magnitude, of, lowest, highest, levels, block}]}; with `elements`, also {triangles, edges,
// points, object}.
nlohmann::ordered_json frame_data(const FrameSeries& series, PageData& page, bool elements);

// Returns the bytes of whole numbers below 2^24, as pages read them.
std::string number_bytes(const std::vector<int>& numbers);

}  // namespace tack
