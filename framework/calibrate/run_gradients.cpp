#include "framework/calibrate/run_gradients.hpp"

#include <fmt/format.h>

#include <cmath>
#include <memory>

namespace tack {

Value gradients_value(const std::vector<GradientConfig>& gradients) {
  Value list = Value::sequence();
  list.mark.file = std::make_shared<const std::string>("the calibration");
  for (const GradientConfig& one : gradients) {
    Value entry = Value::map();
    entry.set("key", Value::scalar(one.key));
    if (one.step) entry.set("step", Value::number(*one.step));
    list.items.push_back(std::move(entry));
  }
  return list;
}

std::vector<double> gradient_column(const ProbeSeries& gradients, const std::string& probe, const std::vector<std::string>& keys) {
  std::vector<double> sum(gradients.rows.size(), 0);
  if (probe == "time") return sum;
  for (const std::string& key : keys) {
    const auto column = gradients.column(fmt::format("d({})/d({})", probe, key));
    if (!column) return {};
    for (size_t i = 0; i < sum.size(); ++i) {
      sum[i] += gradients.rows[i][*column];
      if (!std::isfinite(sum[i])) return {};
    }
  }
  return sum;
}

}  // namespace tack
