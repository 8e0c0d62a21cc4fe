// Motion by formulas: x = reference + (x(t, X, Y, Z), y(t, X, Y, Z), z(t, X, Y, Z)) [m]; t is the
// time [s], X, Y, Z the rest position [m].
#include <fmt/format.h>

#include <cmath>

#include "framework/config/formula.hpp"
#include "framework/motion/motion.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const std::vector<std::string> variables = {"t", "X", "Y", "Z"};

class FormulaMotion : public Motion {
 public:
  void fields(Fields& f) override {
    for (int i = 0; i < 3; ++i) {
      const std::string key(1, "xyz"[i]);
      f.text(key, text_[i], "displacement along " + key + " from the position at `from` [m]: a formula of t [s] and "
                                                          "the rest position X, Y, Z [m]").formula(variables);
      f.check(key, [this, i] { return compile(i); });
    }
    Motion::fields(f);
  }
  void set_positions(std::span<const int> vertices, const VecX& rest, const VecX& reference, double t,
             VecX& x) const override {
    for (const int v : vertices) {
      const Vec3 r = vertex(rest, v);
      for (int i = 0; i < 3; ++i) {
        const double d = formula_[i](std::array{t, r.x(), r.y(), r.z()});
        if (!(std::abs(d) <= 1e100))
          throw SimulationError(fmt::format("{}: '{}' is {} at t = {:.6g} s, X = {}, Y = {}, Z = {}; it must be finite and at "
                                            "most 1e100 m", "xyz"[i], text_[i], d, t, r.x(), r.y(), r.z()));
        x(3 * v + i) = reference(3 * v + i) + d;
      }
    }
  }
  bool rigid() const override { return false; }

 private:
  std::string compile(int i) {
    try {
      formula_[i] = Formula(text_[i], variables);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  std::array<std::string, 3> text_ = {"0", "0", "0"};
  std::array<Formula, 3> formula_ = {Formula("0", variables), Formula("0", variables),
                                     Formula("0", variables)};
};

TACK_REGISTER(Motion, FormulaMotion, "formula", "Moves each vertex by formulas of time and rest position.", "");

}  // namespace
}  // namespace tack
