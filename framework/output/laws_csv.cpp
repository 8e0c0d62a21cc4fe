#include "framework/output/laws_csv.hpp"

#include <fmt/format.h>

#include "framework/bond/bond_curve.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/output/csv.hpp"
#include "framework/world/world.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr int law_samples = 400;  // samples of a law, from zero to beyond its range
constexpr double steepest = 3;    // in peak tractions: stronger repulsion is omitted

std::string rows_of(const std::string& pair, const PairLaw& law, double peak) {
  std::string rows;
  const double range = law.range() - law.offset();
  for (int i = 1; i <= law_samples; ++i) {
    const double gap = 1.05 * range * i / law_samples, traction = law.at(law.offset() + gap).slope;
    double adhesion = 0;
    for (const auto& term : law.laws())
      if (dynamic_cast<const NormalAdhesion*>(term.get())) adhesion += term->at(gap).slope;
    if (traction < -steepest * peak) continue;
    rows += fmt::format("{},{},{},{},{}\n", csv_cell(pair), gap, traction, traction - adhesion, adhesion);
  }
  return rows;
}

// Writes the law of bonds under slow opening.
std::string rows_of(const std::string& pair, const BondLaw& law) {
  std::string rows;
  for (const BondPoint& p : separate_slowly(law, 0, law_samples)) rows += fmt::format("{},{},{},{},{}\n", csv_cell(pair), p.opening, p.traction, 0, p.traction);
  return rows;
}

}  // namespace

void write_laws(const std::filesystem::path& path, const World& world) {
  if (world.adhesion.empty()) return;
  std::string text = "pair,gap,traction,barrier,adhesion\n";
  for (const AdhesionSummary& pair : world.adhesion) {
    const PairTable& table = world.contact->pairs();
    const auto& [a, b] = pair.kinds.front();
    if (const int rule = world.bonds ? world.bonds->table().between(a, b, pair.region_pair) : -1; rule >= 0) {
      text += rows_of(pair.names(), *world.bonds->table().rules()[rule].law);
      continue;
    }
    text += rows_of(pair.names(), table.laws()[table.codimensional(a, b, pair.region_pair).law], pair.peak_traction);
  }
  replace_file(path, text);
}

}  // namespace tack
