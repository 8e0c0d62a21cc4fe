// Draws plots with gnuplot as a child process: one script per picture, with its data, kept beside
// the pictures for redrawing.
//
// Curves differ in colour (Okabe and Ito's palette for colour-blind readers) and in dashes and
// marks: 28 combinations. Curve names stand at the right ends of the curves if all curves end there
// and the names fit; else in a key.
#pragma once

#include <filesystem>

#include "framework/plot/plot.hpp"
#include "framework/plot/figure_style.hpp"

namespace tack {

// Writes folder/name.gp, and with it name.svg, name.png and, if `style` requests it, name.pdf.
// Returns "" or the reason why there are no pictures. Throws InputError if the script cannot be
// written.
std::string draw(const Plot& plot, const std::filesystem::path& folder, const std::string& name,
                 const FigureStyle& style = {});
std::string draw(const StackedBars& bars, const std::filesystem::path& folder,
                 const std::string& name, const FigureStyle& style = {});

// Runs an existing script. Returns "" or an error message.
std::string draw_script(const std::filesystem::path& folder, const std::string& name);

}  // namespace tack
