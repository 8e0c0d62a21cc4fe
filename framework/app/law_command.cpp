// tack law: adhesion laws without a scene: metrics and curves on the terminal, pictures and tables
// in a folder.
#include <fmt/format.h>

#include <filesystem>
#include <set>

#include "framework/app/commands.hpp"
#include "framework/checks/bond_law_check.hpp"
#include "framework/config/thermal_units.hpp"
#include "framework/law/law_plots.hpp"
#include "framework/law/law_source.hpp"
#include "framework/law/law_tables.hpp"
#include "framework/output/file_names.hpp"
#include "framework/plot/axis_unit.hpp"
#include "framework/plot/gnuplot.hpp"
#include "framework/plugin/plugins.hpp"
#include "geometry/errors.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

constexpr int printed_rows = 10;

std::optional<double> quantity(const std::string& text, const Unit& unit, const char* option) {
  if (text.empty()) return std::nullopt;
  double value = 0;
  try {
    value = to_si(text, unit);
  } catch (const InputError& error) {
    throw InputError(fmt::format("{} {}", option, error.what()));
  }
  if (!(value > 0)) throw InputError(fmt::format("{} expects a {} above zero, got '{}'", option, unit.quantity, text));
  return value;
}

void print_quantities(const std::vector<KeyQuantity>& quantities) {
  size_t longest = 0;
  for (const KeyQuantity& f : quantities) longest = std::max(longest, f.name.size());
  for (const KeyQuantity& f : quantities) {
    std::string value = std::isfinite(f.value) ? with_axis_unit(f.value, f.unit) : "none";
    if (value.find(" 10") != value.npos) value = fmt::format("{:.6g} {}", f.value, f.unit);  // without a prefix
    if (f.remark.empty()) fmt::print("  {:<{}}  {}\n", f.name, longest, value);
    else fmt::print("  {:<{}}  {:<16}  {}\n", f.name, longest, value, f.remark);
  }
}

void print_row(const std::vector<std::string>& cells) {
  std::string line;
  for (const std::string& cell : cells) line += fmt::format("  {:>14}", cell);
  fmt::print("{}\n", line);
}

// Returns the point of a curve whose abscissa is nearest to x.
template <class Point, class At>
const Point& nearest_point(const std::vector<Point>& points, double x, const At& at) {
  return *std::min_element(points.begin(), points.end(), [&](const Point& a, const Point& b) { return std::abs(at(a) - x) < std::abs(at(b) - x); });
}

void print_curve(const GapStudy& study) {
  print_row({"gap", "traction", "energy", "with barrier"});
  for (int i = 1; i <= printed_rows; ++i) {
    const GapPoint& p = nearest_point(study.curve, study.shown * i / printed_rows, [](const GapPoint& at) { return at.gap; });
    print_row({with_axis_unit(p.gap, "m"), with_axis_unit(p.traction, "Pa"), with_axis_unit(p.energy, "J/m^2"), with_axis_unit(p.pair_traction, "Pa")});
  }
}

// Prints an energy; energies that are negligible beside the work are printed as zero.
std::string energy_text(double energy, double work) { return with_axis_unit(std::abs(energy) > 1e-12 * work ? energy : 0, "J/m^2"); }

void print_curve(const BondStudy& study, double work) {
  if (study.slow.empty()) return;
  const BondPath& path = study.slow.front();
  fmt::print("  {}, slowly:\n", direction_name(path.angle));
  print_row({"opening", "traction", "intensity", "stored", "dissipated"});
  const double end = std::min(path.shown, displacement_of(path.points.back()));
  for (int i = 1; i <= printed_rows; ++i) {
    const BondPoint& p = nearest_point(path.points, end * i / printed_rows, displacement_of);
    print_row({with_axis_unit(displacement_of(p), "m"), with_axis_unit(traction_along(p, path.angle), "Pa"), fmt::format("{:.4g}", p.intensity), energy_text(p.stored, work),
               energy_text(p.dissipated, work)});
  }
}

// Returns true for a law of initial intensity 1, which has the peak and the work that it states.
bool is_whole(const BondLaw& law) {
  std::vector<double> memory(law.width());
  law.initialize(false, memory.data());
  return law.intensity_of(memory.data()) == 1;
}

