// Draws by gnuplot, run as a program of its own: each picture from one script that holds its data, which is kept
// beside the pictures to draw them again or otherwise.
//
// Curves are told apart by colour (Okabe and Ito's, which colour-blind readers can tell apart) and by dashes and marks at once: 28
// combinations. Where all of them end at the right and there is room, their names stand there; else in a key.
#pragma once

#include <filesystem>

#include "framework/plot/plot.hpp"
#include "framework/plot/plot_look.hpp"

namespace tack {

// Writes folder/name.gp, and name.svg and name.png, if asked name.pdf, by it. "" or why there are no pictures. Throws InputError
// when the script cannot be written.
std::string draw(const Plot& plot, const std::filesystem::path& folder, const std::string& name, const PlotLook& look = {});
std::string draw(const StackedBars& bars, const std::filesystem::path& folder, const std::string& name, const PlotLook& look = {});

// Runs a script that is there. "" or what is wrong.
std::string draw_script(const std::filesystem::path& folder, const std::string& name);

}  // namespace tack
