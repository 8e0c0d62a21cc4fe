// Divides a triangle that is covered in part until its pieces are, or are not, or are small, cuts
// these along the rim (polygon_clip.hpp), and gathers what is covered into samples
// (surface_overlap.hpp). Only what is within reach counts. Cells of which one sample is made each
// are left out where all is out of range.
#pragma once

#include <span>
#include <vector>

#include "framework/contact/surface_overlap.hpp"
#include "framework/contact/facing_view.hpp"
#include "framework/contact/polygon_clip.hpp"

namespace tack {

class TriangleDivision {
 public:
  TriangleDivision(const CollisionMesh& mesh, const LaggedSurface& held)
      : mesh_(mesh), held_(held), viewer_(mesh, held) {}

  // A cell that is left out.
  struct Left {
    int cell;
    double away;  // of all that is near it, out of range by so much [m]
  };
  static constexpr int all = -1;  // cells of a triangle
  // Returns the number of subdivisions into four after which cells of a triangle of that area [m^2]
  // have about this size [m].
  static int depth_of(double area, double size);
  struct What {
    int triangle, object;
    double range;  // of the law [m]; what lies opposite may be twice as far
    int depth;     // of cells
  };
  // facing: those triangles of the object that it may face, or of a part of it that is seen alone
  // (null: there is none). parts: of that pair. Cells are left out by the triangles `around`, which
  // samples may act on; none is without any.
  void divide(const What& what, const std::vector<int>& facing, const SurfaceRegion* seen,
              std::span<const int> around, std::vector<ContactSample>& out, OverlapFacets& parts,
              std::vector<Left>& left);
  // One that was left out.
  void divide_cell(const What& what, int cell, const std::vector<int>& facing,
                   const SurfaceRegion* seen, std::vector<ContactSample>& out,
                   OverlapFacets& parts);

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
    int covered() const { return from[0].covered + from[1].covered + from[2].covered; }
  };
  struct Sum {
    double area = 0, distance = 0;  // the latter times the area
    Vec3 inside = Vec3::Zero(), normal = Vec3::Zero();
    int leader = -1;
  };

  Vec3 place(const Vec3& inside) const;
  Seen look(const Vec3& inside, const std::vector<int>& near);
  Look look_from(const Corners& points, const std::vector<int>& near);
  void begin(const What& what, const SurfaceRegion* seen, std::vector<ContactSample>& out,
             OverlapFacets& parts);
  std::vector<int> those_near(const Corners& c, const std::vector<int>& near) const;
  double out_of_range(const Corners& c) const;
  bool hopeless(const Look& seen, double size) const;
  void part(const Corners& c, int depth, int cell, const std::vector<int>& near);
  void gather(const Corners& c, int cell, const std::vector<int>& near);
  void examine(const Corners& c, int depth, const Look& seen, const std::vector<int>& near,
               Sum& sum);
  bool cut(const Corners& c, const Look& seen, const std::vector<int>& near, Sum& sum);
  void add(const Corners& points, int depth, const Look& seen, Sum& sum) const;
  void add(double area, const Vec3& inside, const Seen& seen, Sum& sum) const;
  void add_rims(const ClipPolygon& face);

  const CollisionMesh& mesh_;
  const LaggedSurface& held_;
  FacingViewer viewer_;
  const SurfaceRegion* seen_ = nullptr;
  int triangle_ = 0, object_ = 0, sample_depth_ = 0, last_depth_ = 0;
  double range_ = 0, reach_ = 0, size_ = 0, slack_ = 0;  // m
  std::vector<ContactSample>* out_ = nullptr;
  OverlapFacets* parts_ = nullptr;
  std::span<const int> around_;
  std::vector<Left>* left_ = nullptr;
  std::vector<ClipLine> lines_;
};

}  // namespace tack
