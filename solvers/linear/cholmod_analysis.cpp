#include "solvers/linear/cholmod_analysis.hpp"

namespace tack {

void CholmodAnalysis::fields(Fields& f) {
  f.choice("ordering", ordering_,
           {{"best", Ordering::best, "the cheaper of the two by predicted operations"},
            {"amd", Ordering::amd, "approximate minimum degree"},
            {"metis", Ordering::metis, "nested dissection"}},
           "fill-reducing ordering");
}

void CholmodAnalysis::configure(bool supernodal) {
  session_->print = 0;
  session_->supernodal = supernodal ? CHOLMOD_SUPERNODAL : CHOLMOD_SIMPLICIAL;
  session_->final_ll = 1;
  session_->nmethods = 1;
  session_->method[0].ordering = CHOLMOD_GIVEN;
  session_->postorder = 1;
  session_->quick_return_if_not_posdef = 1;
}

bool CholmodAnalysis::update(const BlockMatrix& matrix, bool supernodal) {
  if (matrix.version == version_ && factor_) return false;
  configure(supernodal);
  csc_.set_structure(matrix);
  const bool same_size = permutation_.size() == static_cast<size_t>(matrix.size());
  factor_ = same_size ? analyze_with(permutation_, matrix.size()) : nullptr;
  constexpr double tolerated_growth = 1.3;
  if (!factor_ || session_->fl > tolerated_growth * operations_) order(matrix);
  version_ = matrix.version;
  ++count_;
  return true;
}

FactorPtr CholmodAnalysis::analyze_with(std::vector<int>& permutation, int n) {
  cholmod_sparse view = lower_view(n, csc_.column_start, csc_.row, nullptr);
  return {cholmod_analyze_p(&view, permutation.data(), nullptr, 0, session_.get()),
          FactorDeleter{session_.get()}};
}

// Orders the graph of blocks and keeps the cheapest.
void CholmodAnalysis::order(const BlockMatrix& matrix) {
  const int n = matrix.columns();
  auto start = matrix.column_start;
  auto rows = matrix.row;
  cholmod_sparse graph = lower_view(n, start, rows, nullptr);
  factor_ = nullptr;
  for (const Ordering choice : {Ordering::amd, Ordering::metis}) {
    if (ordering_ != Ordering::best && ordering_ != choice) continue;
    std::vector<int> block_order(n);
    const bool ok = choice == Ordering::amd
                        ? cholmod_amd(&graph, nullptr, 0, block_order.data(), session_.get())
                        : cholmod_metis(&graph, nullptr, 0, 1, block_order.data(), session_.get());
    if (!ok) continue;
    std::vector<int> order(3 * n);
    for (int k = 0; k < 3 * n; ++k) order[k] = 3 * block_order[k / 3] + k % 3;
    FactorPtr factor = analyze_with(order, 3 * n);
    if (!factor || (factor_ && session_->fl >= operations_)) continue;
    operations_ = session_->fl;
    permutation_ = std::move(order);
    factor_ = std::move(factor);
  }
}

}  // namespace tack
