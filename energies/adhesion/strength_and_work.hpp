// Peak traction, work of adhesion and a length; two of them fix a law: W = shape * peak * length.
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"

namespace tack {

class StrengthAndWork {
 public:
  struct Numbers {
    double peak = 0, work = 0, length = 0;  // Pa, J/m^2, m
  };

  // key: scene key of the length; doc: its meaning and default.
  void fields(Fields& f, const std::string& key, const std::string& doc) {
    f.optional_number("peak_traction", peak_, units::pressure, "the strength: largest traction")
        .positive();
    f.optional_number("work_of_adhesion", work_, units::work_of_adhesion,
                      "energy to separate unit area")
        .positive();
    f.optional_number(key, length_, units::length, doc).positive();
    f.check("peak_traction", [this, key]() -> std::string {
      if (!peak_ && !work_) return "give peak_traction, work_of_adhesion, or both";
      return peak_ && work_ && length_ ? "peak_traction, work_of_adhesion and " + key +
                                             " are one too many: drop one of them"
                                       : "";
    });
  }

  Numbers resolve(double shape, double default_length) const {
    if (peak_ && work_) return {*peak_, *work_, *work_ / (shape * *peak_)};
    const double length = length_.value_or(default_length);
    return peak_ ? Numbers{*peak_, shape * *peak_ * length, length}
                 : Numbers{work_.value_or(0) / (shape * length), work_.value_or(0), length};
  }

 private:
  std::optional<double> peak_, work_, length_;
};

}  // namespace tack
