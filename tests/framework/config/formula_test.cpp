#include "framework/config/formula.hpp"

#include <catch2/catch.hpp>

#include "framework/config/field.hpp"
#include "framework/config/reader.hpp"
#include "framework/output/derived_probe.hpp"
#include "geometry/errors.hpp"
#include "tests/framework/config/toy.hpp"

using namespace tack;
using Catch::Contains;
using toy::message_of;

namespace {

constexpr const char* advice = "did you mean `==`?";

// All that the component finds wrong once one of its texts is this.
std::string complaints(const Kind& kind, const std::string& name, const std::string& key, const std::string& text) {
  const std::unique_ptr<Component> component = kind.entry(name).factory();
  Fields fields;
  component->fields(fields);
  Reader reader;
  const Field& field = *fields.find(key);
  field.read(Value::scalar(text), field, reader);
  std::string all = message_of([&] { reader.finish(); });
  for (const Fields::Check& check : fields.checks()) all += check.condition();
  if (auto* probe = dynamic_cast<DerivedProbe*>(component.get())) all += message_of([&] { probe->find({}); });
  return all;
}

}  // namespace

TEST_CASE("formulas compare, and assign nothing") {
  const std::vector<std::string> variables = {"x", "t"};
  const auto value = [&](const std::string& text) { return Formula(text, variables)(std::array{2.0, 3.0}); };
  CHECK(value("x == 2") == 1);
  CHECK(value("x==1 || t!=3") == 0);
  CHECK(value("(x >= 2) + (x <= 1) + (t > 2) + (t < 2)") == 2);
  CHECK(value("t <= 3 ? 5 : 7") == 5);
  for (const char* text : {"x = 1", "t=1 ? 0.01 : 0", "(x = 5000) * t", "x=-1", "x = = 2", "x => 2", "="})
    CHECK_THAT(message_of([&] { value(text); }), Contains(advice) && Contains("formula '" + std::string(text) + "'"));
  CHECK_THAT(message_of([&] { value("t + (x = 5)"); }), Contains("(position 7)"));
}

TEST_CASE("no component takes an assignment for a formula") {
  int formulas = 0;
  for (const Kind* kind : registered_kinds()) {
    kind->complete();
    for (const std::string& name : kind->names()) {
      const Fields fields = kind->prototype(name);
      for (const Field& field : fields.all()) {
        if (!field.variables) continue;
        const std::string& variable = field.variables->front();
        INFO(kind->name() << " " << name << ": " << field.key);
        CHECK_THAT(complaints(*kind, name, field.key, variable + " = 1"), Contains(advice));
        CHECK_THAT(complaints(*kind, name, field.key, variable + " == 1"), !Contains(advice));
        ++formulas;
      }
    }
  }
  CHECK(formulas > 10);
}
