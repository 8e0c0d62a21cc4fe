// Every registered component of a kind, with every option of its choices: tests that run over them
// cover a new component because it exists.
#pragma once

#include <catch2/catch.hpp>
#include <map>
#include <string>
#include <utility>
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

using Setting = std::vector<std::pair<std::string, std::string>>;  // keys and values

// Returns each combination of options; a required field has the value of a new instance.
std::vector<Setting> settings_of(const Fields& fields);

// "{type: fang, form: plain, young: 1e5}"; fields of the extra replace those of the component.
std::string flow_map(const std::string& type, const Setting& setting,
                     const std::map<std::string, std::string>& extra);

// The keys of an extra setting are all fields of the component.
bool applies(const std::map<std::string, std::string>& extra, const Fields& fields);

}  // namespace detail

// `extras`: settings to try on the components that have such fields. A component that no extra
// makes valid fails the test. Components that are no Sort are skipped.
template <class Base, class Sort = Base>
std::vector<ComponentVariant> variants(
    const std::vector<std::map<std::string, std::string>>& extras = {{}}) {
  std::vector<ComponentVariant> all;
  const Kind& kind = Registry<Base>::kind();
  for (const std::string& name : kind.names()) {
    if (!dynamic_cast<const Sort*>(Registry<Base>::make(name).get())) continue;
    const Fields fields = kind.prototype(name);
    for (const detail::Setting& setting : detail::settings_of(fields)) {
      const size_t before = all.size();
      for (const auto& extra : extras) {
        if (!detail::applies(extra, fields)) continue;
        const std::string yaml = detail::flow_map(name, setting, extra);
        try {
          bind_component<Base>(parse_string(yaml, "test.yaml"));
          all.push_back({name, yaml});
        } catch (const InputError&) {
          // these fields do not go together; another extra must
        }
      }
      INFO(kind.name() << " " << detail::flow_map(name, setting, {})
                       << " binds with none of the extra settings");
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
