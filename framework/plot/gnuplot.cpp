#include "framework/plot/gnuplot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "framework/plot/axis_unit.hpp"
#include "geometry/io/replace_file.hpp"
#include "geometry/run_program.hpp"
#include "geometry/utf8_prefix.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr std::array<const char*, 14> colours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000",
                                                "#882255", "#999933", "#332288", "#117733", "#AA4499", "#661100", "#888888"};
constexpr std::array<const char*, 4> dashes = {"1", "(8,4)", "(2,3)", "(9,3,2,3)"};
constexpr std::array<int, 6> marks = {7, 5, 9, 11, 13, 6};
constexpr size_t label_count_max = 12;   // at the ends of curves
constexpr double label_distance = 0.05;  // of the picture's height
// Least end of a curve with a label, of the picture's width.
constexpr double label_end_min = 0.85;
constexpr size_t label_length_max = 34;  // bytes
// Largest ratio of the range of a logarithmic axis, margins included, without decades as ticks.
constexpr double ratio_without_decades_max = 80;
constexpr double bar_width = 0.75, bar_mark_width = 0.9;  // of the distance of bars
constexpr size_t legend_beside_max = 16;  // names of a legend
// Characters: beside the picture, and in rows below it.
constexpr size_t beside_length_max = 34, two_column_length_max = 46, three_column_length_max = 16;
// Pixels, 96 per inch.
constexpr double plain_width = 720, wide_width = 900, plain_height = 480, plain_font = 13;
// Heights of a line of text, and of ticks and label, for plain_font.
constexpr double row_height = 20, axis_height = 64;
constexpr double dots_per_inch = 96, dots_of_papers = 600, points_per_inch = 72;

// Replaces control characters, which a picture cannot show.
std::string printable(std::string text) {
  for (char& c : text)
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = ' ';
  return text;
}

// Quotes a text for gnuplot. In single quotes only the quote and the end of the line are special;
// the latter also ends the command, so that the rest would be executed. A quote is concatenated as
// a string of its own: gnuplot misreads a doubled quote at the beginning of a text.
std::string in_quotes(const std::string& text) {
  std::string out = "'";
  for (const char c : printable(text)) out += c == '\'' ? std::string(R"('."'".')") : std::string(1, c);
  return out + "'";
}

bool drawable(const Plot& plot, const std::pair<double, double>& point) {
  const auto [x, y] = point;
  return std::isfinite(x) && std::isfinite(y) && !(plot.log_x && x <= 0) && !(plot.log_y && y <= 0);
}

constexpr size_t band_titles_max = 12;
constexpr double band_letter = 0.6;  // width of a letter, over the size of the font
// Fraction of a picture's width and height that its axes enclose, and the largest fraction of the
// axes' height that titles of bands take from the curves.
constexpr double axes_share = 0.8, band_titles_max_height = 0.4;

bool drawable(const Plot& plot, const Curve& curve) {
  return std::any_of(curve.points.begin(), curve.points.end(), [&](const auto& p) { return drawable(plot, p); });
}

// Scales the data to prefixed units; axes with powers of ten as ticks keep their unit.
Plot scaled(Plot plot) {
  std::vector<double> xs, ys;
  for (const Curve& c : plot.curves)
    for (const auto& p : c.points)
      if (drawable(plot, p)) xs.push_back(std::abs(p.first)), ys.push_back(std::abs(p.second));
  const auto of = [](const std::vector<double>& sizes, const std::string& unit, bool log) {
    if (unit.empty() || sizes.empty()) return AxisUnit{};
    const auto [least, most] = std::minmax_element(sizes.begin(), sizes.end());
    return axis_unit(log && *most > ratio_without_decades_max * *least ? 1 : *most, unit);
  };
  const AxisUnit along = of(xs, plot.x_unit, plot.log_x), up = of(ys, plot.y_unit, plot.log_y);
  plot.x_label = axis_label(plot.x_label, along.text);
  plot.y_label = axis_label(plot.y_label, up.text);
  for (Curve& c : plot.curves) {
    for (auto& [a, b] : c.points) a *= along.factor, b *= up.factor;
    for (auto& [low, high] : c.spread) low *= up.factor, high *= up.factor;
  }
  for (LevelLine& l : plot.levels) l.at *= up.factor;
  for (LevelLine& l : plot.verticals) l.at *= along.factor;
  for (Band& b : plot.bands) b.low *= along.factor, b.high *= along.factor;
  return plot;
}

