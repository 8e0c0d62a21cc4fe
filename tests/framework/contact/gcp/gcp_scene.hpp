// Surfaces with the Geometric Contact Potential, for tests without a world.
#pragma once

#include "framework/contact/gcp/gcp_energy.hpp"
#include "framework/contact/gcp/gcp_term.hpp"
#include "tests/framework/contact/model_scene.hpp"
#include "tests/support/dense_term.hpp"

namespace tack {

struct GcpScene : ModelScene {
  GcpScene(const SurfaceBuilder& builder, double range, const GcpSmoothing& smoothing = {})
      : ModelScene(builder, range), contacts(surface, pairs, smoothing), term(contacts) {}

  void move_to(const VecX& x) { contacts.find(candidates_at(x), x); }
  double value(const VecX& x) {
    move_to(x);
    return term.value(x);
  }
  VecX gradient(const VecX& x) {
    move_to(x);
    return dense_gradient(term, x);
  }
  VecX forces(const VecX& x) {
    move_to(x);
    return term.forces(x);
  }
  int count(GcpKind kind) const {
    int n = 0;
    for (const GcpStencil& s : contacts.stencils().stencils) n += s.kind == kind;
    return n;
  }
  int count(GcpFactor::Type type) const {
    int n = 0;
    for (const GcpFactor& f : contacts.stencils().factors) n += f.type == type;
    return n;
  }
  int mollified(const VecX& x) const {
    int n = 0;
    GcpPositions c;
    for (const GcpStencil& s : contacts.stencils().stencils) {
      gcp_positions(x, contacts.stencils().vertices_of(s), c);
      n += gcp_mollifier(s.kind, contacts.smoothing(), c) < 1;
    }
    return n;
  }

  GcpContacts contacts;
  GcpTerm term;
};

}  // namespace tack
