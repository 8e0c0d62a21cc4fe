// main(): executes the command line (command_line.cpp), continues in another program if needed,
// and maps exceptions to exit codes.
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <string>

#include "framework/app/command_line.hpp"
#include "framework/app/commands.hpp"
#include "framework/app/memory_limit.hpp"
#include "framework/plugin/further_components.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

// Opens /dev/null for each standard stream that the caller has closed. Otherwise the next opened
// file gets its descriptor, and the program prints into it.
void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
    // open() returns the lowest free descriptor, which is this one.
    if (::fcntl(stream, F_GETFD) < 0 && ::open("/dev/null", O_RDWR) != stream) std::abort();
}

// Unblocks the signals that only the waiting thread receives: a program executed in place of this
// one inherits the mask and would ignore them.
void unblock_signals() {
  sigset_t none;
  ::sigemptyset(&none);
  ::pthread_sigmask(SIG_SETMASK, &none, nullptr);
}

// Starts the script `tack` again, if it started this program before a library was built: it builds
// the library and restarts the program.
void restart_to_build_libraries(char** argv) {
  const char* script = std::getenv("TACK_SCRIPT");
  if (!script) return;
  const char* asked = std::getenv("TACK_LIBRARIES");
  std::string targets = asked ? asked : "";
  bool missing = false;
  for (const std::string target : {further_components_failed() ? "tack_further" : "", missing_library()}) {
    if (target.empty() || targets.find(target) != targets.npos) continue;  // asks once
    targets += (targets.empty() ? "" : " ") + target;
    missing = true;
  }
  if (!missing) return;
  ::setenv("TACK_LIBRARIES", targets.c_str(), 1);
  std::fflush(nullptr);
  unblock_signals();
  ::execv(script, argv);
}

// Executes tack_studies with the same arguments. Returns if it cannot be started.
int execute_studies_program(char** argv) {
  namespace fs = std::filesystem;
  std::error_code none;
  const std::string program = (fs::read_symlink("/proc/self/exe", none).parent_path() / "tack_studies").string();
  std::fflush(nullptr);
  unblock_signals();
  ::execv(program.c_str(), argv);
  const char* why = std::strerror(errno);
  fmt::print(stderr, "error: the program with this command, {}, cannot be started ({}); {}\n", program, why, remedy_for_missing("tack_studies"));
  return exit_bad_input;
}

}  // namespace
}  // namespace tack

int main(int argc, char** argv) {
  tack::open_standard_streams();
  try {
    tack::check_address_space(0);
  } catch (const tack::InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    std::fflush(nullptr);
    ::_exit(tack::exit_bad_input);  // without waiting for the threads of OpenBLAS
  }
  try {
    tack::declare_further_components();
    tack::set_mesh_cache_folder(tack::default_mesh_cache_folder());
    return tack::execute_command_line(argc, argv);
  } catch (const tack::InStudies&) {
    return tack::execute_studies_program(argv);
  } catch (const tack::InputError& error) {
    tack::restart_to_build_libraries(argv);
    fmt::print(stderr, "error: {}\n", error.what());
    return tack::exit_bad_input;
  } catch (const tack::Interrupted& interrupted) {
    fmt::print("interrupted: {}\n", interrupted.remark);
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
