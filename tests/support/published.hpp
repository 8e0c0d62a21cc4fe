// Records that one term publishes, by name (framework/core/records.hpp).
#pragma once

#include <stdexcept>

#include "framework/core/records.hpp"

namespace tack {

class Published {
 public:
  explicit Published(const Term& term) { records_.publish(term); }

  VecX forces(const VecX& x, std::string_view part = "") const {
    VecX sum = VecX::Zero(x.size());
    for (const ForceRecord& r : records_.forces())
      if (r.has(part)) r.add(x, part, sum);
    return sum;
  }
  Vec3 force_between(const VecX& x, std::string_view part, ObjectPair pair) const {
    Vec3 sum = Vec3::Zero();
    for (const ForceRecord& r : records_.forces())
      if (r.has(part)) sum += r.between(x, part, pair);
    return sum;
  }
  double flow(const std::string& column, const VecX& x) const {
    double sum = 0;
    for (const FlowRecord& r : records_.flows()) {
      std::vector<double> amounts(r.columns.size());
      r.amounts(x, amounts.data());
      for (size_t i = 0; i < amounts.size(); ++i)
        sum += r.columns[i].name == column ? amounts[i] : 0;
    }
    return sum;
  }
  VecX field(const std::string& name, const VecX& x = {}) const {
    for (const FieldRecord& r : records_.fields())
      if (r.name == name) return r.values(x);
    throw std::logic_error("no field " + name);
  }

 private:
  Records records_;
};

}  // namespace tack
