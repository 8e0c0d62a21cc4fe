// Ropes: tension-only cables.
#include <fmt/format.h>

#include <memory>
#include <optional>

#include "energies/interactions/nearest_ends.hpp"
#include "framework/assembly/formula_term.hpp"
#include "framework/probes/interaction_probe.hpp"
#include "framework/setup/interaction_builder.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// k/2 (l - L)^2 where it is longer than L.
struct Taut : FormulaOf<2> {
  struct Data {
    double stiffness, length;  // N/m, m
  };
  template <class T>
  T energy(const Positions<T>& x, const Data& rope) const {
    const T stretch = (x[1] - x[0]).norm() - rope.length;
    return stretch > T(0) ? T(0.5 * rope.stiffness * stretch * stretch) : T(0);
  }
};

class RopeTerm : public FormulaTerm<Taut> {
 public:
  RopeTerm() : FormulaTerm("ropes") {}
  // Returns the sum of the forces on the first ends [N].
  Vec3 force(const VecX& x) const {
    Vec3 sum = Vec3::Zero();
    for (int s = 0; s < count(); ++s) {
      const Vec3 span = vertex(x, stencil(s)[1]) - vertex(x, stencil(s)[0]);
      const double stretch = span.norm() - data()[s].length;
      if (stretch > 0) sum += data()[s].stiffness * stretch * span.normalized();
    }
    return sum;
  }
};

struct RopeEnd {
  std::string object;
  std::optional<Vec3> at;             // m
  std::unique_ptr<Selection> select;  // null: the point

  void fields(Fields& f) {
    f.text("object", object, "name of the object; unless given, space");
    f.optional_vector("at", at, units::length, "a point, fixed to the object or in space");
    f.component("select", select, "selected vertices, instead of a point");
    f.check("object", [this] {
      return std::string(select && (object.empty() || at) ? "`select` chooses vertices of an `object`, and stands in the place of `at`" : "");
    });
  }
  std::vector<int> vertices(InteractionBuilder& builder) const {
    if (!at && !select) throw InputError("rope: give the place of the end, `at`, or vertices of an object, `select`");
    if (object.empty()) return {builder.fixed_vertex(*at)};
    const int body = builder.body(object);
    if (!select) return {builder.attachment_point(body, *at)};
    return tack::select(*select, builder.world().selection_context(body));
  }
};

class Rope : public Interaction {
 public:
  void fields(Fields& f) override {
    Interaction::fields(f);
    f.object("from", from_, "a point, or vertices with one rope each");
    f.object("to", to_, "a point, or vertices: each rope ends at the one nearest at the start");
    f.number("stiffness", stiffness_, units::stiffness, "stiffness of each rope when taut").required().positive();
    f.optional_number("length", length_, units::length, "length above which it is taut; its length at the start unless given").nonnegative();
  }
  std::vector<std::string> objects() const override {
    std::vector<std::string> all;
    for (const RopeEnd* end : {&from_, &to_})
      if (!end->object.empty()) all.push_back(end->object);
    return all;
  }
  void build(InteractionBuilder& builder) const override {
    const std::vector<int> from = from_.vertices(builder), to = to_.vertices(builder);
    const VecX& rest = builder.rest();
    auto term = std::make_unique<RopeTerm>();
    for (const Edge& ends : nearest_ends(from, to, rest, fmt::format("rope '{}'", builder.name())))
      term->add(ends, {stiffness_, length_.value_or(length_of(ends, rest))});
    builder.add(std::move(term));
  }

 private:
  RopeEnd from_, to_;
  double stiffness_ = 0;          // N/m
  std::optional<double> length_;  // m
};

class RopeForce : public InteractionProbe<RopeTerm, VectorProbe> {
 public:
  Unit unit() const override { return units::force; }

 protected:
  Vec3 value(const World&, const State& state) override { return term().force(state.x); }
};

TACK_REGISTER(Interaction, Rope, "rope", "Tension-only cables between points or vertices of objects, or from these to space.", "");
TACK_REGISTER(Probe, RopeForce, "rope_force", "Total force of ropes on their start points [N].", "");

}  // namespace
}  // namespace tack
