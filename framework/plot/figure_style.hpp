// Style of plots: `tack plot --style FILE`, or its keys by --set.
#pragma once

#include <string>
#include <vector>

#include "framework/config/field.hpp"

namespace tack {

struct FigureStyle {
  std::string title, x_label, y_label;  // empty: those of the plot
  bool untitled = false;
  std::optional<double> width, height;          // m
  std::optional<double> font_size, line_width;  // pt
  std::string font = "Helvetica";
  std::vector<std::string> colours;  // CSS colours of the curves in order; empty: the default ones
  bool legend = true, grid = true, pdf = false;
  void fields(Fields& f);

  bool sized() const { return width || height || font_size; }
};

}  // namespace tack
