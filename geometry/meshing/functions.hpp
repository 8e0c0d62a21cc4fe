// Function table of the shared library libtack_meshing.so: CGAL's operations and OpenVDB's grids,
// which take minutes to compile and tenths of a second to load. The program calls the functions of
// this folder's headers and of level_set/distance_grid.hpp directly; meshing_library.cpp forwards
// them to this table.
#pragma once

#include "geometry/level_set/distance_grid.hpp"
#include "geometry/meshing/booleans.hpp"
#include "geometry/meshing/defects.hpp"
#include "geometry/meshing/offset.hpp"
#include "geometry/meshing/remesh.hpp"
#include "geometry/meshing/repair.hpp"
#include "geometry/meshing/simplify.hpp"
#include "geometry/meshing/subdivide.hpp"
#include "geometry/meshing/surface_deviation.hpp"
#include "geometry/meshing/tetrahedralize.hpp"
#include "geometry/meshing/triangulate.hpp"

namespace tack {

struct MeshingFunctions {
  // TACK_MESHING_INTERFACE: a digest of these headers and of how they were compiled.
  const char* interface;
  decltype(&tack::boolean) boolean;
  decltype(&tack::cut) cut;
  decltype(&tack::find_defects) find_defects;
  decltype(&tack::list_defects) list_defects;
  decltype(&tack::require_solid) require_solid;
  decltype(&tack::require_oriented_manifold) require_oriented_manifold;
  bool (*bounds_volume)(const SurfaceDefects&);
  decltype(&tack::offset) offset;
  decltype(&tack::remesh) remesh;
  decltype(&tack::repair) repair;
  decltype(&tack::simplify) simplify;
  decltype(&tack::subdivide) subdivide;
  decltype(&tack::surface_deviation) surface_deviation;
  decltype(&tack::tetrahedralize) tetrahedralize;
  decltype(&tack::triangulate) triangulate;
  DistanceGrid (*grid_of_function)(const DistanceFunction&, const Eigen::AlignedBox3d&,
                                   double voxel);
  DistanceGrid (*grid_of_mesh)(const Mesh&, double voxel, double band);
  double (*grid_lowest)(const DistanceGrid&);
  void (*grid_sample)(const DistanceGrid&, std::span<const Vec3>, std::span<double>);
  Mesh (*grid_surface)(const DistanceGrid&);
  Eigen::AlignedBox3d (*grid_voxel_of)(const DistanceGrid&, const Vec3&);
};

}  // namespace tack
