#include "python/bindings/problem.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack::python {

MinimizerProblem& Problem::there() {
  if (!problem_) throw std::runtime_error("the step that this was the problem of is over; ask for the next one");
  return *problem_;
}

int Problem::size() { return there().objective.size(); }

// Moves the objective only if q differs from the present point.
Objective& Problem::at(const Numbers& q) {
  Objective& objective = there().objective;
  const VecX to = vector_of(q, objective.size(), "unknowns");
  if (q_.size() != to.size() || q_ != to) {
    objective.move_to(to);
    q_ = to;
    judged_.reset();
    feasible_.reset();
  }
  return objective;
}

// Returns true if nothing intersects and no tetrahedron is inverted, by the exact checks of steps.
// Barriers do not detect surfaces that have passed through each other.
bool Problem::feasible() {
  if (feasible_) return *feasible_;
  const VecX& x = dynamic_cast<const IncrementalPotential&>(there().objective).configuration();
  feasible_ = x.allFinite() && first_inverted_tet(world_.tets, x) < 0 &&
              (!world_.contact || find_intersections(world_.contact->surface().mesh, x, world_.contact->colliding(), 1).empty());
  return *feasible_;
}

double Problem::value(const Numbers& q) {
  ++work_.line_search_evaluations;
  const double value = at(q).value();
  return std::isfinite(value) && feasible() ? value : std::numeric_limits<double>::infinity();
}
py::array Problem::gradient(const Numbers& q) {
  ++work_.iterations;
  return copy(at(q).gradient(), 0);
}

py::object Problem::hessian(const Numbers& q, const std::string& projection) {
  HessianRequest request;
  if (projection == "clamp") request.projection = Projection::clamp;
  else if (projection == "absolute") request.projection = Projection::absolute;
  else if (projection != "none") throw py::value_error("projection: '" + projection + "' is none of: none, clamp, absolute");
  return sparse(at(q).hessian(request));
}

double Problem::feasible_step(const Numbers& q, const Numbers& p) {
  const int size = there().objective.size();
  const double step = there().feasible_step(vector_of(q, size, "unknowns"), vector_of(p, size, "direction"));
  leave();  // filters may have moved the shared state
  return step;
}

py::list Problem::parts(const Numbers& q) {
  Objective& objective = at(q);
  py::list all;
  const std::vector<ObjectivePart> parts = objective.parts();
  for (size_t i = 0; i < parts.size(); ++i) {
    py::dict d;
    d["name"] = parts[i].name;
    d["value"] = objective.part_value(static_cast<int>(i));
    d["gradient"] = copy(objective.part_gradient(static_cast<int>(i)), 0);
    d["dynamic"] = parts[i].dynamic;
    d["stores"] = parts[i].stores;
    all.append(d);
  }
  return all;
}

py::list Problem::pairs(const Numbers& q, double reach) {
  const int size = there().objective.size();
  if (!there().pairs) throw std::runtime_error("this problem has no pairs: it is that of prescribed vertices on their way");
  const std::vector<ClosePair> found = there().pairs(vector_of(q, size, "unknowns"), reach);
  leave();  // the search may have moved the shared state
  py::list all;
  for (const ClosePair& pair : found) {
    py::list objects;
    for (const int body : pair.bodies) objects.append(body >= 0 ? py::object(py::str(world_.bodies[body].name)) : py::none());
    const int* v = pair.vertices.data();
    const double* w = pair.weights.data();
    py::dict d;
    d["kind"] = std::string(to_string(pair.kind));
    d["first"] = std::vector<int>(v, v + pair.first_count);
    d["second"] = std::vector<int>(v + pair.first_count, v + pair.count);
    d["weights_first"] = std::vector<double>(w, w + pair.first_count);
    d["weights_second"] = std::vector<double>(w + pair.first_count, w + pair.count);
    d["distance"] = pair.distance;
    d["gap"] = pair.gap();
    d["normal"] = copy(VecX(pair.normal), 0);
    d["objects"] = objects;
    all.append(d);
  }
  return all;
}

