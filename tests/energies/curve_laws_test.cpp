// Laws as tables and as formulas.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "framework/checks/law_check.hpp"
#include "framework/contact/normal_law.hpp"
#include "tests/support/gap_law.hpp"
#include "tests/support/program.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

namespace {

void check_silent(const NormalAdhesion& law) {
  const LawCheck check = check_law(law);
  CHECK(check.errors == std::vector<Warning>{});
  CHECK(check.warnings == std::vector<Warning>{});
}

class TableFile {
 public:
  explicit TableFile(const std::string& text) { write_file(path(), text); }
  std::string path() const { return (folder_.path() / "law.csv").string(); }
  std::string yaml(const std::string& more = "") const { return fmt::format("{{type: table, file: '{}'{}}}", path(), more); }

 private:
  TemporaryFolder folder_;
};

// Rows of a law up to its range.
std::string rows_of(const NormalLaw& law, int rows, bool with_peak, double peak_gap) {
  std::vector<double> gaps;
  for (int i = 0; i < rows; ++i) gaps.push_back(law.range() * i / (rows - 1));
  if (with_peak) gaps.push_back(peak_gap);
  std::sort(gaps.begin(), gaps.end());
  gaps.erase(std::unique(gaps.begin(), gaps.end()), gaps.end());
  std::string text = "gap [um],traction [kPa]\n";
  for (const double gap : gaps) text += fmt::format("{},{}\n", 1e6 * gap, gap > 0 ? 1e-3 * law.at(gap).slope : 0.0);
  return text;
}

struct Accuracy {
  double traction = 0, peak = 0, work = 0;  // relative
};
Accuracy compare(const NormalAdhesion& law, const NormalAdhesion& exact) {
  Accuracy a;
  for (int i = 1; i < 100000; ++i) {
    const double d = exact.range() * i / 100000;
    a.traction = std::max(a.traction, std::abs(law.at(d).slope - exact.at(d).slope) / exact.peak_traction());
  }
  a.peak = std::abs(law.peak_traction() / exact.peak_traction() - 1);
  a.work = std::abs(law.work_of_adhesion() / exact.work_of_adhesion() - 1);
  return a;
}

}  // namespace

TEST_CASE("a table of 200 rows reproduces its law", "[laws]") {
  struct Case {
    const char* form;
    bool with_peak;
    Accuracy most;
  };
  const Case cases[] = {{"plain", false, {5.5e-3, 5.5e-3, 1e-5}}, {"plain", true, {8e-4, 1e-9, 5e-6}}, {"squared", false, {5e-3, 1e-5, 2e-5}}, {"squared", true, {2e-3, 1e-5, 1e-5}}};
  for (const Case& c : cases) {
    INFO(c.form << (c.with_peak ? ", with a row at the kink" : ""));
    const auto fang = law_of(fmt::format("{{type: fang, form: {}, peak_traction: 3 kPa, peak_distance: 1 mm, range: 2 mm}}", c.form));
    const TableFile file(rows_of(*fang, 200, c.with_peak, 1e-3));
    const auto table = law_of(file.yaml());
    const Accuracy a = compare(*table, *fang);
    CHECK(a.traction < c.most.traction);
    CHECK(a.peak < c.most.peak);
    CHECK(a.work < c.most.work);
    CHECK(table->range() == Approx(2e-3).epsilon(1e-12));
    check_silent(*table);
  }
}

TEST_CASE("tables of two rows and of 20000, of micrometres and MPa, of centimetres and Pa", "[laws]") {
  const auto ramp = law_of(TableFile("gap [um],traction [MPa]\n0,2\n4,0\n").yaml(), 1e-8);
  CHECK(ramp->peak_traction() == Approx(2e6));
  CHECK(ramp->work_of_adhesion() == Approx(4));
  CHECK(ramp->at(1e-6).slope == Approx(1.5e6));
  CHECK(ramp->at(1e-6).value == Approx(-2.25));
  CHECK(ramp->at(1e-6).curvature == Approx(-5e11));
  const auto wide = law_of(TableFile("gap [cm],traction [Pa]\n0,0\n1,20\n2,30\n3,10\n4,0\n").yaml(), 1e-3);
  CHECK(wide->range() == 0.04);
  CHECK(wide->peak_traction() == 30);
  check_silent(*wide);
  const auto xu = law_of("{type: xu_needleman, peak_traction: 5 MPa, peak_distance: 3 um}");
  const TableFile many(rows_of(*xu, 20000, false, 0));
  const auto law = law_of(many.yaml());
  const Accuracy a = compare(*law, *xu);
  CHECK(a.traction < 1e-6);
  CHECK(a.peak < 1e-6);
  CHECK(a.work < 1e-6);
  check_silent(*law);
}

