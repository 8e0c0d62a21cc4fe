#include "framework/plot/figure_style.hpp"

namespace tack {

void FigureStyle::fields(Fields& f) {
  f.text("title", title, "title above the picture; its content unless given").line();
  f.flag("untitled", untitled, "no title, for papers with captions");
  f.text("x_label", x_label, "label of the x axis; the unit is appended").line();
  f.text("y_label", y_label, "label of the y axis; the unit is appended").line();
  f.optional_number("width", width, units::length, "width of the picture on paper: 85 mm is a column of many journals").above(0.01).at_most(2);
  f.optional_number("height", height, units::length, "height of the picture on paper; two thirds of the width unless given").above(0.01).at_most(2);
  f.optional_number("font_size", font_size, units::none, "font size in points; many journals require 7 or more").at_least(1).at_most(100);
  f.optional_number("line_width", line_width, units::none, "line width of curves in points").positive().at_most(20);
  f.text("font", font, "font family").line();
  f.texts("colours", colours, "CSS colours, `#0072B2`, of curves in order; a palette for the colour-blind unless given");
  f.flag("legend", legend, "draw a legend");
  f.flag("grid", grid, "draw grid lines at ticks");
  f.flag("pdf", pdf, "also write a PDF");
  f.check("colours", [this]() -> std::string {
    for (const std::string& colour : colours)
      if (colour.size() != 7 || colour[0] != '#' || colour.find_first_not_of("0123456789abcdefABCDEF", 1) != colour.npos) return "'" + colour + "' is no colour; write #RRGGBB";
    return "";
  });
  f.check("font", [this]() -> std::string { return font.find_first_of("'\",\\") == font.npos ? "" : "has a character that no family has"; });
}

}  // namespace tack