py::list Problem::cuts(const Numbers& q, const Numbers& p, double below) {
  const int size = there().objective.size();
  if (!there().cuts) throw std::runtime_error("this problem has no step filters: it is that of prescribed vertices on their way");
  if (!(below > 0 && below <= 1)) throw py::value_error("below: a fraction of the step in (0, 1] is needed");
  const StepCuts found = there().cuts(vector_of(q, size, "unknowns"), vector_of(p, size, "direction"), below);
  leave();  // filters may have moved the shared state
  py::list all;
  for (size_t i = 0; i < found.cuts.size(); ++i) {
    const StepCut& cut = found.cuts[i];
    const auto vertices = cut.all_vertices();
    const auto blocks = found.blocks_of(static_cast<int>(i));
    py::list bodies;
    for (const int body : cut.bodies)
      if (body >= 0) bodies.append(world_.bodies[body].name);
    py::dict d;
    d["kind"] = std::string(to_string(cut.kind));
    d["step"] = cut.step;
    d["vertices"] = std::vector<int>(vertices.begin(), vertices.end());
    d["blocks"] = std::vector<int>(blocks.begin(), blocks.end());
    d["objects"] = bodies;
    all.append(d);
  }
  return all;
}

py::array Problem::block_bounds(const Numbers& q, const Numbers& p, const std::string& kind) {
  const int size = there().objective.size();
  if (!there().block_bounds) throw std::runtime_error("this problem has no step filters: it is that of prescribed vertices on their way");
  if (kind != "together" && kind != "alone") throw py::value_error("kind: '" + kind + "' is none of: together, alone");
  const VecX bounds = there().block_bounds(vector_of(q, size, "unknowns"), vector_of(p, size, "direction"), kind == "alone" ? BlockBound::alone : BlockBound::together);
  leave();
  return copy(bounds, 0);
}

double Problem::stopping_norm(const Numbers& p, const Numbers& gradient) {
  const int size = there().objective.size();
  return there().stopping_norm(vector_of(p, size, "direction"), vector_of(gradient, size, "gradient"));
}

bool Problem::converged(const Numbers& q) {
  at(q);
  if (!judged_) judged_ = judge_.converged(there(), work_);
  return *judged_;
}

std::string Problem::fault_at(const Numbers& q) {
  at(q);
  if (feasible()) return "";
  const VecX& x = dynamic_cast<const IncrementalPotential&>(there().objective).configuration();
  if (const int tet = first_inverted_tet(world_.tets, x); tet >= 0)
    return fmt::format(
        "inverts tet {} of '{}'", tet,
        world_.bodies[static_cast<size_t>(world_.body_of(world_.tets[static_cast<size_t>(tet)][0]))]
            .name);
  const CollisionMesh& mesh = world_.contact->surface().mesh;
  const EdgeTriangleHit hit = find_intersections(mesh, x, world_.contact->colliding(), 1).front();
  const auto name = [&](int v) {
    return world_.bodies[static_cast<size_t>(mesh.vertex_object[static_cast<size_t>(v)])].name;
  };
  const auto n = [&](int v) { return world_.index_in_body(v); };
  const Edge& e = mesh.edges[static_cast<size_t>(hit.edge)];
  const Triangle& t = mesh.triangles[static_cast<size_t>(hit.triangle)];
  return fmt::format("intersects: edge ({}, {}) of '{}' meets triangle ({}, {}, {}) of '{}'",
                     n(e[0]), n(e[1]), name(e[0]), n(t[0]), n(t[1]), n(t[2]), name(t[0]));
}

std::string Problem::unmet_criterion(const Numbers& q, Stopping stopping) {
  const MinimizerProblem& problem = there();
  Objective& objective = at(q);
  MinimizerResult measured;
  ConvergenceJudge judge;
  judge.begin();
  judge.converged(problem, measured);
  const double forces = problem.force_residual ? problem.force_residual(objective.gradient()) : 0;
  if (forces > 1 && forces >= measured.residual)
    return fmt::format(
        "forces are out of balance by {:.3g} times what solver.balance_tolerance and force_floor "
        "allow",
        forces);
  const char* key =
      stopping == Stopping::force || !problem.norm_of_direction ? "force_tolerance" : "tolerance";
  return fmt::format("the stopping norm is {:.3g} times solver.{}", measured.residual,
                     stopping == Stopping::acceleration ? "acceleration_tolerance" : key);
}

