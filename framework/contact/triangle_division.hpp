// Divides a triangle that is covered in part until its pieces are, or are not, or are small, cuts these along the rim
// (rim_cut.hpp), and gathers what is covered into samples (coverage.hpp). Only what is within reach counts.
#pragma once

#include <vector>

#include "framework/contact/coverage.hpp"
#include "framework/contact/facing_view.hpp"
#include "framework/contact/rim_cut.hpp"

namespace tack {

class TriangleDivision {
 public:
  TriangleDivision(const CollisionMesh& mesh, const HeldSurface& held) : mesh_(mesh), held_(held), viewer_(mesh, held) {}

  // near: triangles of the object. reach: how far away something may lie opposite [m]. parts: of that pair.
  void divide(int triangle, int object, double reach, const std::vector<int>& near, std::vector<ContactSample>& out,
              CoveredParts& parts);

 private:
  using Corners = std::array<Vec3, 3>;  // barycentric coordinates
  struct Seen {
    bool any = false, covered = false;
    double beyond = 0, distance = 0;
    int triangle = -1;
    Vec3 normal = Vec3::Zero();
  };
  struct Look {
    std::array<Seen, 3> from;
    int covered = 0;
  };
  struct Sum {
    double area = 0, distance = 0;  // the latter times the area
    Vec3 inside = Vec3::Zero(), normal = Vec3::Zero();
    int leader = -1;
  };

  Vec3 place(const Vec3& inside) const;
  Seen look(const Vec3& inside, const std::vector<int>& near);
  Look look_from(const Corners& points, const std::vector<int>& near);
  std::vector<int> those_near(const Corners& c, const std::vector<int>& near) const;
  bool hopeless(const Look& seen, double size) const;
  void part(const Corners& c, int depth, const std::vector<int>& near, Sum* sum);
  void examine(const Corners& c, int depth, const std::vector<int>& near, Sum* sum);
  bool cut(const Corners& c, const Look& seen, const std::vector<int>& near, Sum& sum);
  void add(const Corners& points, int depth, const Look& seen, Sum& sum) const;
  void add(double area, const Vec3& inside, const Seen& seen, Sum& sum) const;
  void add_rims(const CutFace& face);

  const CollisionMesh& mesh_;
  const HeldSurface& held_;
  FacingViewer viewer_;
  int triangle_ = 0, object_ = 0, sample_depth_ = 0, last_depth_ = 0;
  double reach_ = 0, size_ = 0, slack_ = 0;  // m
  std::vector<ContactSample>* out_ = nullptr;
  CoveredParts* parts_ = nullptr;
  std::vector<RimLine> lines_;
};

}  // namespace tack
