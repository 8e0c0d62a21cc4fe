// Stored steps, solved by the program's minimisers.
#pragma once

#include <pybind11/pybind11.h>

namespace tack::python {

void bind_stored(pybind11::module_& module);

}  // namespace tack::python
