#include "framework/output/laws_csv.hpp"

#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "framework/output/csv.hpp"
#include "framework/scene/world.hpp"
#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

constexpr int law_samples = 400;        // of a law, from zero to beyond its range
constexpr double steepest = 3;       // repulsion beyond this many peak tractions is left out

std::string rows_of(const std::string& pair, const PairLaw& law, double peak) {
  std::string rows;
  const double range = law.range() - law.offset();
  for (int i = 1; i <= law_samples; ++i) {
    const double gap = 1.05 * range * i / law_samples, traction = law.at(law.offset() + gap).slope;
    double adhesion = 0;
    for (const auto& part : law.laws())
      if (dynamic_cast<const NormalAdhesion*>(part.get())) adhesion += part->at(gap).slope;
    if (traction < -steepest * peak) continue;
    rows += fmt::format("{},{},{},{},{}\n", csv_cell(pair), gap, traction, traction - adhesion, adhesion);
  }
  return rows;
}

}  // namespace

void write_laws(const std::filesystem::path& path, const World& world) {
  if (world.adhesion.empty()) return;
  std::string text = "pair,gap,traction,barrier,adhesion\n";
  for (const AdhesionSummary& pair : world.adhesion) {
    const PairTable& table = world.contact->pairs();
    const auto& [a, b] = pair.kinds.front();
    text += rows_of(pair.names(), table.laws()[table.thin(a, b).law], pair.peak_traction);
  }
  replace_file(path, text);
}

}  // namespace tack
