#include "framework/assembly/dual2.hpp"

#include <catch2/catch.hpp>
#include <functional>

#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

struct Function {
  const char* name;
  std::function<Dual2(const Dual2&)> dual;
  std::function<double(double)> plain;
};

const std::vector<Function> functions = {
    {"-x", [](const Dual2& x) { return -x; }, [](double x) { return -x; }},
    {"3 + x", [](const Dual2& x) { return Dual2(3) + x; }, [](double x) { return 3 + x; }},
    {"x x - 2 x", [](const Dual2& x) { return x * x - Dual2(2) * x; }, [](double x) { return x * x - 2 * x; }},
    {"1 / x", [](const Dual2& x) { return reciprocal(x); }, [](double x) { return 1 / x; }},
    {"(x + 1) / (x x)", [](const Dual2& x) { return (x + Dual2(1)) / (x * x); },
     [](double x) { return (x + 1) / (x * x); }},
    {"log", [](const Dual2& x) { return log(x); }, [](double x) { return std::log(x); }},
    {"exp", [](const Dual2& x) { return exp(x); }, [](double x) { return std::exp(x); }},
    {"sqrt", [](const Dual2& x) { return sqrt(x); }, [](double x) { return std::sqrt(x); }},
    {"pow 2.7", [](const Dual2& x) { return pow(x, 2.7); }, [](double x) { return std::pow(x, 2.7); }},
    {"pow -1.5", [](const Dual2& x) { return pow(x, -1.5); }, [](double x) { return std::pow(x, -1.5); }},
    {"sin", [](const Dual2& x) { return sin(x); }, [](double x) { return std::sin(x); }},
    {"cos", [](const Dual2& x) { return cos(x); }, [](double x) { return std::cos(x); }},
    {"tanh", [](const Dual2& x) { return tanh(x); }, [](double x) { return std::tanh(x); }},
    {"exp(-sin(x) x) / sqrt(1 + x x)",
     [](const Dual2& x) { return exp(-sin(x) * x) / sqrt(Dual2(1) + x * x); },
     [](double x) { return std::exp(-std::sin(x) * x) / std::sqrt(1 + x * x); }},
};

}  // namespace

TEST_CASE("dual numbers: value, slope and curvature of every function", "[assembly]") {
  for (const Function& f : functions) {
    for (const double x : {0.1, 0.7, 1.0, 2.3}) {
      INFO(f.name << " at " << x);
      const Dual2 y = f.dual(Dual2::variable(x));
      const double h = 1e-3 * x;
      CHECK(y.v == Approx(f.plain(x)).epsilon(1e-14));
      CHECK(y.d1 == Approx(central_difference([&](double e) { return f.plain(x + e); }, h)).epsilon(1e-8).margin(1e-10));
      CHECK(y.d2 == Approx(central_difference([&](double e) { return f.dual(Dual2::variable(x + e)).d1; }, h))
                        .epsilon(1e-8).margin(1e-10));
    }
  }
}

TEST_CASE("dual numbers: order is that of the values; constants have no derivatives", "[assembly]") {
  CHECK(Dual2(1, 5, 0) < Dual2(2, -5, 0));
  CHECK(Dual2(2) > Dual2(1, 9, 9));
  const Dual2 c = Dual2(3) * Dual2(4);
  CHECK((c.v == 12 && c.d1 == 0 && c.d2 == 0));
}