// Prints the derivative check of a law; returns true if the derivatives are correct.
bool print_check(const LawCheck& check, bool states) {
  for (const std::string& line : check.notes) fmt::print("  {}\n", line);
  for (const std::string& line : check.warnings) fmt::print("  warning: {}\n", line);
  for (const std::string& line : check.errors) fmt::print("  {}  WRONG: see its formula\n", line);
  if (check.errors.empty()) fmt::print("  its derivatives are those of its energy{}\n", states && check.warnings.empty() ? ", and it has the peak and the work that it states" : "");
  return check.errors.empty();
}

// Writes pictures and tables into a folder; for several laws, the law's name prefixes the files.
class Written {
 public:
  explicit Written(fs::path folder) : folder_(std::move(folder)) {
    std::error_code failed;
    fs::create_directories(folder_, failed);
    if (failed) throw InputError(fmt::format("{}: cannot be made ({}); choose another folder with -o", folder_.string(), failed.message()));
  }
  void table(const std::string& name, const std::string& text) {
    replace_file(folder_ / (name + ".csv"), text);
    fmt::print("{}\n", (folder_ / (name + ".csv")).string());
  }
  void pictures(const std::string& prefix, const std::map<std::string, Plot>& plots) {
    for (const auto& [name, plot] : plots) {
      const std::string failure = draw(plot, folder_, prefix + name);
      fmt::print("{}\n", failure.empty() ? (folder_ / (prefix + name + ".svg")).string() : failure);
      failed_ = failed_ || !failure.empty();
    }
  }
  bool failed() const { return failed_; }

 private:
  fs::path folder_;
  bool failed_ = false;
};

template <class Study>
void write(const Study& study, const std::string& title, const std::string& prefix, Written& written) {
  written.table(prefix + "curves", curves_table(study));
  written.table(prefix + "figures", quantities_table(study.quantities));
  written.pictures(prefix, law_plots(title, study));
}

}  // namespace

int law_command(const LawOptions& o) {
  for (const std::string& plugin : o.plugins) load_plugin(fs::absolute(plugin).string());
  LawSource source;
  source.type = o.type;
  for (const std::string& word : o.words) {
    if (word.find('=') != word.npos) source.settings.push_back(word);
    else if (source.file.empty()) source.file = word;
    else throw InputError(fmt::format("tack law: one file, and '{}' is another; parameters are written key=value", word));
  }
  source.contact_distance = quantity(o.contact_distance, units::length, "--contact-distance");
  source.barrier_stiffness = quantity(o.barrier_stiffness, units::pressure, "--barrier-stiffness");
  source.young = quantity(o.young, units::pressure, "--young");
  source.temperature = quantity(o.temperature, units::temperature, "--temperature");
  const StudySettings settings{quantity(o.speed, units::velocity, "--speed"), quantity(o.pressure, units::pressure, "--pressure")};
  const std::vector<StudiedLaw> laws = laws_of(source);
  std::optional<Written> written;
  if (!o.output.empty()) written.emplace(o.output);
  std::set<std::string> prefixes;
  bool right = true;
  for (const StudiedLaw& law : laws) {
    std::string prefix = laws.size() > 1 ? file_name(law.name) + "_" : "";
    while (!prefixes.insert(prefix).second) prefix += "_";
    fmt::print("{}: a law of {}. {}.\n", law.name, law.gap ? "the gap" : "bonds", law.law().traits_text());
    if (law.gap) {
      const GapStudy study = study_gap_law(law, settings);
      print_quantities(study.quantities);
      right = print_check(check_pair(law.pair), true) && right;
      print_curve(study);
      if (written) write(study, law.name, prefix, *written);
    } else {
      const BondStudy study = study_bond_law(law, settings);
      print_quantities(study.quantities);
      LawCheck check = check_law(*law.bond);
      for (const std::string& doubt : law.bond->warnings()) check.warnings.emplace_back(WarningKind::law_data, doubt);
      if (const std::string note = law.bond->note(); !note.empty()) check.notes.push_back(note);
      right = print_check(check, !study.slow.empty() && is_whole(*law.bond)) && right;
      print_curve(study, law.bond->work_of_adhesion());
      if (written) write(study, law.name, prefix, *written);
      if (written && !study.scan.points.empty()) written->table(prefix + "rates", rates_table(study));
      if (written && !study.healing.empty()) written->table(prefix + "healing", healing_table(study));
    }
  }
  return right && !(written && written->failed()) ? exit_done : exit_expectation_failed;
}

}  // namespace tack