std::string data_block(const Plot& plot, const Curve& curve, size_t i) {
  std::string out = fmt::format("$curve{} << END\n", i);
  for (size_t k = 0; k < curve.points.size(); ++k) {
    const auto& [x, y] = curve.points[k];
    if (std::isnan(x)) out += "\n";
    if (!drawable(plot, curve.points[k])) continue;
    const auto [low, high] = k < curve.spread.size() ? curve.spread[k] : std::pair(y, y);
    out += fmt::format("{} {} {} {}\n", x, y, plot.log_y && low <= 0 ? y : low, high);
  }
  return out + "END\n";
}

std::string colour_of(size_t i, const FigureStyle& style) {
  return style.colours.empty() ? colours[i % colours.size()] : style.colours[i % style.colours.size()];
}

// Line widths are in points; gnuplot draws a width of 1 with 0.75 points in SVG.
std::string style_of(size_t i, const FigureStyle& style) {
  return fmt::format("lc rgb '{}' dt {} lw {}", colour_of(i, style), dashes[i % dashes.size()], style.line_width ? *style.line_width / 0.75 : 2);
}

// Layout of a picture, in pixels.
struct Sheet {
  double width, height, font;
  double row() const { return row_height * font / plain_font; }
  double axis() const { return axis_height * font / plain_font; }
};

// Returns the size of a picture. Without a size in `style`: wide if its names need it, and higher by
// `below`, the space under the plot.
Sheet sheet_of(const FigureStyle& style, bool wide, double below) {
  const double pixels = dots_per_inch / 0.0254;
  Sheet sheet{wide ? wide_width : plain_width, plain_height + below, style.font_size ? *style.font_size * dots_per_inch / points_per_inch : plain_font};
  if (style.width) sheet.width = *style.width * pixels, sheet.height = sheet.width * 2 / 3;
  if (style.height) sheet.height = *style.height * pixels;
  return sheet;
}

std::string terminals(const std::string& name, const std::string& command, const Sheet& sheet, const FigureStyle& style) {
  const double scale = style.sized() ? dots_of_papers / dots_per_inch : 2;
  std::string out = fmt::format("set terminal svg size {2:.0f},{3:.0f} font '{4},{5:.4g}' dynamic background rgb 'white'\nset output '{0}.svg'\n{1}\n"
                                "set terminal pngcairo size {6:.0f},{7:.0f} font '{4},{8:.4g}' linewidth {9:.4g} pointscale {9:.4g}\nset output '{0}.png'\n{1}\n",
                                name, command, sheet.width, sheet.height, style.font, sheet.font, scale * sheet.width, scale * sheet.height,
                                scale * sheet.font * (style.sized() ? points_per_inch / dots_per_inch : 1), scale);
  // Without fontscale, text has 2/3 of the requested size; lines of width 1 are 0.5 points.
  if (style.pdf)
    out += fmt::format("set terminal pdfcairo size {2:.4g}in,{3:.4g}in font '{4},{5:.4g}' fontscale 0.75 linewidth 1.5\nset output '{0}.pdf'\n{1}\n", name, command,
                       sheet.width / dots_per_inch, sheet.height / dots_per_inch, style.font, sheet.font * points_per_inch / dots_per_inch);
  return out + "unset output\n";
}

// Returns a round tick distance with which at most `most` ticks fill the range.
double tick_step(const AxisRange& range, double most) {
  const double least = (range.high - range.low) / std::max(2.0, most), decade = std::pow(10, std::floor(std::log10(least)));
  for (const double times : {1, 2, 5})
    if (times * decade >= least) return times * decade;
  return 10 * decade;
}

// Returns the commands of an axis. most: number of ticks that fit; 0: gnuplot's choice. In pictures
// for papers, with small text, exponents are 0.9 times as high as the text, not 0.8.
std::string axis(const char* name, const AxisRange& range, double most = 0) {
  std::string out = fmt::format("set {}range [{}:{}]\n", name, range.low, range.high);
  if (!range.log) return most > 0 ? out + fmt::format("set {}tics {:.6g}\n", name, tick_step(range, most)) : out;
  std::vector<std::string> ticks;
  const bool decades = range.high / range.low > 100;
  for (const double t : log_ticks(range))
    ticks.push_back(decades ? fmt::format("'10^{{{}{}}}' {}", most > 0 ? "/*1.125 " : "", static_cast<int>(std::lround(std::log10(t))), t) : fmt::format("'{:g}' {}", t, t));
  return out + fmt::format("set logscale {0}\nset {0}tics ({1})\n", name, fmt::join(ticks, ", "));
}

std::string shortened(const std::string& text) {
  return text.size() <= label_length_max ? text : std::string(utf8_prefix(text, label_length_max - 3)) + "...";
}

