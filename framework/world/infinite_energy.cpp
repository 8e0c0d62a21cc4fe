#include "framework/world/infinite_energy.hpp"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "framework/core/limit_view.hpp"
#include "framework/world/describe_primitive.hpp"

namespace tack {
namespace {

bool infinite(const Term& term, const VecX& x) { return !term.dynamic() && !std::isfinite(term.value(x)); }

// Returns " of 'strip'" for a term whose stencils belong to one object, else "".
std::string owner(const World& world, const Term& term) {
  for (const StencilBatch& batch : term.batches())
    if (const int body = batch.count > 0 ? world.body_of(batch.vertices[0]) : -1; body >= 0) return fmt::format(" of '{}'", world.bodies[body].name);
  return "";
}

}  // namespace

std::string describe_infinite_energy(const World& world, const Term& term, const VecX& x) {
  if (!infinite(term, x)) return "";
  const auto* limits = dynamic_cast<const LimitView*>(&term);
  const std::optional<ExceededLimit> exceeded = limits ? limits->exceeded_limit(x) : std::nullopt;
  if (!exceeded) return fmt::format("the energy {}{} would be infinite", term.name(), owner(world, term));
  if (exceeded->vertices.empty()) return exceeded->excess;
  return describe_primitive(world, exceeded->vertices) + " " + exceeded->excess;
}

std::string describe_infinite_energy(const World& world, const VecX& x) {
  for (const Term* term : world.terms)
    if (std::string why = describe_infinite_energy(world, *term, x); !why.empty()) return why;
  return "";
}

}  // namespace tack
