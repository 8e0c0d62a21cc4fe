// Term of linear elements, `Base` (SolidTerm, MembraneTerm), whose material is infinite from a
// limit of the deformation on. The material has
//   LimitUse limit_use(std::span<const double> stretches) const;   principal stretches, descending
//   static constexpr LimitNames limit_names;
#pragma once

#include <fmt/format.h>

#include <Eigen/SVD>
#include <algorithm>
#include <span>

#include "framework/core/limit_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

/// Value of the limited quantity, and its limit.
struct LimitUse {
  double value = 0, limit = 0;
};

/// The limited quantity, and the key of its limit in scenes.
struct LimitNames {
  const char* quantity;
  const char* key;
};

/// Element: the vertices of one element.
template <class Base, class Element>
class LimitedTerm : public Base, public LimitView {
 public:
  using Base::Base;

  std::optional<ExceededLimit> exceeded_limit(const VecX& x) const override {
    constexpr double rounding = 1e-9;  // of the strains of single elements, relative to the limit
    const StencilBatch batch = this->batches().front();
    std::optional<ExceededLimit> worst;
    double most = 1 - rounding;
    for (int t = 0; t < this->count(); ++t) {
      Element element;
      std::copy_n(batch.vertices + batch.arity * static_cast<size_t>(t), batch.arity,
                  element.begin());
      const auto f = deformation_gradient(this->rest_of(t), element, x);
      const auto stretches =
          Eigen::JacobiSVD<std::remove_cvref_t<decltype(f)>>(f).singularValues().eval();
      const LimitUse use = this->material_.limit_use(
          std::span<const double>(stretches.data(), static_cast<size_t>(stretches.size())));
      if (!(use.value / use.limit >= most)) continue;
      most = use.value / use.limit;
      worst = {{element.begin(), element.end()},
               fmt::format("would have {} {:.6g}, and {} allows less than {:.6g} (`{}`)",
                           this->material_.limit_names.quantity, use.value, this->name(), use.limit,
                           this->material_.limit_names.key)};
    }
    return worst;
  }
};

}  // namespace tack
