// Every registered energy that a box of 10x10x10 nodes (4374 tets) can have, on a squeezed and uneven
// configuration: value, gradient, gradient with clamped Hessian, into the stencils' slots.
#include <fmt/format.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

struct Box {
  Body body;
  VecX rest, x;

  Box() {
    const Mesh mesh = box_tets(Vec3::Constant(0.2), {9, 9, 9});
    body.name = "box";
    body.vertex_count = static_cast<int>(mesh.vertices.size());
    body.tets = mesh.tets;
    rest.resize(3 * body.vertex_count);
    for (int i = 0; i < body.vertex_count; ++i) vertex(rest, i) = mesh.vertices[i];
    x = rest + random_motion(body.vertex_count, 1e-3);
    for (int i = 0; i < body.vertex_count; ++i) x(3 * i + 1) *= 0.8;
  }
};

// Null if the energy is not one of solids with the usual parameters.
std::unique_ptr<Term> solid_term(const std::string& name, const Box& box) {
  try {
    const Fields fields = Registry<Energy>::kind().prototype(name);
    const std::string text = fmt::format("{{type: {}, young: 0.1 MPa, poisson: 0.4, density: 1000{}}}", name,
                                         fields.find("yield_stress") ? ", yield_stress: 10 kPa" : "");
    return bind_component<Energy>(parse_string(text, "bench"))->make_term(box.body, box.rest);
  } catch (const InputError&) {
    return nullptr;
  }
}

enum class Order { value, gradient, hessian };

void solid(benchmark::State& state, const std::string& name, Order order) {
  const Box box;
  const auto term = solid_term(name, box);
  size_t stencils = 0, vertices = 0, blocks = 0;
  for (const StencilBatch& b : term->batches()) {
    stencils += b.count;
    vertices += static_cast<size_t>(b.arity) * b.count;
    blocks += static_cast<size_t>(hessian_blocks(b.arity)) * b.count;
  }
  std::vector<double> gradient(3 * vertices), hessian(9 * blocks);
  double* const second = order == Order::hessian ? hessian.data() : nullptr;
  for (auto _ : state) {
    if (order == Order::value) {
      benchmark::DoNotOptimize(term->value(box.x));
    } else {
      term->derivatives(box.x, Projection::clamp, gradient.data(), second);
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(stencils));
}

// All terms of the two blocks in one matrix, still apart: stencils, maps and gather.
void assembled_blocks(benchmark::State& state) {
  const auto scene = two_blocks();
  scene->move_to(scene->world->rest + random_motion(scene->world->rest.size() / 3, 1e-3));
  for (auto _ : state) benchmark::DoNotOptimize(scene->potential.hessian({Projection::clamp}).values.data());
}
BENCHMARK(assembled_blocks)->Apply(in_milliseconds);

}  // namespace

void add_solid_energies() {
  const Box box;
  for (const std::string& name : Registry<Energy>::kind().names()) {
    if (!solid_term(name, box)) continue;
    for (const auto& [suffix, order] : {std::pair{"value", Order::value}, {"gradient", Order::gradient},
                                        {"hessian_clamped", Order::hessian}}) {
      const auto run = [name, order = order](benchmark::State& state) { solid(state, name, order); };
      in_milliseconds(benchmark::RegisterBenchmark(fmt::format("{}/{}", name, suffix).c_str(), run));
    }
  }
}

}  // namespace tack::bench
