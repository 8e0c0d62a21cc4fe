// Debonding of a motion: how far it takes the laws of adhesion that a term evaluates
// (Term::mark_debonding). The motion is bounded in the opening of each stencil, not in the
// displacement of its vertices, because surfaces that move together do not debond.
#pragma once

namespace tack {

/// Marks of a vertex, as bits: what a motion does to the stencils of the vertex.
enum DebondingMark : char {
  adheres = 1,      // a stencil adheres at the start of the motion
  passes_peak = 2,  // the pull of a stencil grows with its opening at the start, and has passed its
                    // peak at the end
  passes_over = 4,  // a stencil opens, is past its peak at the end, and takes more than
                    // debonding_work_max of its work of adhesion in the motion
};

/// Fraction of the work of adhesion of a law that one motion may take past the peak. The work of
/// the motion is the larger of the energy that the law takes up and the trapezoidal rule of the
/// tractions at both ends.
inline constexpr double debonding_work_max = 0.125;

}  // namespace tack
