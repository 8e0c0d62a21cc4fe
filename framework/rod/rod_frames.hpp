// Material frames of the edges of a rod: tangent t and two directors. The positions of the vertices
// of an edge determine t; the angle theta of the first director from a reference is an unknown
// (Bergou et al. 2008, Discrete Elastic Rods). It is stored as a vertex outside of all meshes,
// whose first coordinate is the arc u = r theta [m], r the radius of gyration of the section. With
// the mass of the edge it has the moment of inertia of the edge about t, and norms, tolerances and
// integrators treat it as a displacement. The reference is the frame committed at the end of the
// last step, parallel transported to the current tangent by the smallest rotation (Bergou et al.
// 2010, Discrete Viscous Threads). Within a step frames are therefore functions of x alone. u of a
// rod with the angular velocity w about t changes at the rate r w.
#pragma once

#include <Eigen/Geometry>

#include <span>
#include <string>
#include <vector>

#include "framework/core/step_participant.hpp"

namespace tack {

// Rotation of a frame: the images of x, y, z are t and the two directors.
using Quaternion = Eigen::Quaterniond;

class RodFrames : public StepParticipant {
 public:
  // twists: vertices (of x) whose first coordinates are the arcs u. directors: of each edge at
  // rest, across the edge. name: of the history array.
  RodFrames(std::string name, std::vector<Edge> edges, std::vector<int> twists,
            const std::vector<Vec3>& directors, double radius, const VecX& rest);

  int count() const { return static_cast<int>(edges_.size()); }
  // Returns the index of an edge; -1: none.
  int find(const Edge& edge) const;
  const Edge& edge(int e) const { return edges_[e]; }
  std::span<const int> twists() const { return twists_; }  // consecutive
  bool is_twist(int v) const {
    return !twists_.empty() && twists_.front() <= v && v <= twists_.back();
  }
  double radius() const { return radius_; }  // r [m]

  const Quaternion& committed(int e) const { return committed_[e]; }
  double angle(int e, const VecX& x) const { return x(3 * twists_[e]) / radius_; }  // theta
  Vec3 tangent(int e, const VecX& x) const {
    return (vertex(x, edges_[e][1]) - vertex(x, edges_[e][0])).normalized();
  }
  // Returns the first director.
  Vec3 director(int e, const VecX& x) const;
  // Returns the angle at which the first director at x is closest to a vector, in (-pi, pi].
  double angle_to(int e, const VecX& x, const Vec3& vector) const;

  // Returns the positions at the start of the present step.
  const VecX& start() const { return start_; }
  double start_time() const { return start_time_; }  // s

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;

 private:
  Quaternion reference(int e, const VecX& x) const;

  std::string history_;
  std::vector<Edge> edges_;
  std::vector<std::pair<Edge, int>> by_vertices_;  // ascending
  std::vector<int> twists_;
  double radius_;
  std::vector<Quaternion> at_rest_, committed_;
  VecX start_;
  double start_time_ = 0;
};

}  // namespace tack
