// Conversion of vectors and matrices to and from NumPy and SciPy.
#pragma once

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <string>
#include <vector>

#include "framework/core/block_matrix.hpp"
#include "geometry/types.hpp"

namespace tack::python {

namespace py = pybind11;
// An array of numbers or nested lists of them, as given by a caller; vector_of() checks it.
using Numbers = py::object;

// Returns a read-only view of shape (size / columns, columns), or flat if columns is 0. It refers
// to the vector's memory and keeps it alive.
py::array view(const std::shared_ptr<const VecX>& values, int columns);

// Returns a copy with the shape of view().
py::array copy(const VecX& values, int columns);

// Returns a flat vector from an array of shape (size) or (size / 3, 3); another shape of equal size
// would scramble the numbers. what: name in messages, such as "positions". Throws TypeError for
// anything but an array of real numbers and for a masked array, ValueError for another shape and
// for numbers that are not finite.
VecX vector_of(const Numbers& numbers, Eigen::Index size, const std::string& what);

// Returns an array (n, columns) of integers.
template <class Tuples>
py::array_t<int> table(const Tuples& tuples, int columns) {
  py::array_t<int> out(
      {static_cast<py::ssize_t>(tuples.size()), static_cast<py::ssize_t>(columns)});
  auto at = out.mutable_unchecked<2>();
  for (size_t i = 0; i < tuples.size(); ++i)
    for (int k = 0; k < columns; ++k) at(static_cast<py::ssize_t>(i), k) = tuples[i][k];
  return out;
}

// Returns a scipy.sparse.csc_matrix with both triangles. Global modes of the matrix
// (global_modes.hpp) are added as dense entries.
py::object sparse(const BlockMatrix& matrix);

}  // namespace tack::python
