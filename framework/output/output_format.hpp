// File formats of the shapes of a run, as `output.formats` and `tack export` name them. A run
// writes its frames as vtu; other formats are made from the frames of a results folder, which may
// be that of a run under way.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "framework/config/registry.hpp"

namespace tack {

// Paths that an export has made, and remarks of one line each.
struct Exported {
  std::vector<std::filesystem::path> paths;  // files, or the folder of many
  std::vector<std::string> notes;
};

class OutputFormat : public Component {
 public:
  static constexpr const char* kind_name = "format";
  static constexpr const char* kind_doc =
      "A file format of the shapes of a run, for `output.formats` and `tack export`.";

  // Throws InputError if the format is to write an object that is none of these.
  virtual void check_objects(const std::vector<std::string>& /*names*/) const {}

  // Makes files of the frames of a results folder. output: the file or folder to write; empty: a
  // path below the folder `export` of the results. Throws InputError with the path and the remedy.
  virtual Exported write(const std::filesystem::path& results,
                         const std::filesystem::path& output) const = 0;
};

}  // namespace tack