struct PlotData {
  std::vector<Curve> curves;
  AxisRange x, y;
};

// Returns heights of the names at the right ends of the curves; nothing if they do not fit.
std::optional<std::vector<double>> label_heights(const PlotData& s, const Plot& plot) {
  if (s.curves.size() > label_count_max) return std::nullopt;
  std::vector<double> wanted;
  for (const Curve& c : s.curves) {
    std::pair<double, double> last{-std::numeric_limits<double>::infinity(), 0};
    for (const auto& p : c.points)
      if (drawable(plot, p) && p.first >= last.first) last = p;
    if (s.x.position(last.first) < label_end_min) return std::nullopt;
    wanted.push_back(s.y.position(last.second));
  }
  return separate_labels(wanted, label_distance);
}

// Applies the title and the y label of a style to a picture.
template <class Picture>
Picture styled(Picture picture, const FigureStyle& style) {
  if (!style.title.empty()) picture.title = style.title;
  if (style.untitled) picture.title.clear();
  if (!style.y_label.empty()) picture.y_label = style.y_label;
  return picture;
}

struct DrawnBand {
  std::string title;
  double low, high;     // of the band's part on the axis
  bool across;          // its title is horizontal
  double title_height;  // over the height of the axes; 0 without a title
};

std::vector<DrawnBand> drawn_bands(const Plot& plot, const AxisRange& x, const Sheet& sheet) {
  std::vector<DrawnBand> drawn;
  for (const Band& b : plot.bands) {
    const double low = std::max(b.low, x.low), high = std::min(b.high, x.high);
    if (!(low < high)) continue;
    const double width = (x.position(high) - x.position(low)) * axes_share * sheet.width;
    const double length = band_letter * sheet.font * static_cast<double>(b.title.size());
    const bool across = width > length, titled = plot.bands.size() <= band_titles_max && width >= sheet.font;
    drawn.push_back({b.title, low, high, across, titled ? (across ? sheet.row() : length) / (axes_share * sheet.height) : 0});
  }
  return drawn;
}

// Raises the upper end of the y axis by the height of the bands' titles, so that no curve crosses them.
void make_room(const std::vector<DrawnBand>& bands, AxisRange& y) {
  double height = 0;
  for (const DrawnBand& b : bands) height = std::max(height, b.title_height);
  const double times = 1 / (1 - std::min(height, band_titles_max_height));
  y.high = y.log ? y.low * std::pow(y.high / y.low, times) : y.low + (y.high - y.low) * times;
}

