#include "framework/plot/plot_look.hpp"

namespace tack {

void PlotLook::fields(Fields& f) {
  f.text("title", title, "above the picture; unless given, what it is of").line();
  f.flag("untitled", untitled, "no title, as in papers, which have captions");
  f.text("x_label", x_label, "below its axis; its unit follows").line();
  f.text("y_label", y_label, "beside its axis; its unit follows").line();
  f.optional_number("width", width, units::length, "of the picture on paper: 85 mm is a column of many journals").above(0.01).at_most(2);
  f.optional_number("height", height, units::length, "likewise; unless given, two thirds of the width").above(0.01).at_most(2);
  f.optional_number("font_size", font_size, units::none, "in points; many journals ask for 7 or more").at_least(1).at_most(100);
  f.optional_number("line_width", line_width, units::none, "of curves, in points").positive().at_most(20);
  f.text("font", font, "its family").line();
  f.texts("colours", colours, "of CSS, `#0072B2`, for curves in their order; unless given, those that the colour-blind can tell apart");
  f.flag("legend", legend, "curves are named");
  f.flag("grid", grid, "lines at ticks");
  f.flag("pdf", pdf, "a PDF as well");
  f.check("colours", [this]() -> std::string {
    for (const std::string& colour : colours)
      if (colour.size() != 7 || colour[0] != '#' || colour.find_first_not_of("0123456789abcdefABCDEF", 1) != colour.npos) return "'" + colour + "' is no colour; write #RRGGBB";
    return "";
  });
  f.check("font", [this]() -> std::string { return font.find_first_of("'\",\\") == font.npos ? "" : "has a character that no family has"; });
}

}  // namespace tack
