// Every registered normal law: energies, and energies with two derivatives, of 1024 gaps in its range.
#include <fmt/format.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"
#include "tests/bench/registered.hpp"

namespace tack::bench {
namespace {

constexpr int count = 1024;
// Parameters under which laws usually are complete, tried in this order.
constexpr std::array parameters = {", critical_strain: 0.5", ", peak_traction: 1 kPa", ""};

// Null if the law needs other parameters, or is no law of the gap.
template <class Kind>
std::shared_ptr<NormalLaw> prepared(const std::string& name) {
  for (const char* more : parameters) {
    try {
      std::shared_ptr<Kind> component = bind_component<Kind>(parse_string(fmt::format("{{type: {}{}}}", name, more), "bench"));
      const auto law = std::dynamic_pointer_cast<NormalLaw>(component);
      if (law) law->prepare({1e-3, 1e5, 0});
      return law;
    } catch (const InputError&) {
    }
  }
  return nullptr;
}

std::vector<double> gaps(double range) {
  std::vector<double> d(count);
  for (int i = 0; i < count; ++i) d[i] = range * (i + 0.5) / count;
  return d;
}

template <class Kind>
void law_values(benchmark::State& state, const std::string& name) {
  const auto law = prepared<Kind>(name);
  const auto d = gaps(law->range());
  std::vector<double> out(count, 0.0);
  for (auto _ : state) {
    law->add_values(count, d.data(), out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * count);
}

template <class Kind>
void law_samples(benchmark::State& state, const std::string& name) {
  const auto law = prepared<Kind>(name);
  const auto d = gaps(law->range());
  std::vector<LawSample> out(count);
  for (auto _ : state) {
    law->add_samples(count, d.data(), out.data());
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(state.iterations() * count);
}

template <class Kind>
void add_laws() {
  for (const std::string& name : Registry<Kind>::kind().names()) {
    if (!prepared<Kind>(name)) continue;
    const std::string path = fmt::format("{}/{}", Kind::kind_name, name);
    benchmark::RegisterBenchmark((path + "/values").c_str(),
                                 [name](benchmark::State& state) { law_values<Kind>(state, name); });
    benchmark::RegisterBenchmark((path + "/samples").c_str(),
                                 [name](benchmark::State& state) { law_samples<Kind>(state, name); });
  }
}

}  // namespace

void add_scalar_laws() {
  add_laws<BarrierLaw>();
  add_laws<AdhesionLaw>();
}

}  // namespace tack::bench
