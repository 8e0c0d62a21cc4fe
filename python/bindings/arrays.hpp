// Vectors and matrices of tack as NumPy and SciPy have them.
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
// An array of numbers, or nested lists of them, as a caller gave it: vector_of() checks it.
using Numbers = py::object;

// All of it as (size / columns, columns), or flat where columns is 0: memory of the vector itself, which lives as long as the array does. Not writable.
py::array view(const std::shared_ptr<const VecX>& values, int columns);

// Copies, of the same shapes.
py::array copy(const VecX& values, int columns);

// Returns a flat vector from an array of shape (size) or (size / 3, 3): another shape of the same
// size would scramble the numbers. Throws TypeError for anything but an array of real numbers and
// for a masked array, ValueError for another shape and for numbers that are not finite. `what`: the
// name in messages, such as "positions".
VecX vector_of(const Numbers& numbers, Eigen::Index size, const std::string& what);

// (n, K) of whole numbers.
template <class Tuples>
py::array_t<int> table(const Tuples& tuples, int columns) {
  py::array_t<int> out({static_cast<py::ssize_t>(tuples.size()), static_cast<py::ssize_t>(columns)});
  auto at = out.mutable_unchecked<2>();
  for (size_t i = 0; i < tuples.size(); ++i)
    for (int k = 0; k < columns; ++k) at(static_cast<py::ssize_t>(i), k) = tuples[i][k];
  return out;
}

// scipy.sparse.csc_matrix, both triangles; modes of the matrix that are in no block (global_modes.hpp) are added as they are, dense.
py::object sparse(const BlockMatrix& matrix);

}  // namespace tack::python
