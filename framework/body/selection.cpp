#include "framework/body/selection.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

#include "framework/config/field.hpp"
#include "framework/config/nearest.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Returns the vertices of a body for which test(vertex) is true.
template <class Test>
std::vector<int> vertices_where(const Body& body, const Test& test) {
  std::vector<int> chosen;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
    if (test(v)) chosen.push_back(v);
  return chosen;
}

class AllVertices : public Selection {
 public:
  std::vector<int> choose(const SelectionContext& c) const override {
    return vertices_where(c.body, [](int) { return true; });
  }
};

class BoxSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.vector("min", min_, units::length, "lowest corner").required();
    f.vector("max", max_, units::length, "highest corner").required();
    f.check("max", [this]() -> std::string {
      return (min_.array() <= max_.array()).all() ? "" : "must not be below min in any coordinate";
    });
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    return vertices_where(c.body, [&](int v) {
      const Vec3 p = vertex(c.rest, v);
      return (p.array() >= min_.array()).all() && (p.array() <= max_.array()).all();
    });
  }

 private:
  Vec3 min_ = Vec3::Constant(-1), max_ = Vec3::Constant(1);  // m
};

class SphereSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.vector("centre", centre_, units::length, "centre of the sphere");
    f.number("radius", radius_, units::length, "radius of the sphere").required().positive();
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    return vertices_where(c.body,
                          [&](int v) { return (vertex(c.rest, v) - centre_).norm() <= radius_; });
  }

 private:
  Vec3 centre_ = Vec3::Zero();  // m
  double radius_ = 1;           // m
};

class PlaneSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.vector("point", point_, units::length, "a point of the plane");
    f.vector("normal", normal_, units::none, "normal of the plane, towards the selected side").required();
    f.check("normal", [this]() -> std::string {
      return normal_.norm() > 0 ? "" : "must not be zero";
    });
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    return vertices_where(c.body,
                          [&](int v) { return normal_.dot(vertex(c.rest, v) - point_) >= 0; });
  }

 private:
  Vec3 point_ = Vec3::Zero(), normal_ = Vec3::UnitY();
};

// Vertices that lie farthest in a direction: a face of a box, the tip of a cone.
class FaceSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.vector("direction", direction_, units::none, "outward direction of the face").required();
    f.check("direction", [this]() -> std::string {
      return direction_.norm() > 0 ? "" : "must not be zero";
    });
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    const auto along = [&](int v) { return direction_.dot(vertex(c.rest, v)); };
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (int v = c.body.first_vertex; v < c.body.first_vertex + c.body.vertex_count; ++v) {
      low = std::min(low, along(v));
      high = std::max(high, along(v));
    }
    constexpr double flat = 1e-6;  // of the extent
    return vertices_where(c.body, [&](int v) { return along(v) >= high - flat * (high - low); });
  }

 private:
  Vec3 direction_ = Vec3::UnitY();
};

class TagSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.text("name", name_, "a group of the mesh file, or one of `selections`").required();
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    const auto group = c.body.tags.find(name_);
    if (group == c.body.tags.end()) throw unknown(c);
    auto chosen = group->second;
    for (int& v : chosen) v += c.body.first_vertex;
    return chosen;
  }

 private:
  InputError unknown(const SelectionContext& c) const {
    std::vector<std::string> names;
    for (const auto& [name, unused] : c.body.tags) names.push_back(name);
    return InputError(fmt::format("selection tag: object '{}' has no group '{}'{}", c.body.name, name_,
                                  suggestion(name_, names, "groups")));
  }

  std::string name_;
};

class IndexSelection : public Selection {
 public:
  void fields(Fields& f) override {
    f.numbers("vertices", vertices_, units::none, "vertex numbers within the object, from 0")
        .required().nonnegative();
  }
  std::vector<int> choose(const SelectionContext& c) const override {
    if (c.body.flows)
      throw InputError(fmt::format("selection indices: object '{}' is remeshed as it flows (remesh), which renumbers its vertices; choose them by "
                                   "position, or as a group of the mesh file", c.body.name));
    for (const double v : vertices_)
      if (v >= c.body.vertex_count || v != std::floor(v))
        throw InputError(fmt::format("selection indices: vertex {} does not exist; object '{}' has 0 "
                                     "to {}", v, c.body.name, c.body.vertex_count - 1));
    const std::set<int> wanted(vertices_.begin(), vertices_.end());
    return vertices_where(c.body, [&](int v) { return wanted.count(v - c.body.first_vertex) > 0; });
  }

 private:
  std::vector<double> vertices_;
};

TACK_REGISTER(Selection, AllVertices, "all", "Every vertex.", "");
TACK_REGISTER(Selection, BoxSelection, "box", "Vertices in an axis-aligned box, at rest.", "");
TACK_REGISTER(Selection, SphereSelection, "sphere", "Vertices in a sphere, at rest.", "");
TACK_REGISTER(Selection, PlaneSelection, "plane", "Vertices on one side of a plane, at rest.", "");
TACK_REGISTER(Selection, FaceSelection, "face", "Vertices furthest in a direction, at rest.", "");
TACK_REGISTER(Selection, TagSelection, "tag", "Vertices of a named group: of the mesh file, or of `selections`.", "");
TACK_REGISTER(Selection, IndexSelection, "indices", "Vertices by number.", "");

}  // namespace

std::vector<int> select(const Selection& selection, const SelectionContext& context) {
  std::vector<int> chosen = selection.choose(context);
  if (chosen.empty())
    throw InputError(fmt::format("selection {} chooses no vertex of object '{}'; check its position and "
                                 "units against the object", selection.type(), context.body.name));
  return chosen;
}

}  // namespace tack