TEST_CASE("below its first gap the traction of a table continues with a continuous slope", "[laws]") {
  const auto law = law_of(TableFile("gap [mm],traction [kPa]\n0.2,1\n0.5,2\n1,0\n").yaml());
  CHECK(law->at(0.1e-3).slope == Approx(1e3));
  CHECK(std::abs(law->at(0.2001e-3).curvature) < 1e-2 * std::abs(law->at(0.4e-3).curvature));
  check_silent(*law);
}

TEST_CASE("errors of a table are reported with the row", "[laws]") {
  const auto error = [](const std::string& rows, const std::string& more = "", double contact_distance = 1e-6) {
    return error_of(TableFile("gap [mm],traction [kPa]\n" + rows).yaml(more), contact_distance);
  };
  CHECK_THAT(error("1,1\n"), Contains("has one row of gaps and tractions; a curve needs two"));
  CHECK_THAT(error(""), Contains("has no row"));
  CHECK_THAT(error("0,1\n2,1\n1,0\n"), Contains("law.csv:4: the gap 0.001 m is not above that of the row before, 0.002 m"));
  CHECK_THAT(error("0,1\n1,1\n1,0\n"), Contains("law.csv:4:") && Contains("keep one of those with equal gaps"));
  CHECK_THAT(error("-1,1\n1,0\n"), Contains("law.csv:2: the gap -0.001 m is negative"));
  CHECK_THAT(error("0,nan\n1,0\n"), Contains("law.csv:2: traction 'nan' is not finite"));
  CHECK_THAT(error("0,1\n1,0.5\n"), Contains("its traction ends with 500 Pa at 0.001 m, 50% of the largest") && Contains("cut: true"));
  CHECK_THAT(error("0,0\n1,1\n4,0\n", "", 2e-3), Contains("its traction peaks at 0.001 m, below the contact distance 0.002 m"));
  CHECK_THAT(error("0,-2\n1,-1\n4,0\n"), Contains("pushes more than it pulls"));
  CHECK_THAT(error("0,0\n1,0\n"), Contains("pushes more than it pulls"));
  CHECK_THAT(error("0,0\n1,1\n4,0\n", ", smooth: 1 um"), Contains("within 1e-06 m of a row there is no other one"));
  CHECK_THAT(error("0,0\n1,1\n4,0\n", ", smooth: 0"), Contains("must be positive"));
  CHECK_THAT(error_of("{type: table}"), Contains("missing key 'file'"));
  CHECK_THAT(error_of("{type: table, file: /nowhere.csv}"), Contains("/nowhere.csv: cannot read this file"));
}

TEST_CASE("a traction that ends with a jump is accepted if the scene says so, with a warning", "[laws]") {
  const auto law = law_of(TableFile("gap [mm],traction [kPa]\n0,1\n1,1\n").yaml(", cut: true"));
  CHECK(law->work_of_adhesion() == Approx(1));
  CHECK(law->at(0.9999e-3).value == Approx(-1e-4));  // its energy does not jump
  const LawCheck check = check_law(*law);
  CHECK_THAT(only_text(check.warnings, WarningKind::law_traction_jump), Contains("1000 Pa"));
}

TEST_CASE("noise in a table gives a warning, and smoothing keeps the work", "[laws]") {
  std::mt19937 random(7);
  std::normal_distribution<double> noise(0, 10);
  const auto xu = law_of("{type: xu_needleman, peak_traction: 1 kPa, peak_distance: 0.1 mm}");
  std::string text = "gap [mm],traction [Pa]\n";
  for (int i = 0; i <= 200; ++i) text += fmt::format("{},{}\n", 1.2 * i / 200, i == 0 || i == 200 ? 0 : xu->at(1.2e-3 * i / 200).slope + noise(random));
  const TableFile file(text);
  const auto rough = law_of(file.yaml());
  const LawCheck check = check_law(*rough);
  CHECK(check.errors.empty());
  CHECK_THAT(only_text(check.warnings, WarningKind::law_data), Contains("`smooth: "));
  const auto even = law_of(file.yaml(", smooth: 0.05 mm"));
  check_silent(*even);
  CHECK(even->work_of_adhesion() == Approx(rough->work_of_adhesion()).epsilon(1e-12));
  CHECK(even->peak_traction() == Approx(1e3).epsilon(0.04));
  CHECK(compare(*even, *xu).traction < 0.06);
}

