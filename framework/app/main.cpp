#include <fmt/format.h>

#include <cstdio>

#include "framework/app/commands.hpp"
#include "framework/app/version.hpp"
#include "geometry/errors.hpp"

int main(int argc, char** argv) {
  CLI::App app{"tack: adhesive contact of deformable solids by incremental potentials"};
  app.name("tack");
  app.set_version_flag("--version", TACK_VERSION);
  app.require_subcommand(1);
  app.footer("`./tack test` runs the tests.");
  int exit_code = tack::exit_done;
  tack::add_run_command(app, exit_code);
  tack::add_compare_command(app, exit_code);
  tack::add_check_command(app, exit_code);
  tack::add_list_command(app, exit_code);
  tack::add_mesh_command(app, exit_code);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? tack::exit_done : tack::exit_bad_input;
  } catch (const tack::InputError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return tack::exit_bad_input;
  } catch (const tack::SimulationError& error) {
    fmt::print(stderr, "error: {}\n", error.what());
    return tack::exit_simulation_failed;
  } catch (const std::exception& error) {
    fmt::print(stderr, "internal error: {}\n", error.what());
    return tack::exit_simulation_failed;
  }
  return exit_code;
}
