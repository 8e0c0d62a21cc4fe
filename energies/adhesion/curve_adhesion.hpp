// Adhesion law given by a traction curve. Energy, traction and slope are exact for the curve.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <string>

#include "framework/contact/normal_law.hpp"
#include "geometry/curves/cubic_curve.hpp"
#include "geometry/errors.hpp"

namespace tack {

// Throws InputError, with a message that begins with `what`, unless the curve [Pa over m] is one of
// adhesion: its integral is a pull, and its peak lies beyond the contact distance. Unless `cut`,
// the curve must end with (almost) zero traction.
void check_traction(const CubicCurve& curve, bool cut, double contact_distance,
                    const std::string& what);

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
  // The curve begins at the gap 0.
  void set(CubicCurve curve) {
    peak_ = curve.largest().value;
    curve_ = std::make_shared<const CubicCurve>(std::move(curve));
  }

 private:
  std::shared_ptr<const CubicCurve> curve_;
  double peak_ = 0;  // Pa
};

}  // namespace tack
