// Better tets in the same surface.
#include <catch2/catch.hpp>
#include <algorithm>
#include <random>
#include <set>

#include "geometry/exact/orientation.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/solids.hpp"
#include "geometry/tets/improve_tets.hpp"
#include "geometry/tets/mean_ratio.hpp"
#include "geometry/tets/tet_changes.hpp"

using namespace tack;

namespace {

// A box whose vertices inside were moved as far as its tets stay positive, times `scale`.
Mesh disturbed(double scale, const std::array<int, 3>& cells = {4, 4, 4}) {
  Mesh mesh = box_tets(Vec3(1, 1, 1), cells);
  std::vector<char> outside(mesh.vertices.size(), 0);
  for (const int v : extract_surface(mesh).vertices) outside[v] = 1;
  std::mt19937 random(3);
  const auto number = [&] { return static_cast<double>(random()) / 4294967296.0 - 0.5; };
  for (size_t v = 0; v < mesh.vertices.size(); ++v) {
    if (outside[v]) continue;
    const Vec3 position = mesh.vertices[v];
    for (double radius = 0.5; radius > 0.01; radius *= 0.8) {
      mesh.vertices[v] = position + radius * Vec3(number(), number(), number());
      if (inverted_tets(mesh).empty()) break;
      mesh.vertices[v] = position;
    }
  }
  for (Vec3& v : mesh.vertices) v *= scale;
  return mesh;
}

double lowest(const std::vector<Vec3>& x, const std::vector<Tet>& tets) {
  double low = 1;
  for (const Tet& t : tets) low = std::min(low, mean_ratio({x[t[0]], x[t[1]], x[t[2]], x[t[3]]}));
  return low;
}

// Its triangles by their positions, which have to be the same ones to the bit.
std::set<std::array<std::array<double, 3>, 3>> faces(const Mesh& mesh) {
  std::set<std::array<std::array<double, 3>, 3>> all;
  for (const Triangle& t : extract_surface(mesh).triangles) {
    std::array<std::array<double, 3>, 3> face;
    for (int i = 0; i < 3; ++i) face[i] = {mesh.vertices[t[i]].x(), mesh.vertices[t[i]].y(), mesh.vertices[t[i]].z()};
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    all.insert(face);
  }
  return all;
}

bool positive(const Mesh& mesh) {
  VecX x(3 * static_cast<Eigen::Index>(mesh.vertices.size()));
  for (size_t v = 0; v < mesh.vertices.size(); ++v) vertex(x, static_cast<int>(v)) = mesh.vertices[v];
  return first_inverted_tet(mesh.tets, x) < 0;
}

}  // namespace

TEST_CASE("tets improve inside the same surface, at any size", "[improve_tets]") {
  const double scale = GENERATE(1.0, 1e-3, 1e3);
  CAPTURE(scale);
  const Mesh before = disturbed(scale);
  REQUIRE(positive(before));
  const double low = lowest(before.vertices, before.tets);
  REQUIRE(low < 0.1);
  const ImprovedTets improved = improve_tets(before.vertices, before.tets, 0.4);
  Mesh after;
  after.vertices = improved.vertices;
  after.tets = improved.tets;
  CHECK(improved.before == low);
  CHECK(improved.after == Approx(lowest(after.vertices, after.tets)).epsilon(1e-12));
  CHECK(improved.after > 0.35);
  CHECK(positive(after));
  CHECK(faces(after) == faces(before));
  CHECK(total_volume(after) == Approx(total_volume(before)).epsilon(1e-12));
  // Old indices of vertices and tets.
  REQUIRE(improved.from.size() == after.vertices.size());
  REQUIRE(improved.kept.size() == after.tets.size());
  const std::vector<int> outside = extract_surface(before).vertices;
  for (size_t v = 0; v < outside.size(); ++v) CHECK(improved.from[v] == outside[v]);
  int kept = 0;
  for (size_t t = 0; t < after.tets.size(); ++t) {
    if (improved.kept[t] < 0) continue;
    ++kept;
    for (int i = 0; i < 4; ++i) CHECK(improved.from[after.tets[t][i]] == before.tets[improved.kept[t]][i]);
  }
  CHECK(kept > 0);
  for (size_t v = 0; v < after.vertices.size(); ++v)
    if (improved.from[v] >= 0) CHECK(after.vertices[v] == before.vertices[improved.from[v]]);
}

TEST_CASE("good tets stay, and the same tets give the same bits", "[improve_tets]") {
  const Mesh good = box_tets(Vec3(1, 1, 1), {3, 3, 3});
  const ImprovedTets same = improve_tets(good.vertices, good.tets, 0.3);
  CHECK(same.tets.size() == good.tets.size());
  for (size_t t = 0; t < same.tets.size(); ++t) CHECK(same.kept[t] == static_cast<int>(t));
  const Mesh poor = disturbed(1);
  const ImprovedTets once = improve_tets(poor.vertices, poor.tets, 0.4), again = improve_tets(poor.vertices, poor.tets, 0.4);
  CHECK(once.vertices == again.vertices);
  CHECK(once.tets == again.tets);
}

TEST_CASE("each change improves the worst tet and fills the same volume, or changes nothing", "[improve_tets]") {
  const Mesh mesh = disturbed(1, {3, 3, 3});
  const auto volume = [](const TetEditor& editor) {
    double sum = 0;
    for (int t = 0; t < editor.count(); ++t)
      if (const Tet& v = editor.tet(t); editor.alive(t)) sum += tet_volume(editor.position(v[0]), editor.position(v[1]), editor.position(v[2]), editor.position(v[3]));
    return sum;
  };
  const auto worst = [](const TetEditor& editor) {
    double low = 1;
    for (int t = 0; t < editor.count(); ++t)
      if (editor.alive(t)) low = std::min(low, editor.quality(t));
    return low;
  };
  const auto changes = GENERATE(0, 1, 2, 3, 4, 5);
  CAPTURE(changes);
  int made = 0;
  TetEditor editor(mesh.vertices, mesh.tets);
  const int count = editor.count();
  for (int t = 0; t < count; ++t) {
    if (!editor.alive(t)) continue;
    const Tet tet = editor.tet(t);
    const double before = worst(editor);
    const bool done = changes == 0   ? remove_edge(editor, tet[0], tet[1])
                      : changes == 1 ? remove_face(editor, t, t % 4)
                      : changes == 2 ? collapse(editor, tet[2], tet[3])
                      : changes == 3 ? smooth(editor, tet[1])
                      : changes == 4 ? split_edge(editor, tet[0], tet[3])
                                     : insert(editor, t);
    made += done;
    CHECK(worst(editor) >= before);
  }
  CHECK(made > 0);
  CHECK(volume(editor) == Approx(1).epsilon(1e-12));
}
