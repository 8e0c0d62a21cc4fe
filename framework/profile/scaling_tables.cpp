// The prediction for several cores (core_scaling.hpp) as text.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "framework/profile/profile.hpp"

namespace tack {
namespace {

constexpr size_t costs_shown = 16;
constexpr int name_width = 76;

std::string_view name_of(Phase phase) { return phase_names[static_cast<int>(phase)]; }

// Returns the name, cut in the middle where it is too long for its column.
std::string fitted(const std::string& name) {
  if (name.size() <= name_width) return name;
  const size_t half = name_width / 2 - 2;
  return name.substr(0, half) + "..." + name.substr(name.size() - half);
}

std::string speed_ups(const CoreScaling& s) {
  std::string cores = fmt::format("{:<30}", "cores"), all = fmt::format("{:<30}", "speed-up of the steps"),
              loops = fmt::format("{:<30}", "if nothing were serial");
  for (size_t k = 0; k < s.cores.size(); ++k) {
    cores += fmt::format("{:>9}", s.cores[k]);
    all += fmt::format("{:>9.2f}", s.speed_up(k));
    loops += fmt::format("{:>9.2f}", s.speed_up_of_loops(k));
  }
  return cores + "\n" + all + "\n" + loops + "\n";
}

std::string phases(const CoreScaling& s) {
  std::array<Phase, phase_count> order;
  for (int i = 0; i < phase_count; ++i) order[i] = static_cast<Phase>(i);
  std::stable_sort(order.begin(), order.end(), [&](Phase a, Phase b) { return s.serial_seconds(a) > s.serial_seconds(b); });
  const size_t k = s.index_of_asked();
  const double all = std::max(s.seconds(), 1e-300);
  std::string text = fmt::format("\n{:<14}{:>12}{:>12}{:>18}{:>10}\n", "phase", "1 core s", "serial s", "serial % of all", "speed-up");
  for (const Phase phase : order)
    if (s.seconds(phase) > 0)
      text += fmt::format("{:<14}{:>12.3f}{:>12.3f}{:>18.1f}{:>10.2f}\n", name_of(phase), s.seconds(phase), s.serial_seconds(phase),
                          100 * s.serial_seconds(phase) / all, s.speed_up(k, phase));
  return text + fmt::format("{:<14}{:>12.3f}{:>12.3f}{:>18.1f}{:>10.2f}\n", "total", s.seconds(), s.serial_seconds(),
                            100 * s.serial_seconds() / all, s.speed_up(k));
}

std::string losses(const CoreScaling& s) {
  const size_t k = s.index_of_asked();
  std::string text = fmt::format("\n{:<{}}{:<14}{:>10}{:>10}{:>10}{:>12}{:>8}\n", fmt::format("what holds {} cores back", s.asked), name_width + 1,
                                 "phase", "runs", "chunks", "1 core s", fmt::format("{} cores s", s.asked), "loss %");
  for (size_t i = 0; i < std::min(costs_shown, s.costs.size()); ++i) {
    const LoopCost& c = s.costs[i];
    const std::string chunks = c.serial ? "serial" : fmt::format("{:.1f}", double(c.chunks) / double(std::max(c.runs, 1L)));
    text += fmt::format("{:<{}}{:<14}{:>10}{:>10}{:>10.3f}{:>12.3f}{:>8.1f}\n", fitted(c.name), name_width + 1, name_of(c.phase), c.runs, chunks,
                        c.seconds, c.on_cores[k], 100 * s.share_lost(c));
  }
  if (s.costs.size() <= costs_shown) return text;
  double rest = 0;
  for (size_t i = costs_shown; i < s.costs.size(); ++i) rest += s.share_lost(s.costs[i]);
  return text + fmt::format("{} more, {:.1f}% of the loss\n", s.costs.size() - costs_shown, 100 * rest);
}

}  // namespace

std::string scaling_tables(const CoreScaling& s) {
  if (s.empty()) return "";
  const double runs = static_cast<double>(s.divided_runs());
  return "\nprediction for several cores, from the processor time of one thread; an upper bound\n" + speed_ups(s) +
         fmt::format("not counted: memory shared by cores, and starting and ending {:.0f} loops (each microsecond for one adds {:.2f}% to the time of one core)\n",
                     runs, 100 * 1e-6 * runs / std::max(s.seconds(), 1e-300)) +
         phases(s) + losses(s);
}

}  // namespace tack
