#include "tests/hard/steps_balance.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/output/csv.hpp"

namespace tack {
namespace {

double at(const CsvTable& table, const std::vector<double>& row, std::string_view name) {
  return row[table.column(name).value()];
}

// Returns the energy of one state [J], without gravity, whose zero is arbitrary.
double stored(const CsvTable& table, const std::vector<double>& row) {
  double sum = 0;
  for (size_t i = 0; i < table.columns.size(); ++i)
    if (table.columns[i].rfind("energy_", 0) == 0 && table.columns[i] != "energy_gravity") sum += std::abs(row[i]);
  return sum;
}

double gravity_range(const CsvTable& table) {
  if (!table.column("energy_gravity")) return 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const auto& row : table.rows) {
    low = std::min(low, at(table, row, "energy_gravity"));
    high = std::max(high, at(table, row, "energy_gravity"));
  }
  return std::max(high - low, 0.0);
}

}  // namespace

StepsBalance steps_balance(const std::filesystem::path& steps) {
  const CsvTable table = read_csv(steps);
  StepsBalance balance;
  double largest = 0, sum = 0, external_work = 0;
  for (const auto& row : table.rows) {
    const double taken = at(table, row, "dissipated_areas") + at(table, row, "dissipated_numerics");
    sum += taken;
    balance.energy_gain += std::max(-taken, 0.0);
    external_work += at(table, row, "work_loads") + at(table, row, "work_script");
    largest = std::max({largest, stored(table, row), std::abs(sum), std::abs(external_work)});
    const double tolerated = at(table, row, "tolerated_force");
    if (tolerated > 0)
      balance.force_residual = std::max(balance.force_residual, at(table, row, "unbalanced_force") / tolerated);
  }
  largest += gravity_range(table);
  balance.energy_loss = largest > 0 ? std::max(sum, 0.0) / largest : 0;
  balance.energy_gain = largest > 0 ? balance.energy_gain / largest : 0;
  return balance;
}

}  // namespace tack
