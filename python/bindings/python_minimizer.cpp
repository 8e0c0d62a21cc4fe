// A minimiser that is a Python function, and the exceptions that it raises.
#include <fmt/format.h>

#include <exception>

#include "framework/core/minimizer_failure.hpp"
#include "geometry/interrupt.hpp"
#include "python/bindings/problem.hpp"

namespace tack::python {

void rethrow_python(const SimulationError& error) {
  try {
    std::rethrow_if_nested(error);
  } catch (py::error_already_set& python) {
    if (py::hasattr(python.value(), "add_note"))
      python.value().attr("add_note")(
          std::string(error.what()).substr(0, std::string(error.what()).find(": ")) +
          ": the minimiser raised this");
    throw;
  } catch (const py::builtin_exception&) {
    throw;
  } catch (...) {
  }
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
    VecX returned = vector_of(last, q.size(), "what the minimiser returned");
    if (const std::string fault = seen->fault_at(last); !fault.empty())
      throw std::runtime_error("the minimiser returned a point that " + fault);
    const bool converged = seen->converged(last);
    q = std::move(returned);
    MinimizerResult result = seen->work();
    if (!converged && !interrupt_requested) {
      result.status = MinimizerStatus::iteration_limit;
      const bool single = py::isinstance<py::array_t<float>>(last);
      throw MinimizerFailure(
          fmt::format("the minimiser returned a point that has not converged: {}{}",
                      seen->unmet_criterion(last, stopping()),
                      single ? " (it is in single precision, float32)" : ""),
          result);
    }
    result.status = converged             ? MinimizerStatus::converged
                    : interrupt_requested ? MinimizerStatus::interrupted
                                          : MinimizerStatus::iteration_limit;
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

}  // namespace tack::python
