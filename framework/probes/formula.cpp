// Probe of a formula of other probes.
#include <fmt/format.h>

#include <cctype>

#include "framework/config/formula.hpp"
#include "framework/output/derived_probe.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

bool is_variable(const std::string& name) {
  if (name.empty() || std::isdigit(static_cast<unsigned char>(name.front()))) return false;
  return std::all_of(name.begin(), name.end(), [](unsigned char c) { return c < 0x80 && (std::isalnum(c) || c == '_'); });
}

class FormulaProbe : public DerivedProbe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("of", text_, "formula of columns of earlier probes and of the time t [s]: `force / (0.1 * 0.1)`").required().formula({"t"});
    f.text("unit", unit_, "unit of the result, as `mN`; the column has the SI unit; dimensionless unless given");
    f.check("unit", [this] { return check_unit(); });
  }
  Unit unit() const override {
    if (si_.empty()) si_ = unit_.empty() ? units::none.si : si_unit(unit_);
    return {si_, "number"};
  }

  void find(const std::vector<std::string>& columns) override {
    std::vector<std::string> variables{"t"};
    value_indices_ = {0};
    for (size_t i = 0; i < columns.size(); ++i) {
      if (!is_variable(columns[i]) || columns[i] == "t" || columns[i] == "pi") continue;
      variables.push_back(columns[i]);
      value_indices_.push_back(i + 1);
    }
    values_.resize(variables.size());
    zero_ = to_si("0 " + unit_, units::any);
    one_ = to_si("1 " + unit_, units::any) - zero_;
    try {
      formula_ = Formula(text_, variables);
    } catch (const InputError& error) {
      throw InputError(fmt::format("probe '{}': of: {} (probes that stand before it, of letters, digits and _: {})", name_, error.what(),
                                   fmt::join(variables, ", ")));
    }
  }
  double of(std::span<const double> values) const override {
    for (size_t i = 0; i < value_indices_.size(); ++i) values_[i] = values[value_indices_[i]];
    return zero_ + one_ * (*formula_)(values_);
  }

 private:
  std::string check_unit() const {
    try {
      if (!unit_.empty()) to_si("1 " + unit_, units::any);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  std::string text_, unit_;
  mutable std::string si_;     // SI unit of the same dimension
  double zero_ = 0, one_ = 1;  // 0 and 1 of the unit, in SI
  std::optional<Formula> formula_;
  std::vector<size_t> value_indices_;   // per variable: its index among the values
  mutable std::vector<double> values_;  // values of the variables
};

TACK_REGISTER(Probe, FormulaProbe, "formula", "A formula of other probes.", "");

}  // namespace
}  // namespace tack
