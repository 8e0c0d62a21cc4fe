// Xu-Needleman, Dugdale, Lennard-Jones against their closed forms.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "framework/checks/law_check.hpp"
#include "framework/contact/normal_law.hpp"
#include "tests/support/gap_law.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;
using std::numbers::e;

namespace {

// The largest traction and the work, found by evaluation alone: a fine scan, then a finer one around its best.
struct Measured {
  double peak = 0, peak_gap = 0, work = 0;
  explicit Measured(const NormalAdhesion& law) {
    scan(law, 0, law.range(), 100000);
    scan(law, peak_gap - 2e-5 * law.range(), peak_gap + 2e-5 * law.range(), 1000);
    work = law.at((1 - 1e-12) * law.range()).value - law.at(1e-12 * law.range()).value;
  }
  void scan(const NormalAdhesion& law, double from, double to, int n) {
    for (int i = 0; i < n; ++i) {
      const double d = from + (to - from) * (i + 0.5) / n;
      if (const double traction = law.at(d).slope; traction > peak) peak = traction, peak_gap = d;
    }
  }
};

// Returns the law, its end included.
void check_statements(const NormalAdhesion& law) {
  const Measured measured(law);
  CHECK(law.peak_traction() == Approx(measured.peak).epsilon(1e-6));
  CHECK(law.work_of_adhesion() == Approx(measured.work).epsilon(1e-6));
}

void check_silent(const NormalAdhesion& law) {
  const LawCheck check = check_law(law);
  for (const std::string& line : check.errors) FAIL_CHECK(line);
  CHECK(check.warnings == std::vector<Warning>{});
}

}  // namespace

TEST_CASE("Xu-Needleman: any two of strength, work and length", "[laws]") {
  const double work = 2e3 * e * 3e-4;
  for (const std::string& given : {std::string("peak_traction: 2 kPa, peak_distance: 0.3 mm"), fmt::format("peak_traction: 2 kPa, work_of_adhesion: {}", work),
                                   fmt::format("work_of_adhesion: {}, peak_distance: 0.3 mm", work)}) {
    INFO(given);
    const auto law = law_of("{type: xu_needleman, " + given + "}");
    CHECK(law->peak_traction() == Approx(2e3).epsilon(1e-12));
    CHECK(law->work_of_adhesion() == Approx(work).epsilon(1e-12));
    CHECK(law->range() == Approx(12 * 3e-4).epsilon(1e-12));
    for (const double u : {0.01, 0.5, 1.0, 3.0, 8.0}) {
      const LawSample s = law->at(u * 3e-4);
      CHECK(s.value == Approx(-work * (1 + u) * std::exp(-u)).epsilon(1e-12));
      CHECK(s.slope == Approx(2e3 * u * std::exp(1 - u)).epsilon(1e-9));
      CHECK(s.curvature == Approx(2e3 / 3e-4 * (1 - u) * std::exp(1 - u)).epsilon(1e-9).margin(1e-3));
    }
    check_statements(*law);
    check_silent(*law);
  }
}

TEST_CASE("Lennard-Jones: any two of strength, work and equilibrium gap, and the error of its taper", "[laws]") {
  const double z = 2e-9, work = 0.05, peak = 16 / (9 * std::sqrt(3.0)) * work / z;  // of solids: MPa over nm
  for (const std::string& given : {std::string("work_of_adhesion: 50 mJ/m^2, equilibrium_distance: 2 nm"), fmt::format("peak_traction: {}, work_of_adhesion: 0.05", peak),
                                   fmt::format("peak_traction: {}, equilibrium_distance: 2e-9", peak)}) {
    INFO(given);
    const auto law = law_of("{type: lennard_jones, " + given + "}", 1e-9);
    CHECK(law->peak_traction() == Approx(peak).epsilon(1e-12));
    CHECK(law->work_of_adhesion() == Approx(work).epsilon(1e-12));
    CHECK(law->at(0.5 * z).slope == 0);
    CHECK(law->at(0.5 * z).value == Approx(-work));
    for (const double u : {1.0001, std::pow(3, 1.0 / 6), 2.0, 7.0, 14.0}) {
      const LawSample s = law->at(u * z);
      CHECK(s.value == Approx(-work / 3 * (4 / (u * u) - std::pow(u, -8))).epsilon(1e-12));
      CHECK(s.slope == Approx(8 * work / (3 * z) * (std::pow(u, -3) - std::pow(u, -9))).epsilon(1e-8));
    }
    check_statements(*law);
    check_silent(*law);
    CHECK_THAT(law->note(), Contains("0.33% of its work would be done beyond its range"));
  }
  const auto far = law_of("{type: lennard_jones, work_of_adhesion: 1, equilibrium_distance: 1 um, range: 200 um}");  // its peak is narrow there
  check_statements(*far);
  check_silent(*far);
}

