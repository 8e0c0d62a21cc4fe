// Edges as a body with a section and frames.
#pragma once

#include <cmath>
#include <numbers>

#include "framework/body/body.hpp"
#include "framework/rod/rod_frames.hpp"

namespace tack {

struct RodBody {
  RodBody(const std::vector<Vec3>& vertices, std::vector<Edge> edges, const RodSection& section)
      : RodBody(vertices, edges, section, std::vector<Vec3>(edges.size(), section.normal)) {}
  RodBody(const std::vector<Vec3>& vertices, std::vector<Edge> edges, const RodSection& section,
          const std::vector<Vec3>& directors) {
    const int n = static_cast<int>(vertices.size()), m = static_cast<int>(edges.size());
    body.name = "rod";
    body.vertex_count = n;
    body.edges = std::move(edges);
    body.section = section;
    rest = VecX::Zero(3 * (n + m));
    for (int v = 0; v < n; ++v) vertex(rest, v) = vertices[v];
    std::vector<int> twists;
    for (int e = 0; e < m; ++e) twists.push_back(n + e);
    frames = body.rod = std::make_shared<RodFrames>("rod/frames", body.edges, twists, directors,
                                                    section.radius_of_gyration(), rest);
  }

  // Makes x the end of a step.
  void commit(const VecX& x, StepParticipant& term) {
    frames->commit(x, history);
    term.commit(x, history);
    frames->load_history(history);
    term.load_history(history);
  }
  // Returns x after a rigid motion by less than half a turn, with rotated frames.
  VecX moved(const VecX& x, const Mat3& r, const Vec3& d) const {
    VecX y = x;
    for (int v = 0; v < body.vertex_count; ++v) vertex(y, v) = r * vertex(x, v) + d;
    for (int e = 0; e < frames->count(); ++e) {
      const double before = frames->angle(e, x),
                   angle = frames->angle_to(e, y, r * frames->director(e, x)),
                   turn = 2 * std::numbers::pi;
      y(3 * frames->twists()[e]) =
          frames->radius() * (angle + turn * std::round((before - angle) / turn));
    }
    return y;
  }

  Body body;
  VecX rest;
  std::shared_ptr<RodFrames> frames;
  History history;
};

}  // namespace tack
