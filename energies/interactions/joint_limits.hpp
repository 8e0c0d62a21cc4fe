// Limits of a joint's coordinate q. Each gap g = q - low, high - q below a margin m has the
// potential
//     P = -K (g - m)^2 ln(g / m),
// the barrier of contact (Li et al. 2020, Incremental Potential Contact, eq. 6). P is infinite
// beyond the limit, so that no step ends there.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <memory>

#include "energies/interactions/joint_coordinate.hpp"
#include "framework/assembly/formula_term.hpp"
#include "framework/core/limit_view.hpp"

namespace tack {

// Returns the coordinate in the number type of a formula, with the whole turns that bring it
// nearest to `near`.
template <class Coordinate, class T>
T joint_coordinate(const std::array<Eigen::Matrix<T, 3, 1>, Coordinate::arity>& x, double offset,
                   double near) {
  const T plain = Coordinate::of(x) + offset;
  if constexpr (std::is_same_v<T, double>) return plain + Coordinate::turns(plain, near);
  else return plain + Coordinate::turns(plain.v, near);
}

template <class Coordinate>
struct JointLimit : FormulaOf<Coordinate::arity> {
  struct Data {
    double low, high, margin, stiffness, offset;  // of the coordinate; K [J per square of it]
    double near = 0;
  };
  template <class T>
  T energy(const std::array<Eigen::Matrix<T, 3, 1>, Coordinate::arity>& x, const Data& d) const {
    using std::log;
    const T q = joint_coordinate<Coordinate, T>(x, d.offset, d.near);
    T sum(0);
    for (const T& gap : {T(q - d.low), T(d.high - q)}) {
      if (gap >= T(d.margin)) continue;
      if (gap <= T(0)) return T(std::numeric_limits<double>::infinity());
      const T into = gap - d.margin;
      sum += -d.stiffness * into * into * log(gap / d.margin);
    }
    return sum;
  }
};

// Without limits the term only stores the coordinate, for probes.
template <class Coordinate>
class JointLimitTerm : public FormulaTerm<JointLimit<Coordinate>>, public LimitView {
 public:
  // joint: the joint's name; what, unit: of its coordinate.
  JointLimitTerm(std::shared_ptr<JointCoordinate<Coordinate>> coordinate, std::string joint,
                 std::string what, std::string unit)
      : FormulaTerm<JointLimit<Coordinate>>("joint_limits"), coordinate_(std::move(coordinate)),
        joint_(std::move(joint)), what_(std::move(what)), unit_(std::move(unit)) {}
  // stiffness: the force at half of the margin, over the margin and 1.193.
  void limit(double low, double high, double margin, double stiffness) {
    this->add(coordinate_->vertices(),
              {low, high, margin, stiffness, coordinate_->offset(), coordinate_->offset()});
  }
  const JointCoordinate<Coordinate>& coordinate() const { return *coordinate_; }

  std::optional<ExceededLimit> exceeded_limit(const VecX& x) const override {
    const double q = coordinate_->at(x);
    for (const auto& d : this->data()) {
      if (q > d.low && q < d.high) continue;
      const bool low = q <= d.low;
      return ExceededLimit{
          {},
          fmt::format(
              "joint '{}' would have the {} {:.6g} {}, and allows {} than {:.6g} {} (`limits.{}`)",
              joint_, what_, q, unit_, low ? "more" : "less", low ? d.low : d.high, unit_,
              low ? "low" : "high")};
    }
    return std::nullopt;
  }

  void load_history(const History& history) override {
    coordinate_->load_history(history);
    for (auto& d : this->data()) d.near = coordinate_->last();
  }
  void commit(const VecX& x, History& history) const override { coordinate_->commit(x, history); }

 private:
  std::shared_ptr<JointCoordinate<Coordinate>> coordinate_;
  std::string joint_, what_, unit_;
};

}  // namespace tack