std::string script_of(const Plot& given, const std::string& name, const FigureStyle& style) {
  Plot unscaled = styled(given, style);
  if (!style.x_label.empty()) unscaled.x_label = style.x_label;
  const Plot plot = scaled(unscaled);
  PlotData s;
  for (const Curve& c : merged_curves(plot.curves))
    if (drawable(plot, c)) s.curves.push_back(c);  // gnuplot stops at a curve without points
  std::vector<double> xs, ys;
  for (const Curve& c : s.curves) {
    for (const auto& p : c.points)
      if (drawable(plot, p)) xs.push_back(p.first), ys.push_back(p.second);
    for (const auto& [low, high] : c.spread) ys.push_back(low), ys.push_back(high);
  }
  for (const LevelLine& l : plot.levels) ys.push_back(l.at);
  for (const LevelLine& l : plot.verticals) xs.push_back(l.at);
  s.x = range_of(xs, plot.log_x).value();
  s.y = range_of(ys, plot.log_y).value();
  std::string out = "set encoding utf8\n";
  for (size_t i = 0; i < s.curves.size(); ++i) out += data_block(plot, s.curves[i], i);
  out += fmt::format("set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
                     "set border 3 lc rgb '#606060'\nset tics nomirror out\n{}",
                     in_quotes(plot.title), in_quotes(plot.x_label), in_quotes(plot.y_label), style.grid ? "set grid lc rgb '#e0e0e0' lw 1\n" : "");
  const Sheet plain = sheet_of(style, false, 0);
  const std::vector<DrawnBand> bands = drawn_bands(plot, s.x, plain);
  if (!bands.empty()) make_room(bands, s.y);
  out += axis("x", s.x, style.sized() ? plain.width / (6 * plain.font) : 0) + axis("y", s.y, style.sized() ? plain.height / (4 * plain.font) : 0);
  const auto labels = label_heights(s, plot);
  size_t longest = 0;
  double below = 0;
  for (const Curve& c : s.curves) longest = std::max(longest, shortened(c.title).size());
  if (!style.legend) {
    out += "unset key\n";
  } else if (labels && s.curves.size() > 1) {
    out += fmt::format("unset key\nset rmargin {}\n", longest + 3);
    for (size_t i = 0; i < s.curves.size(); ++i)
      out += fmt::format("set label {} at graph 1.015, graph {:.4f} left noenhanced tc rgb '{}'\n", in_quotes(shortened(s.curves[i].title)),
                         (*labels)[i], colour_of(i, style));
  } else {
    size_t longest_title = 0;
    for (const Curve& c : s.curves) longest_title = std::max(longest_title, c.title.size());
    const bool beside = s.curves.size() <= legend_beside_max && longest_title <= beside_length_max;
    out += s.curves.size() < 2 ? "unset key\n" : beside ? "set key outside right noenhanced samplen 3\n" : "";
    if (!beside && s.curves.size() > 1) {  // between the axis and the notes
      const size_t in_a_row = longest_title > two_column_length_max ? 1 : longest_title > three_column_length_max ? 2 : 3, rows = (s.curves.size() + in_a_row - 1) / in_a_row;
      const double names = 10 + static_cast<double>(rows + plot.notes.size()) * plain.row();
      if (!style.height) below = names;
      out += fmt::format("set key at screen 0.02, screen {:.4f} left top Left reverse noenhanced samplen 3 maxrows {}\nset bmargin at screen {:.4f}\n",
                         names / (plain.height + below), rows, (names + plain.axis()) / (plain.height + below));
    }
  }
  for (size_t i = 0; i < bands.size(); ++i) {
    const DrawnBand& b = bands[i];
    if (i % 2 == 1) out += fmt::format("set object rectangle from first {}, graph 0 to first {}, graph 1 fc rgb '#eeeeee' fs solid noborder behind\n", b.low, b.high);
    if (b.title_height > 0)
      out += fmt::format("set label {} at first {}, graph 0.985 {} noenhanced tc rgb '#606060' front\n", in_quotes(b.title), (b.low + b.high) / 2,
                         b.across ? "center offset 0,-0.5" : "right rotate by 90");
  }
  for (const LevelLine& l : plot.levels)
    out += fmt::format("set arrow from graph 0, first {0} to graph 1, first {0} nohead lc rgb '#808080' dt (4,4) lw 1.5\n"
                       "set label {1} at graph 0.01, first {0} offset 0,0.5 noenhanced tc rgb '#606060'\n", l.at, in_quotes(l.title));
  for (const LevelLine& l : plot.verticals)
    out += fmt::format("set arrow from first {0}, graph 0 to first {0}, graph 1 nohead lc rgb '#808080' dt (4,4) lw 1.5\n"
                       "set label {1} at first {0}, graph 0.02 left rotate by 90 offset 0.7,0 noenhanced tc rgb '#606060'\n", l.at, in_quotes(l.title));
  if (!plot.notes.empty()) {
    if (below == 0) out += fmt::format("set bmargin {}\n", 4 + plot.notes.size());
    for (size_t i = 0; i < plot.notes.size(); ++i)
      out += fmt::format("set label {} at screen 0.02, screen {:.3f} left noenhanced tc rgb '#606060'\n", in_quotes(plot.notes[i]),
                         (10 + plain.row() * static_cast<double>(plot.notes.size() - 1 - i)) / (plain.height + below));
  }
  std::vector<std::string> commands;
  for (size_t i = 0; i < s.curves.size(); ++i) {
    const bool scattered = s.curves[i].scattered;
    const char* with = scattered ? "points" : plot.style == Plot::Style::points ? "linespoints" : plot.style == Plot::Style::lines ? "lines" : "steps";
    const std::string mark = scattered || plot.style == Plot::Style::points ? fmt::format(" pt {} ps 0.8", marks[i % marks.size()]) : "";
    // Marks of size zero would make SVG that some renderers cannot read: these are just invisible.
    if (!s.curves[i].spread.empty())
      commands.push_back(fmt::format("$curve{} using 1:2:3:4 with yerrorbars notitle lc rgb '{}' lw 1.2 pt 7 ps 0.02", i, colour_of(i, style)));
    commands.push_back(fmt::format("$curve{} using 1:2 with {} {}{} title {}", i, with, style_of(i, style), mark, in_quotes(s.curves[i].title)));
  }
  Sheet sheet = sheet_of(style, !labels || longest > 16, below);
  if (style.width && !style.height) sheet.height += below;
  return out + terminals(name, fmt::format("plot {}", fmt::join(commands, ",")), sheet, style);
}

