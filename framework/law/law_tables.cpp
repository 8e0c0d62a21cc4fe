#include "framework/law/law_tables.hpp"

#include <fmt/format.h>

#include <numbers>

#include "framework/output/csv.hpp"

namespace tack {

std::string curves_table(const GapStudy& study) {
  std::string text = "gap,traction,energy,pair_traction,pair_energy\n";
  for (const GapPoint& p : study.curve) text += fmt::format("{},{},{},{},{}\n", p.gap, p.traction, p.energy, p.pair_traction, p.pair_energy);
  return text;
}

std::string curves_table(const BondStudy& study) {
  std::string text = "path,angle,speed,time,opening,slip,traction,shear,intensity,stored,dissipated\n";
  for (const auto* paths : {&study.slow, &study.unloading, &study.rates})
    for (const BondPath& path : *paths)
      for (const BondPoint& p : path.points)
        text += fmt::format("{},{},{},{},{},{},{},{},{},{},{}\n", csv_cell(path.name), path.angle * 180 / std::numbers::pi, path.speed, p.time, p.opening, p.slip,
                            p.traction, p.shear, p.intensity, p.stored, p.dissipated);
  return text;
}

std::string rates_table(const BondStudy& study) {
  std::string text = "speed,peak,work\n";
  const auto add = [&](const RatePoint& p) { text += fmt::format("{},{},{}\n", p.speed, p.peak, p.work); };
  add(study.scan.slow);
  for (const RatePoint& p : study.scan.points) add(p);
  return text;
}

std::string healing_table(const BondStudy& study) {
  std::string text = "pressure,time,strength\n";
  for (const HealingCurve& h : study.healing)
    for (const auto& [time, strength] : h.strength) text += fmt::format("{},{},{}\n", h.pressure, time, strength);
  return text;
}

std::string quantities_table(const std::vector<KeyQuantity>& quantities) {
  std::string text = "figure,value,unit,remark\n";
  for (const KeyQuantity& f : quantities) text += fmt::format("{},{},{},{}\n", csv_cell(f.name), f.value, csv_cell(f.unit), csv_cell(f.remark));
  return text;
}

}  // namespace tack
