#include "python/bindings/problem.hpp"

#include <pybind11/stl.h>

#include <cmath>
#include <limits>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"
#include "geometry/interrupt.hpp"

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
  const double value = at(q).value();
  return std::isfinite(value) && feasible() ? value : std::numeric_limits<double>::infinity();
}
py::array Problem::gradient(const Numbers& q) { return copy(at(q).gradient(), 0); }

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

namespace {

class PythonMinimizer : public Minimizer {
 public:
  PythonMinimizer(py::function function, const Minimizer& like, const World& world) : function_(std::move(function)), world_(world) {
    static_cast<Minimizer&>(*this) = like;
  }
  ~PythonMinimizer() override {
    const py::gil_scoped_acquire gil;
    function_.release().dec_ref();
  }

  std::unique_ptr<Minimizer> fresh() const override {
    const py::gil_scoped_acquire gil;
    return minimizer_of(function_, *this, world_);
  }

  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    const py::gil_scoped_acquire gil;
    const auto seen = std::make_shared<Problem>(problem, world_, q);
    struct End {
      Problem& problem;
      ~End() { problem.end(); }
    } const end{*seen};
    const py::object answer = function_(seen);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (answer.is_none()) throw py::type_error("the minimiser returned nothing; it has to return the unknowns where it ended");
    const Numbers last = py::cast<Numbers>(answer);
    const bool converged = seen->converged(last);
    q = vector_of(last, q.size(), "what the minimiser returned");
    MinimizerResult result = seen->work();
    result.status = converged ? MinimizerStatus::converged : interrupt_requested ? MinimizerStatus::interrupted : MinimizerStatus::iteration_limit;
    return result;
  }

 private:
  py::function function_;
  const World& world_;
};

}  // namespace

std::unique_ptr<Minimizer> minimizer_of(py::function function, const Minimizer& like, const World& world) {
  return std::make_unique<PythonMinimizer>(std::move(function), like, world);
}

void bind_problem(py::module_& module) {
  py::class_<Problem, std::shared_ptr<Problem>>(
      module, "Problem",
      "The incremental potential of one step, as a function of its unknowns q: the coordinates of all vertices that are free, one after the other [m].\n\n"
      "Valid until the step ends.")
      .def_property_readonly("size", &Problem::size, "How many unknowns there are.")
      .def_property_readonly("start", &Problem::start, "Where the minimisation begins: unknowns without intersections.")
      .def("value", &Problem::value, py::arg("q"), "The incremental potential at q [J s^2; of quasi-static steps J]; infinite where surfaces intersect or elements are inverted.")
      .def("gradient", &Problem::gradient, py::arg("q"), "Its gradient at q.")
      .def("hessian", &Problem::hessian, py::arg("q"), py::arg("projection") = "none",
           "Its Hessian at q, a scipy.sparse.csc_matrix. projection: 'none', or that each stencil is made positive semi-definite, 'clamp' or 'absolute'.")
      .def("feasible_step", &Problem::feasible_step, py::arg("q"), py::arg("p"),
           "The largest t in (0, 1] such that from q to q + t p nothing interpenetrates or inverts.")
      .def("cuts", &Problem::cuts, py::arg("q"), py::arg("p"), py::arg("below") = 1.0,
           "What by itself allows less than `below` of the step from q to q + p: dictionaries with kind ('edge_edge', 'point_triangle', 'tet', ...), step (the fraction that it "
           "allows), vertices (of the first primitive, then of the second), blocks (of three unknowns) and objects, in an order that does not depend on threads.")
      .def("block_bounds", &Problem::block_bounds, py::arg("q"), py::arg("p"), py::arg("kind") = "together",
           "For each block of three unknowns the fraction of p up to which it may move: 'together', whatever part of that each block makes, or 'alone', all others at rest.")
      .def("stopping_norm", &Problem::stopping_norm, py::arg("p"), py::arg("gradient"), "Of a Newton direction p and the gradient where it starts, over what is tolerated.")
      .def("converged", &Problem::converged, py::arg("q"), "Whether the minimisation may end at q, by the scene's own tolerances.");
}

}  // namespace tack::python
