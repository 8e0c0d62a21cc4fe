// Fill-reducing ordering and symbolic Cholesky analysis of a block matrix by SuiteSparse. The
// ordering is computed on the graph of 3x3 blocks, nine times smaller than the matrix, as the
// better of AMD and METIS by predicted operations. It is reused while the pattern changes little
// (contacts that come and go). The analysis is redone for every new pattern, either of the scalar
// matrix, for CHOLMOD's own factorisation, or of the matrix of blocks.
#pragma once

#include <cstdint>

#include "framework/config/field.hpp"
#include "framework/core/linear_solver.hpp"
#include "solvers/linear/cholmod_session.hpp"
#include "solvers/linear/scalar_csc.hpp"

namespace tack {

class CholmodAnalysis {
 public:
  enum class Ordering { best, amd, metis };
  explicit CholmodAnalysis(Ordering ordering = Ordering::best) : ordering_(ordering) {}

  void fields(Fields& f);
  enum class Kind { simplicial, supernodal, supernodal_blocks };
  // Updates factor() and, for scalar kinds, csc() to the matrix's pattern. Returns true if the
  // pattern is new.
  bool update(const BlockMatrix& matrix, Kind kind);

  cholmod_factor* factor() const { return factor_.get(); }
  cholmod_common* common() { return session_.get(); }
  ScalarCsc& csc() { return csc_; }
  int count() const { return count_; }
  // Cost of the present factor, in scalars.
  FactorCost cost() const { return cost_; }
  // Returns an upper bound of the cost of the best ordering, the cost of AMD, in a tenth of the
  // time that METIS takes on solids. Only if compares_amd().
  FactorCost bound(const BlockMatrix& matrix);
  bool compares_amd() const { return ordering_ != Ordering::metis; }

 private:
  void configure();
  FactorPtr analyze_with(const BlockMatrix& matrix, std::vector<int>& block_order);
  void order(const BlockMatrix& matrix);
  FactorCost last_cost(Kind kind) const;

  Ordering ordering_;
  Kind kind_ = Kind::supernodal;
  CholmodSession session_;
  ScalarCsc csc_;
  std::vector<int> block_order_;
  FactorPtr factor_;
  FactorCost cost_;
  double operations_ = 0;  // predicted for the ordering when it was computed
  std::uint64_t version_ = 0;
  int count_ = 0;
};

}  // namespace tack
