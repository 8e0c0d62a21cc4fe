// laws.csv: the law of each adhesive pair in closed form, as the run computes it
// (framework/contact/laws/pair_law.hpp). Columns: pair (text), gap [m], traction [Pa] (positive:
// attraction), and the terms barrier and adhesion of the traction. For bonds under slow opening:
// opening in place of the gap, no barrier.
#pragma once

#include <filesystem>

namespace tack {

struct World;

// Writes the file, if the world has adhesion. Throws InputError if it cannot be written.
void write_laws(const std::filesystem::path& path, const World& world);

}  // namespace tack
