#include "framework/export/shape_format.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/export/output_path.hpp"
#include "framework/shapes/length_unit.hpp"
#include "geometry/errors.hpp"

namespace tack {

void ShapeFormat::fields(Fields& f) {
  f.texts("objects", selection_.objects, "names of the objects to write: [cube, floor]; all unless given");
  f.optional_number("from", selection_.from, units::time, "time of the first sample");
  f.optional_number("to", selection_.to, units::time, "time of the last sample");
  f.optional_number("fps", selection_.fps, units::none, "samples per simulated second, interpolated linearly between frames; each frame is a sample unless given").positive();
}

void ShapeFormat::check_objects(const std::vector<std::string>& names) const {
  for (const std::string& wanted : selection_.objects)
    if (std::find(names.begin(), names.end(), wanted) == names.end())
      throw InputError(fmt::format("format '{}', objects: unknown object '{}'{}", type(), wanted, suggestion(wanted, names, "objects")));
}

Exported ShapeFormat::write(const std::filesystem::path& results, const std::filesystem::path& output) const {
  if (!output.empty()) check_output(output);
  const RunShapes run(results, selection_, [this](const std::vector<std::string>& names) { check_objects(names); });
  const std::filesystem::path path = output.empty() ? run.folder() / "export" / default_output(run.name()) : output;
  if (!output.empty() && writes_one_file()) {
    check_file_output(path, run.sources());
  } else if (!output.empty()) {
    check_folder_output(path, run.sources());
    mark_exported(path);
  }
  Exported exported{{path}, run.notes()};
  write_run(run, path, exported.notes);
  return exported;
}

void OutputUnit::fields(Fields& f) {
  f.text("unit", name, "unit of the coordinates: m, mm, inch").line();
  f.check("unit", [this] { return LengthUnits{"m", name}.problem(); });
}

void OutputUnit::note_other_units(const RunShapes& run, std::vector<std::string>& notes) const {
  for (const ExportedObject& object : run.objects())
    if (!object.file_unit.empty() && LengthUnits{"m", object.file_unit}.factor() != per_metre())
      notes.push_back(fmt::format("object '{}' was read from a file in {} and is written in {}; unit={} writes it as it was", object.name, object.file_unit, name, object.file_unit));
}

double OutputUnit::per_metre() const { return LengthUnits{"m", name}.factor(); }

}  // namespace tack
