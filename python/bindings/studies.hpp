// Comparisons and calibrations from Python.
#pragma once

#include <pybind11/pybind11.h>

namespace tack::python {

void bind_studies(pybind11::module_& module);

}  // namespace tack::python
