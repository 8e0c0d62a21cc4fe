// A traction by gap (or opening) as rows of a file, which become a curve: monotone between rows, its integral exact (geometry/curves).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/config/field.hpp"
#include "geometry/curves/cubic_curve.hpp"

namespace tack {

struct TractionTable {
  struct Read {
    CubicCurve curve;  // from 0 to the last gap [m]; below the first its traction holds on
    int rows = 0;
    std::vector<std::string> doubts;
  };

  std::string file;
  std::string gap_column = "gap", traction_column = "traction";
  std::optional<double> smooth;  // m

  void fields(Fields& f);

  // Throws InputError with file and line for what is no such curve: fewer than two rows, gaps that are negative or do not ascend.
  Read read() const;
};

}  // namespace tack
