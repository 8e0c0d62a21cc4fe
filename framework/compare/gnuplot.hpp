// Plots by gnuplot, run as a program of its own: each from one script that holds its data, which is kept
// beside the pictures to draw them again or otherwise.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace tack {

struct Curve {
  std::string title;
  std::vector<std::pair<double, double>> points;
};

struct Plot {
  std::string title, x_label, y_label;
  bool log_x = false, log_y = false;
  bool steps = false;  // curves are stairs, else lines with points
  std::vector<Curve> curves;
};

// Writes folder/name.gp, and name.svg and name.png by it. "" or why there are no pictures. Throws InputError
// when the script cannot be written.
std::string draw(const Plot& plot, const std::filesystem::path& folder, const std::string& name);

}  // namespace tack