void bind_problem(py::module_& module) {
  py::class_<Problem, std::shared_ptr<Problem>>(
      module, "Problem",
      "The incremental potential of one step, as a function of its unknowns q: the coordinates of all vertices that are free, one after the other [m].\n\n"
      "Valid until the step ends.")
      .def_property_readonly("size", &Problem::size, "Number of unknowns.")
      .def_property_readonly("start", &Problem::start, "Unknowns where the minimisation begins, without intersections.")
      .def("value", &Problem::value, py::arg("q"), R"doc(Returns the incremental potential.

Parameters
----------
q : array_like
    Unknowns (n,) [m].

Returns
-------
float
    [J s^2; of quasi-static steps J]; infinite where surfaces intersect or elements are inverted.)doc")
      .def("gradient", &Problem::gradient, py::arg("q"), R"doc(Returns the gradient of the incremental potential.

Parameters
----------
q : array_like
    Unknowns (n,) [m].

Returns
-------
ndarray
    (n,), in the unit of the value per metre.)doc")
      .def("hessian", &Problem::hessian, py::arg("q"), py::arg("projection") = "none", R"doc(Returns the Hessian of the incremental potential.

Parameters
----------
q : array_like
    Unknowns (n,) [m].
projection : {'none', 'clamp', 'absolute'}
    Makes each stencil positive semi-definite: `clamp` sets negative eigenvalues to zero, `absolute` reverses their sign.

Returns
-------
scipy.sparse.csc_matrix
    (n, n).)doc")
      .def("feasible_step", &Problem::feasible_step, py::arg("q"), py::arg("p"), R"doc(Returns the largest step without intersection and inversion.

Parameters
----------
q : array_like
    Unknowns (n,) [m].
p : array_like
    A direction (n,) [m].

Returns
-------
float
    The largest t in (0, 1] such that nothing intersects or inverts from q to q + t p.)doc")
      .def("parts", &Problem::parts, py::arg("q"), R"doc(Returns the terms of value and gradient.

Parameters
----------
q : array_like
    Unknowns (n,) [m].

Returns
-------
list of dict
    name ('inertia', or that of an energy), value, gradient, dynamic (its stencils change with the contacts) and stores (False: the dissipation of the step, as of friction).
    Values and gradients add up to value(q) and gradient(q).)doc")
      .def("pairs", &Problem::pairs, py::arg("q"), py::arg("reach"), R"doc(Returns pairs of primitives that are close.

Parameters
----------
q : array_like
    Unknowns (n,) [m].
reach : float
    Largest gap [m]; at most the largest range of contact.

Returns
-------
list of dict
    kind ('edge_edge', 'point_triangle', ...), first and second (their vertices), weights_first and weights_second (of the vertices in the closest points), distance,
    gap (less the offset of the surfaces) [m], normal (from the second to the first) and objects.)doc")
      .def("cuts", &Problem::cuts, py::arg("q"), py::arg("p"), py::arg("below") = 1.0, R"doc(Returns what by itself bounds the step from q to q + p.

Parameters
----------
q : array_like
    Unknowns (n,) [m].
p : array_like
    A direction (n,) [m].
below : float
    Bounds below this fraction of the step are returned.

Returns
-------
list of dict
    kind ('edge_edge', 'point_triangle', 'tet', ...), step (the fraction that it allows), vertices (of the first primitive, then of the second), blocks (of three unknowns)
    and objects, in an order that does not depend on threads.)doc")
      .def("block_bounds", &Problem::block_bounds, py::arg("q"), py::arg("p"), py::arg("kind") = "together", R"doc(Returns how far each block of three unknowns may move.

Parameters
----------
q : array_like
    Unknowns (n,) [m].
p : array_like
    A direction (n,) [m].
kind : {'together', 'alone'}
    `together`: whatever fraction of its bound each block moves; `alone`: while all others are at rest.

Returns
-------
ndarray
    A fraction of p per block.)doc")
      .def("stopping_norm", &Problem::stopping_norm, py::arg("p"), py::arg("gradient"), R"doc(Returns the stopping norm of a Newton direction.

Parameters
----------
p : array_like
    A Newton direction (n,) [m].
gradient : array_like
    The gradient (n,) where the direction starts.

Returns
-------
float
    In tolerances: 1 is tolerated.)doc")
      .def("converged", &Problem::converged, py::arg("q"), R"doc(Returns whether the minimisation may end at q, by the scene's own tolerances.

Parameters
----------
q : array_like
    Unknowns (n,) [m].

Returns
-------
bool
    True if it may.)doc");
}

}  // namespace tack::python
