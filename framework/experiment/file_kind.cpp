#include "framework/experiment/file_kind.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {
namespace {

struct Words {
  const char *name, *command;
};

Words words_of(FileKind kind) {
  switch (kind) {
    case FileKind::scene: return {"a scene", "tack run"};
    case FileKind::batch: return {"a batch", "tack batch"};
    case FileKind::comparison: return {"a comparison", "tack compare"};
    case FileKind::calibration: return {"a calibration", "tack calibrate"};
  }
  return {};
}

}  // namespace

FileKind kind_of_file(const Value& root, FileKind wanted) {
  const auto has = [&](std::initializer_list<const char*> keys) { return std::any_of(keys.begin(), keys.end(), [&](const char* k) { return root.find(k); }); };
  if (has({"objects", "contact", "gravity"})) return FileKind::scene;
  if (has({"fit", "experiments"})) return FileKind::calibration;
  if (has({"vary", "statistics", "slurm"})) return FileKind::batch;
  if (has({"solvers", "tolerances", "problems"})) return FileKind::comparison;
  if (has({"base", "bases"}) && wanted == FileKind::scene) return FileKind::batch;
  return wanted;
}

void refuse_other_kind(const Value& root, FileKind wanted) {
  const FileKind kind = kind_of_file(root, wanted);
  if (kind == wanted) return;
  const std::string file = root.mark.file ? *root.mark.file : "FILE";
  throw InputError(fmt::format("{}: is {}, not {}; call `{} {}`", root.mark.text(), words_of(kind).name, words_of(wanted).name, words_of(kind).command, file));
}

}  // namespace tack
