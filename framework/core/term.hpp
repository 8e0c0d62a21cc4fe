// A term of the potential energy P(x) = sum_i P_i(x): a sum over small stencils of vertices.
// A term computes all its stencils in one (virtual) call; each stencil writes its own slots, and the
// assembler gathers the slots (framework/assembly). One virtual call per term, none per stencil.
//
// Slots of a stencil of arity K: gradient, K 3-vectors [N]; Hessian, K(K+1)/2 column-major 3x3
// blocks [N/m], lower triangle by rows: (0,0) (1,0) (1,1) (2,0) ...
#pragma once

#include <string>
#include <vector>

#include "framework/core/spd_filter.hpp"
#include "geometry/types.hpp"

namespace tack {

class ResidualView;

constexpr int hessian_blocks(int arity) { return arity * (arity + 1) / 2; }

// Stencils of one kind: stencil s touches the vertices[arity * s + (0..arity-1)].
struct StencilBatch {
  int arity = 0;
  int count = 0;
  const int* vertices = nullptr;
};

class Term {
 public:
  explicit Term(std::string name) : name_(std::move(name)) {}
  virtual ~Term() = default;
  const std::string& name() const { return name_; }

  virtual double value(const VecX& x) const = 0;  // [J]

  // The stencils, in the order in which slots are laid out. Empty for linear terms.
  virtual std::vector<StencilBatch> batches() const { return {}; }
  // Whether the stencils may differ from one configuration to the next (contact).
  virtual bool dynamic() const { return false; }

  // Writes every gradient slot, and every Hessian slot unless `hessian` is null.
  virtual void derivatives(const VecX& x, SpdFilter filter, double* gradient,
                           double* hessian) const;

  // Adds a gradient that is not worth slots: linear potentials.
  virtual void add_linear_gradient(VecX& /*gradient*/) const {}

  // The term as least squares (residual_view.hpp); null if it has no such form.
  virtual const ResidualView* residual_view() const { return nullptr; }

 private:
  std::string name_;
};

inline void Term::derivatives(const VecX&, SpdFilter, double*, double*) const {}

}  // namespace tack
