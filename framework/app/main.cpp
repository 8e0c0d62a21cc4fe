// The program: the command line (command_line.cpp), what it goes on in, and exit codes.
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>

#include "framework/app/command_line.hpp"
#include "framework/app/commands.hpp"
#include "framework/shapes/made_mesh.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/meshing_library.hpp"

namespace tack {
namespace {

// Started by the script `tack` before the library was built: it builds it, and starts the program again.
void let_script_build_library(char** argv) {
  const char* script = std::getenv("TACK_SCRIPT");
  if (!script || !meshing_library_failed()) return;
  std::fflush(nullptr);
  ::setenv("TACK_MESHING", "1", 1);
  ::execv(script, argv);
}

// tack_studies, with the same words. Returns if it cannot be started.
int go_on_in_studies(char** argv) {
  namespace fs = std::filesystem;
  std::error_code none;
  const std::string program = (fs::read_symlink("/proc/self/exe", none).parent_path() / "tack_studies").string();
  std::fflush(nullptr);
  ::execv(program.c_str(), argv);
  fmt::print(stderr, "error: the program with this command, {}, cannot be started ({}); run `./tack`, which builds it, or "
                     "`cmake --build --preset release --target tack_studies`\n", program, std::strerror(errno));
  return exit_bad_input;
}

}  // namespace
}  // namespace tack

int main(int argc, char** argv) {
  try {
    tack::keep_meshes_in(tack::usual_mesh_folder());
    return tack::execute_command_line(argc, argv);
  } catch (const tack::InStudies&) {
    return tack::go_on_in_studies(argv);
  } catch (const tack::InputError& error) {
    tack::let_script_build_library(argv);
    fmt::print(stderr, "error: {}\n", error.what());
    return tack::exit_bad_input;
  } catch (const tack::Interrupted&) {
    fmt::print("interrupted: while meshes were made; no step was done, nothing is written\n");
    return tack::exit_interrupted;
  } catch (const tack::SimulationError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return tack::exit_simulation_failed;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "error: not enough memory for this scene; use fewer cells, or let it have more\n");
    return tack::exit_simulation_failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return tack::exit_simulation_failed;
  }
}
