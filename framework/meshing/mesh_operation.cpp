#include "framework/meshing/mesh_operation.hpp"

#include <fmt/format.h>

#include <chrono>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_bytes.hpp"
#include "geometry/isolated_process.hpp"
#include "geometry/mesh/mesh_quality.hpp"
#include "geometry/meshing_library.hpp"

namespace tack {
namespace {

using End = ProcessResult::End;

constexpr std::uint64_t memory = std::uint64_t(8) << 30;  // bytes, for about ten million tets
// Wall time, as a multiple of the processor time that an operation may use, after which it is given
// up: a machine with ten times as many runs as cores still leaves it its processor time.
constexpr double wall_per_processor_time = 10;

ProcessResult run(const MeshOperation& operation, const Mesh& mesh, const std::string& name) {
  const double seconds = operation.time_limit();
  // Writes the result of the child process: notes, a line each, an empty line, the mesh.
  return run_isolated({memory, seconds, wall_per_processor_time * seconds}, [&] {
    Notes notes;
    const Mesh result = operation.apply(mesh, name, notes);
    std::string text;
    for (const std::string& line : notes) text += line + "\n";
    return text + "\n" + bytes_of(result);
  });
}

// Moves the lines before the first empty one into `notes`; returns false if no line is empty.
bool take_notes(std::string_view& text, Notes& notes) {
  for (;;) {
    const std::size_t end = text.find('\n');
    if (end == text.npos) return false;
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end + 1);
    if (line.empty()) return true;
    notes.emplace_back(line);
  }
}

}  // namespace

void MeshOperation::fields(Fields& f) {
  parameters(f);
  f.number("time_limit", time_limit_, units::time, "processor time after which the operation fails; so it does after ten times as much wall time").positive();
}

Mesh run_operation(MeshOperation& operation, const Mesh& mesh, const std::string& name, Notes& notes) {
  const auto start = std::chrono::steady_clock::now();
  open_meshing_library();
  operation.prepare();
  const std::string what = fmt::format("{}, {}", name, operation.type());
  const ProcessResult result = run(operation, mesh, what);
  if (result.end == End::input_error) throw InputError(result.text);
  if (result.end == End::no_processor_time)
    throw InputError(fmt::format("{}: not done after {:.3g} s of processor time; ask for longer edges, simplify the mesh first, or raise time_limit", what,
                                 operation.time_limit()));
  if (result.end == End::no_wall_time)
    throw InputError(fmt::format("{}: not done after {:.3g} s, in which it was given less than {:.3g} s of processor time (time_limit): the machine has other "
                                 "work; run it again when that is done, or raise time_limit", what, wall_per_processor_time * operation.time_limit(),
                                 operation.time_limit()));
  if (result.end == End::no_memory)
    throw InputError(what + ": more memory is needed than there should be; ask for longer edges, or simplify the mesh first");
  if (result.end != End::answer)
    throw InputError(fmt::format("{}: CGAL {} on this mesh; look at it with `tack mesh info`, repair it, or remesh it first", what,
                                 result.end == End::exception ? "failed (" + result.text + ")" : result.text));
  std::string_view text = result.text;
  std::optional<Mesh> made;
  if (take_notes(text, notes)) made = mesh_from(text);
  if (!made) throw InputError(what + ": the process that made the mesh failed; repair the mesh, or remesh it first");
  for (const std::string& line : quality_notes(*made)) notes.push_back(line);
  notes.push_back(fmt::format("took {:.2g} s", std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count()));
  return std::move(*made);
}

}  // namespace tack
