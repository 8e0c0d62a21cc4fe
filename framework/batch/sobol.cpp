#include "framework/batch/sobol.hpp"

#include <boost/random/sobol.hpp>

namespace tack {

std::vector<double> sobol_points(int count, int dimensions) {
  boost::random::sobol engine(static_cast<size_t>(dimensions));
  std::vector<double> points(static_cast<size_t>(count) * static_cast<size_t>(dimensions));
  for (double& x : points) x = static_cast<double>(engine() >> 11) * 0x1p-53;
  return points;
}

}  // namespace tack
