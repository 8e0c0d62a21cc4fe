// Selection of vertices by a formula of their rest position: a boundary, a ring, stripes.
#include <array>

#include "framework/config/formula.hpp"
#include "framework/body/selection.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

const std::vector<std::string> position_variables = {"x", "y", "z"};

class FormulaSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.text("where", where_, "condition, not 0 for selected vertices: a formula of the rest position x, y, z [m]: abs(x) > 0.1 || y > 0.2").required().formula(position_variables);
    f.check("where", [this]() -> std::string {
      try {
        Formula(where_, position_variables);
        return "";
      } catch (const InputError& error) {
        return error.what();
      }
    });
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    const Formula condition(where_, position_variables);
    std::vector<int> chosen;
    for (int v = c.body.first_vertex; v < c.body.first_vertex + c.body.vertex_count; ++v) {
      const Vec3 at = vertex(c.rest, v);
      if (condition(std::array{at.x(), at.y(), at.z()}) != 0) chosen.push_back(v);
    }
    return chosen;
  }

 private:
  std::string where_;
};

TACK_REGISTER(Selection, FormulaSelection, "formula", "Vertices whose rest position fulfils a formula.", "");

}  // namespace
}  // namespace tack
