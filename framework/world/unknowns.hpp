// Unknowns beyond the vertices of meshes, by one builder: energies, interactions and the world itself ask it for them while a world is
// built. Each is a vertex of x that is in no mesh. It is a place, or a number: then its first coordinate is the number times a length, so
// that norms, tolerances and integrators take it for a way like any other (of a rod: the arc of a twist at its radius of gyration), and the
// other two are held. A mass gives it inertia; without one it is where the potential is least. States, checkpoints and resumed runs have all.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/config/schedule.hpp"
#include "framework/core/dependence.hpp"
#include "geometry/types.hpp"

namespace tack {

struct World;

// What was asked for at once.
struct UnknownGroup {
  std::string name;           // "box/0/temperature"
  int body = -1;              // whose; -1: an interaction's
  std::vector<int> vertices;  // consecutive
  double length = 0;          // of numbers: the way that one is [m]; 0: places
};

struct Numbers {
  std::vector<int> vertices;
  double length = 1;  // m
  double at(int i, const VecX& x) const { return x(3 * vertices[i]) / length; }
};

class Unknowns {
 public:
  // owner: what their names begin with.
  Unknowns(World& world, std::string owner, int body = -1) : world_(world), owner_(std::move(owner)), body_(body) {}

  // So many vertices, at rest there [m]; mass: of each [kg].
  std::vector<int> places(const std::string& name, std::span<const Vec3> at, double mass = 0);
  // So many numbers. length: the way that counts as much as one of their unit: tolerances resolve a hundredth of it [m]. start: their value.
  // mass: what resists changes of that way [kg].
  Numbers numbers(const std::string& name, int count, double length, double start = 0, double mass = 0);
  // The vertex is a sum of others, with weights that add up to one, throughout.
  void follow(Dependence dependence);
  // Directions of a place that nothing frees; `held` projects onto them.
  void hold(int vertex, const Mat3& held);
  // Places that stay where they are.
  void fix(std::vector<int> places);
  // Those of the numbers whose indices are given have the values of a schedule, throughout: they are held.
  void prescribe(const Numbers& numbers, std::span<const int> which, const Schedule& values);

 private:
  std::vector<int> append(const std::string& name, std::span<const Vec3> at, double mass, double length);

  World& world_;
  std::string owner_;
  int body_;
};

}  // namespace tack
