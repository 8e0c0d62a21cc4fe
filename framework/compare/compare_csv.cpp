#include "framework/compare/compare_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/io/replace_file.hpp"

namespace tack {
namespace {

std::string number(double value) { return std::isnan(value) ? "" : fmt::format("{}", value); }

std::string text(const std::string& value) {
  if (value.find_first_of(",\"\r\n") == std::string::npos) return value;
  std::string quoted = "\"";
  for (const char c : value) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::vector<std::string> probe_columns(const std::vector<CompareRow>& rows) {
  std::vector<std::string> columns;
  for (const CompareRow& row : rows)
    for (const auto& [column, error] : row.probe_errors)
      if (std::find(columns.begin(), columns.end(), column) == columns.end()) columns.push_back(column);
  return columns;
}

std::string probe_error(const CompareRow& row, const std::string& column) {
  for (const auto& [name, error] : row.probe_errors)
    if (name == column) return number(error);
  return "";
}

}  // namespace

void write_compare_csv(const std::filesystem::path& path, const std::vector<CompareRow>& rows) {
  const std::vector<std::string> probes = probe_columns(rows);
  std::string out = "problem,solver,tolerance,time_step,wall_seconds,wall_spread,cpu_seconds,iterations,evaluations,"
                    "linear_solves,status,branch,error_rms,error_max,relative_error,error_floor,energy_gap,intersections,penetration,crossing_pairs,solved";
  for (const std::string& column : probes) out += "," + text("error_" + column);
  out += '\n';
  for (const CompareRow& r : rows) {
    out += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}", text(r.problem), text(r.solver), r.tolerance,
                       r.time_step, r.wall_seconds, r.wall_spread, r.cpu_seconds, r.iterations, r.evaluations,
                       r.linear_solves, text(r.status), r.branch, number(r.error_rms), number(r.error_max),
                       number(r.relative_error), number(r.floor), number(r.energy_gap), r.intersections, r.penetration, r.crossing_pairs, r.solved() ? 1 : 0);
    for (const std::string& column : probes) out += "," + probe_error(r, column);
    out += '\n';
  }
  replace_file(path, out);
}

}  // namespace tack
