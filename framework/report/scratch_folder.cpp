#include "framework/report/scratch_folder.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cstdlib>

#include "geometry/errors.hpp"

namespace tack {

ScratchFolder::ScratchFolder() {
  std::string name = (std::filesystem::temp_directory_path() / "tack_render_XXXXXX").string();
  if (!::mkdtemp(name.data())) throw InputError(fmt::format("{}: cannot make a folder there; set TMPDIR", name));
  path_ = name;
}

ScratchFolder::~ScratchFolder() {
  std::error_code none;
  std::filesystem::remove_all(path_, none);
}

}  // namespace tack