TEST_CASE("expressions of the traction and of the energy give their law", "[laws]") {
  const auto xu = law_of("{type: xu_needleman, peak_traction: 2 kPa, peak_distance: 0.3 mm}");
  for (const char* yaml : {"{type: expression, traction: s * d / l * exp(1 - d / l), parameters: {s: 2 kPa, l: 0.3 mm}, range: 6 mm}",
                           "{type: expression, energy: 17 - s * exp(1) * (l + d) * exp(-d / l), parameters: {s: 2 kPa, l: 300 um}, range: 6 mm}"}) {
    INFO(yaml);
    const auto law = law_of(yaml);
    for (const double u : {0.01, 0.3, 1.0, 2.0, 5.0, 8.5}) {  // before that one's end
      const LawSample s = law->at(u * 0.3e-3), exact = xu->at(u * 0.3e-3);
      CHECK(s.slope == Approx(exact.slope).margin(3e-6 * 2e3));
      CHECK(s.value == Approx(exact.value).margin(2e-6 * xu->work_of_adhesion()));
      CHECK(s.curvature == Approx(exact.curvature).margin(1e-3 * 2e3 / 0.3e-3));
    }
    CHECK(law->peak_traction() == Approx(2e3).epsilon(2e-6));
    CHECK(law->work_of_adhesion() == Approx(xu->work_of_adhesion()).epsilon(2e-6));
    CHECK_THAT(law->note(), Contains(" knots to within "));
    check_silent(*law);
  }
}

TEST_CASE("kinks of expressions by min, max and conditions are found", "[laws]") {
  const char* numbers = "parameters: {s: 3 MPa, a: 1.1 um, b: 3.7 um}, range: 3.7 um}";
  for (const char* formula : {"traction: 's * max(0, min(d / a, (b - d) / (b - a)))'", "traction: 'd < a ? s * d / a : s * (b - d) / (b - a)'",
                              "energy: 'd < a ? s * (d^2 / (2 * a) - b / 2) : -s * (b - d)^2 / (2 * (b - a))'"}) {
    INFO(formula);
    const auto law = law_of(fmt::format("{{type: expression, {}, {}", formula, numbers), 1e-7);
    CHECK(law->peak_traction() == Approx(3e6).epsilon(1e-5));
    CHECK(law->work_of_adhesion() == Approx(3e6 * 3.7e-6 / 2).epsilon(1e-6));
    for (const double d : {0.3e-6, 1.0999e-6, 1.1001e-6, 2e-6, 3.69e-6})
      CHECK(law->at(d).slope == Approx(3e6 * std::min(d / 1.1e-6, (3.7e-6 - d) / 2.6e-6)).margin(3e6 * 4e-6));
    check_silent(*law);
  }
}

TEST_CASE("expressions do not depend on their scale", "[laws]") {
  struct Scale {
    const char *strength, *length, *range;
    double s, l, contact_distance;
  };
  for (const Scale& c : {Scale{"5 MPa", "2 um", "40 um", 5e6, 2e-6, 1e-7}, Scale{"20 Pa", "3 cm", "60 cm", 20, 0.03, 1e-3}, Scale{"0.4 GPa", "0.3 nm", "6 nm", 4e8, 3e-10, 1e-11}}) {
    INFO(c.strength);
    const auto law = law_of(fmt::format("{{type: expression, traction: s * d / l * exp(1 - d / l), parameters: {{s: {}, l: {}}}, range: {}}}", c.strength, c.length, c.range),
                            c.contact_distance);
    CHECK(law->peak_traction() == Approx(c.s).epsilon(2e-6));
    CHECK(law->work_of_adhesion() == Approx(std::numbers::e * c.s * c.l).epsilon(2e-6));
    check_silent(*law);
  }
}

