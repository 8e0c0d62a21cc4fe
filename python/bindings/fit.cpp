#include "python/bindings/fit.hpp"

#include <fmt/format.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "framework/batch/resolved_case.hpp"
#include "framework/batch/sobol.hpp"
#include "framework/calibrate/derivatives.hpp"
#include "framework/output/run_folder.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "geometry/plain_numbers.hpp"
#include "python/bindings/interrupts.hpp"

namespace tack::python {
namespace {

constexpr double bound_tolerance = 1e-5;  // of the range: values have six digits

py::array_t<double> array_of(const std::vector<double>& values) { return py::array_t<double>(static_cast<py::ssize_t>(values.size()), values.data()); }

py::dict dict_of(const PointEvaluation& e, const std::vector<MeasuredPoints>& measured) {
  py::dict misfits;
  for (size_t k = 0; k < e.misfits.size(); ++k) misfits[py::str(measured[k].name)] = e.misfits[k];
  py::dict d;
  d["values"] = array_of(e.values);
  d["status"] = e.status;
  d["error"] = e.error;
  d["misfit"] = e.misfit;
  d["misfits"] = misfits;
  d["residuals"] = e.good ? py::object(array_of(e.residuals)) : py::none();
  return d;
}

}  // namespace

Fit::Fit(const std::string& path, const std::vector<std::string>& set, const std::string& output, const std::string& program, int jobs, int threads, bool failed)
    : config_(load_calibration(path, set)), scenes_(config_, program_digest()),
      folder_(CalibrationFolder::opened(RunFolder::chosen_root(output, config_.name), config_.name)) {
  const Provenance provenance = provenance_of("", threads > 0 ? threads : config_.threads);
  const std::string file = std::filesystem::absolute(path).lexically_normal().string();
  evaluator_ = std::make_unique<CaseEvaluator>(
      scenes_, CaseEvaluator::Settings{program, folder_.evaluations, calibration_description(config_, scenes_, file, provenance, jobs, threads), std::nullopt, failed, {}, {}});
  evaluator_->write_tables();
}

py::list Fit::parameters() const {
  py::list all;
  for (const FittedParameter& p : scenes_.parameters()) {
    py::dict d;
    d["name"] = p.name;
    d["low"] = p.from;
    d["high"] = p.to;
    d["start"] = six_digits(p.start);
    d["log"] = p.log;
    d["unit"] = p.unit.empty() ? "1" : p.unit;
    d["keys"] = p.keys;
    all.append(d);
  }
  return all;
}

py::list Fit::experiments() const {
  py::list all;
  for (const MeasuredPoints& m : scenes_.measured()) {
    py::dict d;
    d["name"] = m.name;
    d["x"] = m.x;
    d["y"] = m.y;
    d["x_unit"] = m.x_unit;
    d["y_unit"] = m.y_unit;
    d["points"] = m.curve.size();
    d["noise_known"] = m.noise_known;
    d["scale"] = m.scale;
    d["weight"] = m.weight;
    all.append(d);
  }
  return all;
}

std::vector<DesignPoint> Fit::design(int count) const {
  const std::vector<FittedParameter>& parameters = scenes_.parameters();
  const std::vector<double> unit = sobol_points(count, static_cast<int>(parameters.size()));
  std::vector<DesignPoint> points(static_cast<size_t>(count));
  auto next = unit.begin();
  for (DesignPoint& point : points)
    for (const FittedParameter& p : parameters) point.push_back(p.value(p.low() + *next++ * (p.high() - p.low())));
  return points;
}

// Returns the values to six digits, within their ranges.
DesignPoint Fit::checked(const std::vector<double>& values) const {
  const std::vector<FittedParameter>& parameters = scenes_.parameters();
  if (values.size() != parameters.size())
    throw InputError(fmt::format("a point has {} values, and {} parameters are fitted: one value for each is needed", values.size(), parameters.size()));
  DesignPoint point;
  for (size_t i = 0; i < values.size(); ++i) {
    const FittedParameter& p = parameters[i];
    const double slack = bound_tolerance * (p.to - p.from);
    if (!(values[i] >= p.from - slack && values[i] <= p.to + slack))
      throw InputError(fmt::format("{}: {:.6g} is not between {:.6g} and {:.6g} {}; keep to the bounds, or widen `from` and `to`", p.name, values[i], p.from, p.to, p.unit));
    point.push_back(six_digits(std::clamp(values[i], p.from, p.to)));
  }
  return point;
}

// Ctrl-C raises KeyboardInterrupt, and ends the runs.
template <class Act>
void Fit::without_interpreter(const Act& act) {
  {
    const Interrupts interrupts;
    const py::gil_scoped_release released;
    const PlainNumbers plain;
    act();
  }
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

py::list Fit::evaluate(const std::vector<std::vector<double>>& points, bool derivatives) {
  std::vector<DesignPoint> checked_points;
  for (const std::vector<double>& point : points) checked_points.push_back(checked(point));
  std::vector<PointEvaluation> found;
  without_interpreter([&] { found = evaluator_->at(checked_points, derivatives); });
  py::list all;
  for (const PointEvaluation& e : found) all.append(dict_of(e, scenes_.measured()));
  return all;
}

py::dict Fit::jacobian(const std::vector<double>& values) {
  const DesignPoint point = checked(values);
  const std::vector<FittedParameter>& parameters = scenes_.parameters();
  PointEvaluation middle;
  Derivatives d;
  without_interpreter([&] {
    middle = evaluator_->at({point}, config_.search.gradients)[0];
    if (!middle.good && config_.search.gradients) middle = evaluator_->at({point}, false)[0];
    if (!middle.good) throw SimulationError(fmt::format("no derivatives at {}: {} ({})", values_text(parameters, point), middle.status, middle.error));
    std::vector<double> u;
    for (size_t i = 0; i < point.size(); ++i) u.push_back(parameters[i].u(point[i]));
    d = derivatives_at(parameters, u, config_.search.difference, middle, [&](const std::vector<DesignPoint>& others) { return evaluator_->at(others, false); });
    if (!d.problem.empty()) throw SimulationError(d.problem);
  });
  for (size_t i = 0; i < parameters.size(); ++i) d.jacobian.col(static_cast<long>(i)) /= parameters[i].slope(point[i]);
  py::array_t<double> jacobian({d.jacobian.rows(), d.jacobian.cols()});
  auto at = jacobian.mutable_unchecked<2>();
  for (long i = 0; i < d.jacobian.rows(); ++i)
    for (long k = 0; k < d.jacobian.cols(); ++k) at(i, k) = d.jacobian(i, k);
  py::dict answer;
  answer["jacobian"] = jacobian;
  answer["residuals"] = array_of(middle.residuals);
  answer["from_runs"] = d.from_runs;
  return answer;
}

void Fit::write_tables() { evaluator_->write_tables(); }

void bind_fit(py::module_& module) {
  py::class_<Fit>(module, "Fit")
      .def(py::init([](const std::string& path, const std::vector<std::string>& set, const std::string& output, const std::string& program, int jobs, int threads, bool failed) {
             const py::gil_scoped_release released;
             const PlainNumbers plain;
             return std::make_unique<Fit>(path, set, output, program, jobs, threads, failed);
           }),
           py::arg("path"), py::arg("set"), py::arg("output"), py::arg("program"), py::arg("jobs"), py::arg("threads"), py::arg("failed"))
      .def_property_readonly("folder", &Fit::folder)
      .def("parameters", &Fit::parameters)
      .def("experiments", &Fit::experiments)
      .def("design", &Fit::design, py::arg("count"))
      .def("evaluate", &Fit::evaluate, py::arg("points"), py::arg("derivatives"))
      .def("jacobian", &Fit::jacobian, py::arg("point"))
      .def("write_tables", &Fit::write_tables);
}

}  // namespace tack::python
