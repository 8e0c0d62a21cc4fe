#include "geometry/meshing/functions.hpp"

extern "C" __attribute__((visibility("default"))) const tack::MeshingFunctions tack_meshing_functions = {
    TACK_MESHING_INTERFACE,
    tack::boolean,
    tack::cut,
    tack::find_defects,
    tack::list_defects,
    tack::require_solid,
    tack::require_oriented_manifold,
    [](const tack::SurfaceDefects& d) { return d.bounds_volume(); },
    tack::offset,
    tack::remesh,
    tack::repair,
    tack::simplify,
    tack::subdivide,
    tack::distance_from_to,
    tack::tetrahedralize,
    [](const tack::DistanceFunction& f, const Eigen::AlignedBox3d& box, double voxel) { return tack::DistanceGrid::of(f, box, voxel); },
    [](const tack::Mesh& mesh, double voxel, double band) { return tack::DistanceGrid::of(mesh, voxel, band); },
    [](const tack::DistanceGrid& grid, std::span<const tack::Vec3> points, std::span<double> distances) { grid.sample(points, distances); },
    [](const tack::DistanceGrid& grid) { return grid.surface(); },
    [](const tack::DistanceGrid& grid, const tack::Vec3& point) { return grid.voxel_of(point); },
};
