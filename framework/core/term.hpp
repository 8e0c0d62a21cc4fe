// A term of the potential energy P(x) = sum_i P_i(x): a sum over small stencils of vertices.
// A term computes all its stencils in one (virtual) call; each stencil writes its own slots, and the
// assembler gathers the slots (framework/assembly). One virtual call per term, none per stencil.
//
// Slots of a stencil of arity K: gradient, K 3-vectors [N]; Hessian, K(K+1)/2 column-major 3x3
// blocks [N/m], lower triangle by rows: (0,0) (1,0) (1,1) (2,0) ...
#pragma once

#include <functional>
#include <span>
#include <string>
#include <vector>

#include "framework/core/projection.hpp"
#include "framework/core/step_participant.hpp"
#include "geometry/types.hpp"

namespace tack {

class Records;
class ResidualView;

// Receives the vertices of a stencil and an energy that belongs to it [J].
using EnergyShare = std::function<void(std::span<const int> vertices, double joules)>;

inline constexpr int largest_arity = 10;    // of a stencil
inline constexpr int largest_rank_one = 24;  // of one whose Hessian is of rank one

constexpr int hessian_blocks(int arity) { return arity * (arity + 1) / 2; }

// Stencils of one kind: stencil s touches the vertices[arity * s + (0..arity-1)].
struct StencilBatch {
  int arity = 0;
  int count = 0;
  const int* vertices = nullptr;
  int twists = 0;  // so many of each, the last ones, are no places but twists (rod/rod_frames.hpp): one number, first of three
  bool rank_one = false;  // every Hessian is a number times the square of a vector: negative as a whole, or not at all
};

// What terms may offer for each batch of lasting stencils: stencils a few at a time, so that their Hessians are summed
// before they leave the cache. Called from several threads.
class StencilRanges {
 public:
  // `first` is a multiple of this, and so is `last` but for the end of the batch.
  static constexpr int grain = 32;

  // Writes the slots of the stencils first .. last - 1; those of `first` are at the beginning.
  virtual void range_derivatives(const VecX& x, Projection projection, int first, int last, double* gradient,
                                 double* hessian) const = 0;

 protected:
  ~StencilRanges() = default;
};

class Term : public StepParticipant {
 public:
  explicit Term(std::string name) : name_(std::move(name)) {}
  const std::string& name() const { return name_; }

  virtual double value(const VecX& x) const = 0;  // [J]

  // The stencils, in the order in which slots are laid out. Empty for linear terms.
  virtual std::vector<StencilBatch> batches() const { return {}; }
  // Whether the stencils may differ from one configuration to the next (contact).
  virtual bool dynamic() const { return false; }

  // Writes every gradient slot, and every Hessian slot unless `hessian` is null.
  virtual void derivatives(const VecX& x, Projection projection, double* gradient,
                           double* hessian) const;

  // The term's stencils by ranges, batch for batch; empty if it gives them only all at once.
  virtual std::vector<const StencilRanges*> ranges() const { return {}; }

  // Adds a gradient that is not worth slots: linear potentials.
  virtual void add_linear_gradient(VecX& /*gradient*/) const {}

  // The term as least squares (residual_view.hpp); null if it has no such form.
  virtual const ResidualView* residual_view() const { return nullptr; }

  // Marks the vertices (n) of every stencil that lets go between `from` and `to` (3n): its pull
  // grows with its opening at `from`, and has passed its peak at `to`. A step does not start that
  // far (predicted_motion.hpp). All that take part in the step are at `from`.
  virtual void mark_letting_go(const VecX& /*from*/, const VecX& /*to*/,
                               std::vector<char>& /*vertices*/) const {}

  // Whether its value is an energy that bodies have, and not one that stands for what a step dissipates.
  virtual bool stores() const { return true; }
  // Calls share(vertices, energy) for each stencil at x and returns true: the energies add up to the
  // value. Returns false if the term does not offer it; all its stencils then belong together where
  // energy is counted by groups of bodies (stepping/group_balance.hpp).
  virtual bool share_energy(const VecX& /*x*/, const EnergyShare& /*share*/) const { return false; }

  // Adds what results show of it: once, when the world is built (records.hpp). Unless overridden: its value, as the energy of its name.
  virtual void publish(Records& records) const;

 private:
  std::string name_;
};

inline void Term::derivatives(const VecX&, Projection, double*, double*) const {}

}  // namespace tack
