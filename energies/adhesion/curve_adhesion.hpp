// An adhesion law whose traction is a curve: energy, traction and its slope are those of the curve, exactly.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>

#include "framework/contact/normal_law.hpp"
#include "geometry/curves/cubic_curve.hpp"
#include "geometry/errors.hpp"

namespace tack {

// Throws InputError, which begins with `what`, unless the curve is one of adhesion [Pa over m]: it pulls on the whole, and its peak can be felt
// beyond the contact distance. Unless `cut`, it also has to end with no traction, or next to none.
void check_traction(const CubicCurve& curve, bool cut, double contact_distance, const std::string& what);

template <class Law>
class CurveAdhesion : public NormalLawOf<Law, NormalAdhesion> {
 public:
  double range() const override { return curve_ ? curve_->last() : 0; }
  double peak_traction() const override { return peak_; }
  double work_of_adhesion() const override { return curve_ ? curve_->total() : 0; }

  double energy(double d) const { return -curve_->at(d).rest; }
  Dual2 energy(const Dual2& d) const {
    const CubicCurve::Sample s = curve_->at(d.v);
    return d.chain(-s.rest, s.value, s.slope);
  }

 protected:
  // From the gap 0 on.
  void set(CubicCurve curve) {
    peak_ = curve.largest().value;
    curve_ = std::make_shared<const CubicCurve>(std::move(curve));
  }

 private:
  std::shared_ptr<const CubicCurve> curve_;
  double peak_ = 0;  // Pa
};

}  // namespace tack
