// What a page shows of one run, however far it came.
#pragma once

#include <filesystem>

#include "framework/report/page.hpp"

namespace tack {

// Keys: label, status (of summary.json; else "unfinished"), notes [text], summary (the file, or null), scene {name, about, text, up,
// objects [{name, radius}], probes [{column, type, unit, on, from, between}], expect [name]} or null, steps, probes (number_table), laws
// (text_table), frames {times, origin, lowest, highest, vertices, triangles, edges, points, object, positions, written,
// fields [{name, unit, magnitude, of, lowest, highest, levels, block}]} or null. What cannot be read is null, with a note that
// says why.
nlohmann::ordered_json run_data(const std::filesystem::path& folder, const std::string& label, int frames, PageData& page);

}  // namespace tack
