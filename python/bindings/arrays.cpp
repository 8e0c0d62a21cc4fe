#include "python/bindings/arrays.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <string_view>

namespace tack::python {

namespace {

std::vector<py::ssize_t> shape_of(Eigen::Index size, int columns) {
  if (columns == 0) return {size};
  return {size / columns, columns};
}

// Rejects complex numbers, masks, texts and booleans, which would be converted silently.
py::array real_array(const Numbers& numbers, const std::string& what) {
  if (py::isinstance(numbers, py::module_::import("numpy.ma").attr("MaskedArray")))
    throw py::type_error(what + ": a masked array is given, and every number counts; give what `filled` makes of it");
  py::array given = py::array::ensure(numbers);
  if (!given) throw py::type_error(what + ": no array of numbers is given");
  if (const char kind = given.dtype().kind(); std::string_view("fiu").find(kind) == std::string_view::npos)
    throw py::type_error(fmt::format("{}: an array of {} is given, and real numbers are needed{}", what, py::str(given.dtype()).cast<std::string>(),
                                     kind == 'c' ? "; give its `real`" : ""));
  return given;
}

void check_shape(const py::array& given, Eigen::Index size, const std::string& what) {
  const bool flat = given.ndim() == 1 && given.shape(0) == size;
  const bool by_vertex = given.ndim() == 2 && given.shape(1) == 3 && 3 * given.shape(0) == size;
  if (flat || by_vertex) return;
  const std::string shape = py::str(given.attr("shape")).cast<std::string>();
  throw py::value_error(fmt::format("{}: an array of shape {} is given where {} is needed", what, shape, size % 3 == 0 ? fmt::format("({}, 3) or ({},)", size / 3, size) : fmt::format("({},)", size)));
}

}  // namespace

py::array view(const std::shared_ptr<const VecX>& values, int columns) {
  auto* owner = new std::shared_ptr<const VecX>(values);
  const py::capsule base(owner, [](void* p) { delete static_cast<std::shared_ptr<const VecX>*>(p); });
  py::array_t<double> out(shape_of(values->size(), columns), values->data(), base);
  py::detail::array_proxy(out.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return out;
}

py::array copy(const VecX& values, int columns) { return py::array_t<double>(shape_of(values.size(), columns), values.data()); }

VecX vector_of(const Numbers& numbers, Eigen::Index size, const std::string& what) {
  const py::array given = real_array(numbers, what);
  check_shape(given, size, what);
  const auto rows = py::array_t<double, py::array::c_style | py::array::forcecast>::ensure(given);
  if (!rows) throw py::error_already_set();
  VecX values = Eigen::Map<const VecX>(rows.data(), size);
  for (Eigen::Index i = 0; i < size; ++i)
    if (!std::isfinite(values(i))) throw py::value_error(fmt::format("{}: number {} is {}", what, i, values(i)));
  return values;
}

py::object sparse(const BlockMatrix& matrix) {
  const auto size = static_cast<py::ssize_t>(matrix.size());
  const auto count = static_cast<py::ssize_t>(matrix.values.size());
  // Lists the lower triangle block by block with its mirror image; scipy sums duplicates and sorts.
  py::array_t<double> values(2 * count);
  py::array_t<std::int32_t> rows(2 * count), columns(2 * count);
  double* value = values.mutable_data();
  std::int32_t *row = rows.mutable_data(), *column = columns.mutable_data();
  py::ssize_t n = 0;
  const auto put = [&](int r, int c, double v) {
    value[n] = v;
    row[n] = r;
    column[n++] = c;
  };
  for (int c = 0; c < matrix.columns(); ++c)
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      const int r = matrix.row[k];
      const auto block = matrix.block(k);
      for (int j = 0; j < 3; ++j)
        for (int i = 0; i < 3; ++i) {
          put(3 * r + i, 3 * c + j, block(i, j));
          if (r != c) put(3 * c + j, 3 * r + i, block(i, j));
        }
    }
  const py::module_ scipy = py::module_::import("scipy.sparse");
  const py::slice used(0, n, 1);
  const py::object entries = py::make_tuple(values[used], py::make_tuple(rows[used], columns[used]));
  py::object all = scipy.attr("coo_matrix")(entries, py::arg("shape") = py::make_tuple(size, size)).attr("tocsc")();
  for (const GlobalMode& mode : matrix.modes) {
    const py::object u = scipy.attr("csc_matrix")(copy(mode.vector, 1));
    all = all + py::float_(mode.coefficient) * (u.attr("dot")(u.attr("transpose")()));
  }
  return all.attr("tocsc")();
}

}  // namespace tack::python
