// Vertices by a formula of their place: a rim, a ring, stripes.
#include <array>

#include "framework/config/formula.hpp"
#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const std::vector<std::string> place_variables = {"x", "y", "z"};

class FormulaSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.text("where", where_, "condition, not 0 for selected vertices: a formula of the rest position x, y, z [m]: abs(x) > 0.1 || y > 0.2").required().formula(place_variables);
    f.check("where", [this]() -> std::string {
      try {
        Formula(where_, place_variables);
        return "";
      } catch (const InputError& error) {
        return error.what();
      }
    });
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    const Formula holds(where_, place_variables);
    std::vector<int> chosen;
    for (int v = c.body.first_vertex; v < c.body.first_vertex + c.body.vertex_count; ++v) {
      const Vec3 at = vertex(c.rest, v);
      if (holds(std::array{at.x(), at.y(), at.z()}) != 0) chosen.push_back(v);
    }
    return chosen;
  }

 private:
  std::string where_;
};

TACK_REGISTER(Selection, FormulaSelection, "formula", "Vertices whose rest position fulfils a formula.", "");

}  // namespace
}  // namespace tack
