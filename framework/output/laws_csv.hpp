// laws.csv: the closed form of each adhesive pair's law, as the run computes it (framework/contact/pair_law.hpp). Columns: pair
// (text), gap [m], traction [Pa], positive where the sides attract, and what barrier and adhesion have in it; of bonds, parted slowly, the opening in
// place of the gap, and no barrier.
#pragma once

#include <filesystem>

namespace tack {

struct World;

// Nothing is written without adhesion. Throws InputError when the file cannot be written.
void write_laws(const std::filesystem::path& path, const World& world);

}  // namespace tack
