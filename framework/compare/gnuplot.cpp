#include "framework/compare/gnuplot.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <utility>

#include "framework/output/replace_file.hpp"

extern char** environ;

namespace tack {
namespace {

namespace fs = std::filesystem;

// In single quotes nothing is special to gnuplot but the quote and the end of the line, which ends the command
// as well: what follows would be run. Control characters have no place in a picture anyway.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7f;
    out += c == '\'' ? std::string("''") : std::string(1, control ? ' ' : c);
  }
  return out + "'";
}

bool drawable(const Plot& plot, const std::pair<double, double>& point) {
  const auto [x, y] = point;
  return std::isfinite(x) && std::isfinite(y) && !(plot.log_x && x <= 0) && !(plot.log_y && y <= 0);
}

bool drawable(const Plot& plot, const Curve& curve) {
  return std::any_of(curve.points.begin(), curve.points.end(), [&](const auto& p) { return drawable(plot, p); });
}

std::string data_block(const Plot& plot, size_t i) {
  std::string out = fmt::format("$curve{} << END\n", i);
  for (const auto& point : plot.curves[i].points)
    if (drawable(plot, point)) out += fmt::format("{} {}\n", point.first, point.second);
  return out + "END\n";
}

std::string script_of(const Plot& plot, const std::string& name) {
  std::string out;
  for (size_t i = 0; i < plot.curves.size(); ++i) out += data_block(plot, i);
  out += fmt::format("set title {} noenhanced\nset xlabel {} noenhanced\nset ylabel {} noenhanced\n"
                     "set key outside right noenhanced\nset grid\n",
                     quoted(plot.title), quoted(plot.x_label), quoted(plot.y_label));
  for (const auto& [is_log, axis] : {std::pair(plot.log_x, 'x'), std::pair(plot.log_y, 'y')})
    if (is_log) out += fmt::format("set logscale {0}\nset format {0} '10^{{%T}}'\n", axis);
  std::string command = "plot";
  bool first = true;
  for (size_t i = 0; i < plot.curves.size(); ++i) {
    if (!drawable(plot, plot.curves[i])) continue;  // gnuplot stops at a curve without points
    command += fmt::format("{} $curve{} with {} title {}", std::exchange(first, false) ? "" : ",", i,
                           plot.steps ? "steps lw 1.5" : "linespoints lw 1.5 ps 0.7", quoted(plot.curves[i].title));
  }
  out += fmt::format("set terminal svg size 800,480 dynamic background rgb 'white'\nset output '{0}.svg'\n{1}\n"
                     "set terminal pngcairo size 1200,720 fontscale 1.3\nset output '{0}.png'\n{1}\nunset output\n",
                     name, command);
  return out;
}

// The exit code of `gnuplot SCRIPT` in a folder, its messages in a file beside it; -1: it could not be started.
int run_gnuplot(const fs::path& folder, const std::string& script, const fs::path& messages) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 1, messages.c_str(), O_CREAT | O_WRONLY | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  std::string program = "gnuplot", argument = script;
  char* argv[] = {program.data(), argument.data(), nullptr};
  pid_t pid = 0;
  const int failed = ::posix_spawnp(&pid, "gnuplot", &actions, nullptr, argv, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failed) return -1;
  int status = 0;
  while (::waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace

std::string draw(const Plot& plot, const fs::path& folder, const std::string& name) {
  const auto& curves = plot.curves;
  if (std::none_of(curves.begin(), curves.end(), [&](const Curve& c) { return drawable(plot, c); }))
    return fmt::format("{}: nothing to draw", name);
  const std::string script = name + ".gp";
  replace_file(folder / script, script_of(plot, name));
  const fs::path messages = fs::absolute(folder / (name + ".gnuplot.txt"));
  const int code = run_gnuplot(folder, script, messages);
  if (code == 0) {
    fs::remove(messages);
    return "";
  }
  if (code < 0 || code == 127)
    return fmt::format("{}: no pictures, gnuplot is not there; install it (Debian: gnuplot-nox) and run "
                       "`gnuplot {}` in {}",
                       name, script, folder.string());
  return fmt::format("{}: gnuplot failed; see {}", name, messages.string());
}

}  // namespace tack
