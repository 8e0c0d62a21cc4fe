// tack check --picture: the check, then a picture of the initial state.
#include <fmt/format.h>

#include <filesystem>

#include "framework/app/commands.hpp"
#include "framework/report/setup_picture.hpp"
#include "geometry/errors.hpp"

namespace tack {

int picture_command(const CheckOptions& options) {
  if (std::filesystem::path(options.picture).extension() != ".png") throw InputError(fmt::format("{}: names of pictures end in .png", options.picture));
  const int code = check_command(options);
  draw_setup(loaded_scene(options), options.picture);
  fmt::print("{}\n", options.picture);
  return code;
}

}  // namespace tack
