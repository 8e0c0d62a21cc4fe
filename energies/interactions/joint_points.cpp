#include "energies/interactions/joint_points.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/body/extent.hpp"
#include "geometry/errors.hpp"

namespace tack {

void JointEnds::fields(Fields& f) {
  f.text("object", object, "the affine body that is joined").required();
  f.text("to", to, "the object that it is joined to; space unless given");
  f.vector("at", at, units::length, "the common point of the two at the start").required();
  f.flag("contact", contact, "contact between the two; false: they may overlap at the joint");
}

std::vector<std::string> JointEnds::objects() const { return to.empty() ? std::vector{object} : std::vector{object, to}; }

JointPoints::JointPoints(InteractionBuilder& builder, const JointEnds& ends) : builder_(builder), ends_(ends), object_(builder.body(ends.object)) {
  const auto size = [&](int i) { return extent_of(builder.world().bodies[i], builder.rest()).diagonal().norm(); };
  spacing_ = size(object_) / 2;
  joint_.bodies = {object_};
  if (ends.to.empty()) return;
  other_ = builder.body(ends.to);
  if (other_ == object_) throw InputError(fmt::format("joint '{}' joins '{}' to itself; choose another object", builder.name(), ends.to));
  joint_.bodies.push_back(other_);
  spacing_ = std::min(spacing_, size(other_) / 2);
}

bool JointPoints::affine(int body) const { return body >= 0 && !builder_.world().bodies[body].frame.empty(); }

int JointPoints::of_object(const Vec3& at) {
  joint_.attachment_points.push_back(builder_.attachment_point(object_, at));
  return joint_.attachment_points.back();
}

int JointPoints::of_other(const Vec3& at) { return other_ < 0 ? builder_.fixed_vertex(at) : builder_.attachment_point(other_, at); }

int JointPoints::joined(const Vec3& at) {
  const int a = of_object(at), b = of_other(at);
  if (!affine(object_) || !affine(other_)) {
    joint_.relations.push_back({{a, 1.0}, {b, -1.0}});
    return b;
  }
  const int vertex = builder_.unknowns().add_vector_dofs("place", std::vector{at})[0];
  joint_.own_vertices.push_back(vertex);
  joint_.relations.push_back({{a, 1.0}, {vertex, -1.0}});
  joint_.relations.push_back({{b, 1.0}, {vertex, -1.0}});
  return vertex;
}

void JointPoints::finish() {
  if (!ends_.contact && other_ >= 0) builder_.exclude_contact(object_, other_);
  builder_.add(std::move(joint_));
}

std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 u = axis.unitOrthogonal();
  return {u, axis.cross(u)};
}

}  // namespace tack