TEST_CASE("Dugdale: constant traction, zero beyond the range, and the work does not depend on the width of the fall", "[laws]") {
  for (const double spread : {0.001, 0.05, 0.5}) {
    INFO(spread);
    const auto law = law_of(fmt::format("{{type: dugdale, peak_traction: 2 kPa, work_of_adhesion: 1 J/m^2, spread: {}}}", spread));
    CHECK(law->range() == Approx((1 + spread) * 0.5e-3).epsilon(1e-12));
    CHECK(law->at(0.4 * law->range() / (1 + spread)).slope == Approx(2e3).epsilon(1e-12));
    CHECK(law->at(0.5e-3).slope == Approx(1e3).epsilon(1e-9));  // half way
    check_statements(*law);
    check_silent(*law);
  }
  const auto by_range = law_of("{type: dugdale, peak_traction: 2 kPa, range: 1.05 mm}");
  CHECK(by_range->work_of_adhesion() == Approx(2).epsilon(1e-12));
  CHECK(law_of("{type: dugdale, work_of_adhesion: 2 J/m^2, range: 1.05 mm}")->peak_traction() == Approx(2e3).epsilon(1e-12));
}

TEST_CASE("laws of the gap do not depend on their scale", "[laws]") {
  const std::pair<const char*, double> scales[] = {{"peak_traction: 5 MPa, work_of_adhesion: 20 J/m^2", 1e-7}, {"peak_traction: 20 Pa, work_of_adhesion: 0.5 J/m^2", 1e-3},
                                                   {"peak_traction: 100 MPa, work_of_adhesion: 0.1 J/m^2", 1e-10}};
  for (const char* type : {"xu_needleman", "dugdale", "lennard_jones"})
    for (const auto& [given, contact_distance] : scales) {
      INFO(type << " " << given);
      const auto law = law_of(fmt::format("{{type: {}, {}}}", type, given), contact_distance);
      check_statements(*law);
      check_silent(*law);
    }
}

TEST_CASE("the shortest allowed ranges keep peak and work", "[laws]") {
  for (const char* yaml : {"{type: xu_needleman, peak_traction: 1 kPa, peak_distance: 1 mm, range: 6 mm}", "{type: lennard_jones, peak_traction: 1 kPa, equilibrium_distance: 1 mm, range: 5 mm}"}) {
    INFO(yaml);
    const auto law = law_of(yaml);
    check_statements(*law);
    check_silent(*law);
  }
}

TEST_CASE("contradictory parameters are refused with a remedy", "[laws]") {
  CHECK_THAT(error_of("{type: xu_needleman}"), Contains("peak_traction: give peak_traction, work_of_adhesion, or both"));
  CHECK_THAT(error_of("{type: dugdale, peak_traction: 1, work_of_adhesion: 1, range: 1}"), Contains("one too many: drop one of them"));
  CHECK_THAT(error_of("{type: xu_needleman, peak_traction: 1 kPa, peak_distance: 0.5 mm}", 1e-3), Contains("below the contact distance 0.001 m") && Contains("lower peak_traction"));
  CHECK_THAT(error_of("{type: xu_needleman, peak_traction: 1 kPa, range: 4 mm}", 1e-3), Contains("less than 6 times 0.001 m"));
  CHECK_THAT(error_of("{type: lennard_jones, peak_traction: 1 kPa, equilibrium_distance: 0.5 mm}", 1e-3), Contains("the gap of equilibrium, 0.0005 m") && Contains("contact.distance"));
  CHECK_THAT(error_of("{type: lennard_jones, peak_traction: 1 kPa, range: 4 mm}", 1e-3), Contains("less than 5 times"));
  CHECK_THAT(error_of("{type: dugdale, peak_traction: 1 kPa, range: 1.01 mm}", 1e-3), Contains("falls from 0.000913") && Contains("within the contact distance"));
}
