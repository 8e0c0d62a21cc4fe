// The C++ module under `import tack`; python/tack builds the user interface on it.
#include <pybind11/pybind11.h>

#include "framework/output/provenance.hpp"
#include "geometry/errors.hpp"
#include "geometry/interrupt.hpp"
#include "python/bindings/fit.hpp"
#include "python/bindings/interrupts.hpp"
#include "python/bindings/problem.hpp"
#include "python/bindings/recorded.hpp"
#include "python/bindings/running.hpp"
#include "python/bindings/stored.hpp"
#include "python/bindings/studies.hpp"

PYBIND11_MODULE(_tack, module) {
  namespace py = pybind11;
  using namespace tack;
  py::register_exception<InputError>(module, "InputError", PyExc_ValueError);
  py::register_exception<SimulationError>(module, "SimulationError", PyExc_RuntimeError);
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const Interrupted&) {
      PyErr_SetNone(PyExc_KeyboardInterrupt);
    }
  });
  module.attr("version") = this_build().version;
  module.attr("revision") = this_build().revision();
  module.def("let_termination_interrupt", &python::let_termination_interrupt);
  python::bind_problem(module);
  python::bind_running(module);
  python::bind_recorded(module);
  python::bind_stored(module);
  python::bind_studies(module);
  python::bind_fit(module);
}
