#include "framework/run/reference_solver.hpp"

#include "framework/config/parse.hpp"

namespace tack {

Value reference_solver(const std::string& projection, const std::string& linear, double tolerance) {
  Value solver = parse_string("stopping: velocity\nmax_iterations: 5000\n", "(reference)");
  // The entry `type` replaces the scene's solver, whatever it is.
  solver.set("type", Value::scalar("projected_newton"));
  solver.set("projection", Value::scalar(projection));
  solver.set("linear", Value::scalar(linear));
  solver.set("force_tolerance", Value::number(tolerance));
  return solver;
}

}  // namespace tack