TEST_CASE("errors of an expression are reported", "[laws]") {
  const auto error = [](const std::string& more, double contact_distance = 1e-6) { return error_of("{type: expression, range: 1 mm, " + more + "}", contact_distance); };
  CHECK_THAT(error_of("{type: expression, traction: 1 - 1000 * d}"), Contains("missing key 'range'"));
  CHECK_THAT(error("cut: true"), Contains("give the law as traction or as energy"));
  CHECK_THAT(error("traction: d, energy: d"), Contains("goes without energy: drop one of them"));
  CHECK_THAT(error("traction: 's * (1 - d / 1e-3', parameters: {s: 1 kPa}"), Contains("traction: formula 's * (1 - d / 1e-3'") && Contains("(position 18)"));
  CHECK_THAT(error("traction: 'k * d', parameters: {}"), Contains("\"k\"") && Contains("(position 0)"));
  CHECK_THAT(error("traction: '1 - 1e3 * d', parameters: {s: 1 kPa}"), Contains("'s' does not occur in the formula"));
  CHECK_THAT(error("traction: '1 - 1e3 * d', parameters: {d: 1 kPa}"), Contains("'d' is the gap already"));
  CHECK_THAT(error("traction: '1 - 1e3 * d', parameters: {a b: 1 kPa}"), Contains("'a b' cannot stand in a formula"));
  CHECK_THAT(error("traction: 's - 1e3 * d', parameters: {s: 1 stone}"), Contains("parameters 's'"));
  CHECK_THAT(error("traction: '1e-3 / d - 1'"), Contains("adhesion expression: traction: '1e-3 / d - 1' is inf at d = 0 m") && Contains("max(d, 1e-6)"));
  CHECK_THAT(error("energy: 'log(d)'"), Contains("energy: 'log(d)' is -inf at d = 0 m"));
  CHECK_THAT(error("traction: 'exp(-d / 1e-3)'"), Contains("its traction ends with 0.3679 Pa at 0.001 m, 37% of the largest"));
  CHECK_THAT(error("traction: 'd < 0.3e-3 ? 1 : 0'"), Contains("jumps between d = 0.0003 and 0.0003 m"));
  CHECK_THAT(error("energy: 'd < 0.3e-3 ? -1 : 0'"), Contains("jumps"));
  CHECK_THAT(error("traction: '1 / (d - 0.4e-3)'"), Contains("jumps"));
  CHECK_THAT(error("traction: 'd * (1e-3 - d)'", 0.7e-3), Contains("its traction peaks at 0.0005 m, below the contact distance"));
}

TEST_CASE("a stored expression, in SI units, gives an equal law", "[laws]") {
  const auto law = law_of("{type: expression, traction: s * (1 - d / r)^2, parameters: {s: 3 kPa, r: 0.2 mm}, range: 0.2 mm}");
  const Value stored = to_value(law.get());
  CHECK(value_at(stored, "parameters.s")->text == "3000");
  const std::unique_ptr<NormalAdhesion> again(dynamic_cast<NormalAdhesion*>(bind_component<AdhesionLaw>(stored).release()));
  again->prepare({.contact_distance = 1e-6});
  CHECK(again->range() == law->range());
  for (const double u : {0.1, 0.6, 0.99}) CHECK(again->at(u * law->range()).value == law->at(u * law->range()).value);
}

TEST_CASE("an expression without an end is truncated if the scene says so", "[laws]") {
  const auto law = law_of("{type: expression, traction: exp(-d / 1e-3), range: 1 mm, cut: true}");
  CHECK(law->work_of_adhesion() == Approx(1e-3 * (1 - std::exp(-1.0))).epsilon(1e-6));
  const LawCheck check = check_law(*law);
  only_text(check.warnings, WarningKind::law_traction_jump);
}

TEST_CASE("a curve that misses the expression is reported", "[laws]") {
  const auto law = law_of("{type: expression, traction: (1 - d / 1e-3) * (2 + 2e-4 * sin(3e7 * d)), range: 1 mm}");
  const LawCheck check = check_law(*law);
  CHECK_THAT(first_text(check.warnings, WarningKind::law_data), Contains("4096 knots follow it to within"));
}
