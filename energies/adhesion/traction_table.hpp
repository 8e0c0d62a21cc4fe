// Traction by gap (or opening) from the rows of a file, as a curve that is monotone between rows
// and has an exact integral (geometry/curves).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "geometry/curves/cubic_curve.hpp"

namespace tack {

struct TractionTable {
  struct Read {
    CubicCurve curve;  // 0 to the last gap [m]; constant below the first
    int rows = 0;
    std::vector<std::string> doubts;
  };

  std::string file;
  std::string gap_column = "gap", traction_column = "traction";
  std::optional<double> smooth;  // m

  void fields(Fields& f);

  // Throws InputError with file and line for fewer than two rows, negative gaps and gaps that do
  // not ascend.
  Read read() const;
};

}  // namespace tack
