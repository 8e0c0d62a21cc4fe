#include "geometry/io/isolated.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "geometry/io/mesh_bytes.hpp"
#include "geometry/isolated_process.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;
using End = ProcessResult::End;

ProcessLimits limits_for(const fs::path& path) {
  std::error_code unknown;
  const std::uintmax_t found = fs::file_size(path, unknown), size = unknown ? 0 : found;
  const auto seconds = static_cast<double>(5 + size / (256 << 10));
  return {(std::uintmax_t(1) << 30) + 64 * size, seconds, 10 * seconds};
}

ProcessResult run(const fs::path& path, MeshReader read) {
  try {
    return run_isolated(limits_for(path), [&] { return bytes_of(read(path)); });
  } catch (const std::exception& error) {
    throw InputError(fmt::format("{}: {} to read it in", path.string(), error.what()));
  }
}

}  // namespace

Mesh read_isolated(const fs::path& path, MeshReader read) {
  const ProcessResult result = run(path, read);
  if (result.end == End::answer)
    if (std::optional<Mesh> mesh = mesh_from(result.text)) return std::move(*mesh);
  if (result.end == End::input_error) throw InputError(result.text);
  if (result.end == End::no_memory)
    throw InputError(path.string() + ": needs far more memory to be read than its size explains: it is damaged, export it again");
  if (result.end == End::exception)
    throw InputError(fmt::format("{}: cannot be read ({}): export it again", path.string(), result.text));
  const bool late = result.end == End::no_processor_time || result.end == End::no_wall_time;
  const std::string how = late ? "did not come to an end" : result.end == End::died ? result.text : "failed";
  throw InputError(fmt::format("{}: the library that reads such files {} on this one: it is damaged, export it again", path.string(), how));
}

}  // namespace tack
