#include "framework/affine/frame.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "geometry/errors.hpp"
#include "geometry/shapes/solids.hpp"

using namespace tack;

TEST_CASE("the frame of an affine body has its mass, centroid and second moments", "[affine]") {
  Mesh box = box_tets({0.2, 0.5, 0.3}, {1, 1, 1});
  rotate(box, Vec3(1, 2, -1), 0.7);
  translate(box, {1, 2, 3});
  const MassProperties body = mass_properties(box);
  const BodyFrame frame = body_frame(body);
  Vec3 centroid = Vec3::Zero();
  Mat3 moments = Mat3::Zero();
  for (const Vec3& p : frame.vertices) {
    centroid += p / 4;
    moments += body.volume / 4 * (p - body.centroid) * (p - body.centroid).transpose();
  }
  CHECK((centroid - body.centroid).norm() < 1e-14);
  CHECK((moments - body.moments).norm() < 1e-12 * body.moments.norm());
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = frame.vertices[k + 1] - frame.vertices[0];
  CHECK(edges.determinant() > 0);
  for (const Vec3& x : box.vertices) {
    const auto weights = frame.weights(x);
    Vec3 sum = Vec3::Zero();
    double total = 0;
    for (int i = 0; i < 4; ++i) sum += weights[i] * frame.vertices[i], total += weights[i];
    CHECK((sum - x).norm() < 1e-13);
    CHECK(total == Approx(1).epsilon(1e-14));
  }
  CHECK_THROWS_AS(body_frame({1, Vec3::Zero(), Vec3(1, 1, 0).asDiagonal()}), InputError);
}
