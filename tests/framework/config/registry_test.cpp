#include "framework/config/registry.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <stdexcept>

#include "tests/framework/config/toy.hpp"

namespace tack::toy {

TACK_REGISTER(Energy, Sum, "toy_sum", "The sum of other energies.", "");
TACK_REGISTER(Energy, Spring, "toy_spring", "A linear spring.", "Hooke 1678, p. 1");
TACK_REGISTER(Energy, Nothing, "toy_nothing", "No energy.", "");
TACK_REGISTER(Energy, Solid, "toy_solid", "A solid with required parameters.", "");

}  // namespace tack::toy

using namespace tack;

namespace {

struct Unregistered : toy::Nothing {};

struct Impostor : Component {
  static constexpr const char* kind_name = "toy_energy";
  static constexpr const char* kind_doc = "Another kind of the same name.";
};

}  // namespace

TEST_CASE("a registry lists its components by name") {
  const Kind& kind = Registry<toy::Energy>::kind();
  CHECK(kind.name() == "toy_energy");
  CHECK(kind.doc() == "Energy of the tests.");
  CHECK(kind.names() ==
        std::vector<std::string>{"toy_nothing", "toy_solid", "toy_spring", "toy_sum"});
  const Kind::Entry& spring = kind.entry("toy_spring");
  CHECK(spring.doc == "A linear spring.");
  CHECK(spring.source == "Hooke 1678, p. 1");
  CHECK(spring.file == "tests/framework/config/registry_test.cpp");
}

TEST_CASE("a registry makes components that know their name") {
  const auto spring = Registry<toy::Energy>::make("toy_spring");
  CHECK(spring->type() == "toy_spring");
  CHECK(dynamic_cast<toy::Spring*>(spring.get()) != nullptr);
  CHECK(toy::Spring().type() == "toy_spring");
  CHECK(Unregistered().type() == "");
  CHECK(toy::message_of([] { Registry<toy::Energy>::make("spring"); }) ==
        "unknown toy_energy 'spring'; did you mean 'toy_spring'? (toy_energies: toy_nothing, "
        "toy_solid, toy_spring, toy_sum)");
}

TEST_CASE("a prototype keeps its component alive") {
  const Fields fields = Registry<toy::Energy>::kind().prototype("toy_spring");
  CHECK(fields.keys() == std::vector<std::string>{"stiffness", "rest", "range"});
  CHECK(fields.find("rest")->write().text == "0.25");
}

TEST_CASE("registering twice is an error") {
  Kind& kind = Registry<toy::Energy>::kind();
  const auto add = [&](const char* name, std::type_index type) {
    kind.add({name, "doc", "", "b.cpp", [] { return std::make_unique<Unregistered>(); }}, type);
  };
  CHECK_THROWS_WITH(add("toy_spring", typeid(Unregistered)),
                    "toy_energy 'toy_spring' is registered in "
                    "tests/framework/config/registry_test.cpp and again in b.cpp");
  CHECK_THROWS_WITH(add("toy_again", typeid(toy::Spring)),
                    "the class of toy_energy 'toy_again' (b.cpp) is already registered as "
                    "'toy_spring'");
  CHECK_THROWS_WITH(Registry<Impostor>::kind(), "two kinds of component are called 'toy_energy'");
  CHECK(kind.names().size() == 4);
}

TEST_CASE("registrations of a plugin are committed, or all removed if one is refused") {
  Kind& kind = Registry<toy::Energy>::kind();
  const auto add = [&](const char* name, std::type_index type) {
    kind.add({name, "doc", "", "plugin.cpp", [] { return std::make_unique<Unregistered>(); }}, type);
  };
  for (int once = 0; once < 2; ++once) {  // nothing is left of the first time
    PluginRegistrations plugin("/a/libmine.so");
    CHECK(plugin.empty());
    add("toy_mine", typeid(Unregistered));
    add("toy_spring", typeid(Impostor));
    CHECK_FALSE(plugin.empty());
    CHECK(plugin.errors() == std::vector<std::string>{"toy_energy 'toy_spring' is registered in "
                                                      "tests/framework/config/registry_test.cpp and again in plugin.cpp"});
    CHECK(kind.entry("toy_mine").plugin == "/a/libmine.so");
    CHECK(Unregistered().type() == "toy_mine");
  }
  CHECK(kind.names().size() == 4);
  CHECK(Unregistered().type() == "");
  CHECK_THROWS_AS(add("toy_spring", typeid(Impostor)), std::logic_error);  // the program's own again
}

TEST_CASE("registered kinds are sorted") {
  const auto kinds = registered_kinds();
  const auto by_name = [](const Kind* a, const Kind* b) { return a->name() < b->name(); };
  CHECK(std::is_sorted(kinds.begin(), kinds.end(), by_name));
  CHECK(std::count(kinds.begin(), kinds.end(), &Registry<toy::Energy>::kind()) == 1);
}

TEST_CASE("every registered component describes itself and accepts its own defaults") {
  for (const Kind* kind : registered_kinds()) {
    CHECK_FALSE(kind->doc().empty());
    for (const auto& [name, entry] : kind->entries()) {
      INFO(kind->name() << " '" << name << "' in " << entry.file);
      CHECK_THAT(entry.doc, Catch::EndsWith("."));
      const Fields fields = kind->prototype(name);
      for (const Field& f : fields.all()) {
        if (f.mandatory) continue;
        INFO("field " << f.key);
        Reader reader;
        f.read(f.write(), f, reader);
        CHECK_NOTHROW(reader.finish());
      }
    }
  }
}
