// Every registered component of a kind, with every option of its choices: tests that run over them
// cover a new component because it exists.
#pragma once

#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <vector>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"

namespace tack {

struct ComponentVariant {
  std::string type;
  std::string yaml;  // a component in flow style
};

namespace detail {

// "young: 1e5, form: plain" with each combination of options; a required field takes the value
// that a fresh instance has.
std::vector<std::string> settings_of(const Fields& fields);

// The keys of an extra setting are all fields of the component.
bool applies(const std::map<std::string, std::string>& extra, const Fields& fields);

}  // namespace detail

// `extras`: settings to try on the components that have such fields. A component that no extra
// makes valid fails the test.
template <class Base>
std::vector<ComponentVariant> variants(const std::vector<std::map<std::string, std::string>>& extras = {{}}) {
  std::vector<ComponentVariant> all;
  const Kind& kind = Registry<Base>::kind();
  for (const std::string& name : kind.names()) {
    const Fields fields = kind.prototype(name);
    for (const std::string& setting : detail::settings_of(fields)) {
      const size_t before = all.size();
      for (const auto& extra : extras) {
        if (!detail::applies(extra, fields)) continue;
        std::string yaml = "{type: " + name + setting;
        for (const auto& [key, value] : extra) yaml += ", " + key + ": " + value;
        yaml += "}";
        try {
          bind_component<Base>(parse_string(yaml, "test.yaml"));
          all.push_back({name, yaml});
        } catch (const InputError&) {
          // these fields do not go together; another extra must
        }
      }
      INFO(kind.name() << " '" << name << "'" << setting << " binds with none of the extra settings");
      REQUIRE(all.size() > before);
    }
  }
  return all;
}

template <class Base>
std::unique_ptr<Base> component(const std::string& yaml) {
  return bind_component<Base>(parse_string(yaml, "test.yaml"));
}

}  // namespace tack
