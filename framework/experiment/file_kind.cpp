#include "framework/experiment/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {
namespace {

std::string name_of(FileKind kind) {
  return kind == FileKind::scene ? "a scene" : kind == FileKind::batch ? "a batch" : "a comparison";
}

std::string command_of(FileKind kind) {
  return kind == FileKind::scene ? "tack run" : kind == FileKind::batch ? "tack batch" : "tack compare";
}

}  // namespace

FileKind kind_of_file(const Value& root, FileKind wanted) {
  const auto has = [&](std::initializer_list<const char*> keys) { return std::any_of(keys.begin(), keys.end(), [&](const char* k) { return root.find(k); }); };
  if (has({"objects", "contact", "gravity"})) return FileKind::scene;
  if (has({"vary", "statistics", "slurm"})) return FileKind::batch;
  if (has({"solvers", "tolerances", "problems"})) return FileKind::comparison;
  if (has({"base", "bases"}) && wanted == FileKind::scene) return FileKind::batch;
  return wanted;
}

void refuse_other_kind(const Value& root, FileKind wanted) {
  const FileKind kind = kind_of_file(root, wanted);
  if (kind == wanted) return;
  const std::string file = root.mark.file ? *root.mark.file : "FILE";
  throw InputError(fmt::format("{}: is {}, not {}; call `{} {}`", root.mark.text(), name_of(kind), name_of(wanted), command_of(kind), file));
}

}  // namespace tack