std::string script_of(const StackedBars& given, const std::string& name, const FigureStyle& style) {
  const StackedBars bars = styled(given, style);
  std::string out = "set encoding utf8\n$bars << END\n";
  double highest = 0;
  for (const std::vector<double>& segments : bars.heights) highest = std::max(highest, std::accumulate(segments.begin(), segments.end(), 0.0));
  for (const BarMark& mark : bars.marks) highest = std::max(highest, mark.height);
  const AxisUnit up = bars.y_unit.empty() ? AxisUnit{} : axis_unit(highest, bars.y_unit);
  size_t longest = 0;
  for (size_t i = 0; i < bars.names.size(); ++i) {
    std::string label = printable(shortened(bars.names[i]));
    std::replace(label.begin(), label.end(), '"', ' ');
    longest = std::max(longest, label.size());
    out += fmt::format("\"{}\"", label);
    for (const double h : bars.heights[i]) out += fmt::format(" {}", std::isfinite(h) ? h * up.factor : 0);
    out += "\n";
  }
  out += fmt::format("END\nset title {} noenhanced\nset ylabel {} noenhanced\nset style data histograms\nset style histogram rowstacked\n"
                     "set style fill solid 1 border lc rgb 'white'\nset boxwidth {}\nset border 3 lc rgb '#606060'\n"
                     "set tics nomirror out\nset xtics rotate by 35 right noenhanced\nset grid y lc rgb '#e0e0e0' lw 1\n"
                     "{}\nset yrange [0:{}]\nset lmargin {}\nset bmargin {}\n",
                     in_quotes(bars.title), in_quotes(axis_label(bars.y_label, up.text)), bar_width,
                     bars.segments.size() > 1 ? "set key outside right invert noenhanced samplen 1.5 maxcols 1" : "unset key",
                     bars.top ? fmt::format("{}", *bars.top) : bars.marks.empty() ? "*" : fmt::format("{}", 1.1 * highest * up.factor), std::max<size_t>(11, longest * 7 / 10), 3 + longest / 5);
  for (const BarMark& mark : bars.marks) {
    const double middle = static_cast<double>(mark.bar), height = mark.height * up.factor;
    out += fmt::format("set arrow from {0},{1} to {2},{1} nohead lc rgb '#000000' lw 2 front\n"
                       "set label {3} at {4},{1} center offset 0,0.6 noenhanced front\n",
                       middle - bar_mark_width / 2, height, middle + bar_mark_width / 2, in_quotes(mark.title), middle);
  }
  std::vector<std::string> commands;
  for (size_t k = 0; k < bars.segments.size(); ++k) {
    const std::string fill = k < colours.size() ? "fill solid 1" : fmt::format("fill pattern {}", 1 + k % 6);
    commands.push_back(fmt::format("{} using {}{} title {} {} lc rgb '{}'", "$bars", k + 2, k ? "" : ":xtic(1)",
                                   in_quotes(bars.segments[k]), fill, colours[k % colours.size()]));
  }
  return out + terminals(name, fmt::format("plot {}", fmt::join(commands, ",")), sheet_of(style, true, 0), style);
}

}  // namespace

std::string draw_script(const fs::path& folder, const std::string& name) {
  const std::string script = name + ".gp";
  const fs::path messages = fs::absolute(folder / (name + ".gnuplot.txt"));
  const int code = run_program({"gnuplot", script}, {folder, messages, true});
  if (code == 0) {
    fs::remove(messages);
    return "";
  }
  if (could_not_start(code))
    return fmt::format("{}: no pictures, as gnuplot is missing; install it (Debian: gnuplot-nox) and run "
                       "`gnuplot {}` in {}",
                       name, script, folder.string());
  return fmt::format("{}: gnuplot failed; see {}", name, messages.string());
}

std::string draw(const Plot& plot, const fs::path& folder, const std::string& name, const FigureStyle& style) {
  const auto& curves = plot.curves;
  if (std::none_of(curves.begin(), curves.end(), [&](const Curve& c) { return drawable(plot, c); }))
    return fmt::format("{}: nothing to draw", name);
  replace_file(folder / (name + ".gp"), script_of(plot, name, style));
  return draw_script(folder, name);
}

std::string draw(const StackedBars& bars, const fs::path& folder, const std::string& name, const FigureStyle& style) {
  if (bars.names.empty() || bars.segments.empty()) return fmt::format("{}: nothing to draw", name);
  replace_file(folder / (name + ".gp"), script_of(bars, name, style));
  return draw_script(folder, name);
}

}  // namespace tack
