// A mesh whose vertices are moved by formulas: a sheet that is curved, a pillow, a saddle.
#include <fmt/format.h>

#include <array>

#include "framework/config/formula.hpp"
#include "framework/config/field.hpp"
#include "framework/shapes/mesh_cache.hpp"
#include "framework/shapes/shape_source.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

const std::vector<std::string> warped_variables = {"x", "y", "z"};
constexpr double farthest = 1e100;  // m

std::string text_of(const Vec3& x) { return fmt::format("({:.6g}, {:.6g}, {:.6g}) m", x.x(), x.y(), x.z()); }

class WarpedShape : public ShapeSource {
 public:
  void fields(Fields& f) override {
    f.component("of", of_, "the mesh that is moved").required();
    for (int i = 0; i < 3; ++i) {
      f.text(warped_variables[i], text_[i], "new position along " + warped_variables[i] + " [m]: a formula of the old position x, y, z [m]").formula(warped_variables);
      f.check(warped_variables[i], [this, i]() -> std::string {
        try {
          Formula(text_[i], warped_variables);
          return "";
        } catch (const InputError& error) {
          return error.what();
        }
      });
    }
  }
  bool costly() const override { return of_->costly(); }
  bool reads_files() const override { return of_->reads_files(); }
  Mesh make() const override {
    const Mesh from = mesh_of_shape(*of_)->mesh;
    Mesh mesh = from;
    const std::array formulas = {Formula(text_[0], warped_variables), Formula(text_[1], warped_variables), Formula(text_[2], warped_variables)};
    for (size_t v = 0; v < mesh.vertices.size(); ++v) {
      const Vec3& x = from.vertices[v];
      for (int i = 0; i < 3; ++i) mesh.vertices[v](i) = formulas[i](std::array{x.x(), x.y(), x.z()});
      if (!(mesh.vertices[v].cwiseAbs().maxCoeff() <= farthest))
        throw InputError(fmt::format("shape warped: ({}) gives no finite position for the vertex at {}", fmt::join(text_, ", "), text_of(x)));
    }
    if (const std::vector<int> turned = inverted_tets(mesh); !turned.empty())
      throw InputError(fmt::format("shape warped: ({}) turns {} of {} tets inside out or flat, one of them at {}; keep left and right apart, or let less be moved by less",
                                   fmt::join(text_, ", "), turned.size(), mesh.tets.size(), text_of(from.vertices[mesh.tets[turned.front()][0]])));
    return mesh;
  }

 private:
  std::unique_ptr<ShapeSource> of_;
  std::array<std::string, 3> text_ = {"x", "y", "z"};
};

TACK_REGISTER(ShapeSource, WarpedShape, "warped", "Another shape whose vertices are moved by formulas of their position.", "");

}  // namespace
}  // namespace tack
