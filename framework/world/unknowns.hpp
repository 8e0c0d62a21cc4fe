// Unknowns beyond mesh vertices. Energies, interactions and the world request them while a world
// is built. Each is a vertex of x that belongs to no mesh:
//    vector dof   a position
//    scalar dof   its first coordinate is the value times a length, so that norms, tolerances and
//                 integrators treat it like a displacement (twist of a rod: the arc at its
//                 radius of gyration); the other two coordinates are fixed
// With a mass it has inertia; without, it minimises the potential. States, checkpoints and resumed
// runs contain all unknowns.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/config/schedule.hpp"
#include "framework/core/dependence.hpp"
#include "geometry/types.hpp"

namespace tack {

struct World;

/// The unknowns of one request.
struct UnknownGroup {
  std::string name;           ///< "box/0/temperature"
  int body = -1;              ///< owner; -1: an interaction
  std::vector<int> vertices;  ///< consecutive
  double length = 0;          ///< of one unit of scalar dofs [m]; 0: vector dofs
};

/// Scalar dofs of one request. at: value of dof i in x (3n).
struct ScalarDofs {
  std::vector<int> vertices;
  double length = 1;  ///< m
  double at(int i, const VecX& x) const { return x(3 * vertices[i]) / length; }
};

/// Requests for unknowns of one owner.
class Unknowns {
 public:
  /// owner: beginning of their names.
  Unknowns(World& world, std::string owner, int body = -1)
      : world_(world), owner_(std::move(owner)), body_(body) {}

  /// Adds vector dofs with these rest positions [m]. mass: of each [kg].
  std::vector<int> add_vector_dofs(const std::string& name, std::span<const Vec3> at,
                                   double mass = 0);
  /// Adds scalar dofs. length: displacement that counts as one unit [m]; tolerances resolve a
  /// hundredth of it. start: initial value. mass: inertia against that displacement [kg].
  ScalarDofs add_scalar_dofs(const std::string& name, int count, double length, double start = 0,
                             double mass = 0);
  /// Makes a vertex a weighted sum of others for the whole run; weights add up to one.
  void make_dependent(Dependence dependence);
  /// Fixes directions of a vector dof for the whole run. directions: projection onto them.
  void fix_directions(int vertex, const Mat3& directions);
  /// Fixes vector dofs.
  void fix(std::vector<int> vertices);
  /// Prescribes the scalar dofs with these indices by a schedule for the whole run.
  void prescribe(const ScalarDofs& dofs, std::span<const int> indices, const Schedule& values);

 private:
  std::vector<int> append(const std::string& name, std::span<const Vec3> at, double mass,
                          double length);

  World& world_;
  std::string owner_;
  int body_;
};

}  // namespace tack
