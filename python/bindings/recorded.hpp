// Python classes of recorded runs and their reports.
#pragma once

#include <pybind11/pybind11.h>

namespace tack::python {

void bind_recorded(pybind11::module_& module);

}  // namespace tack::python
