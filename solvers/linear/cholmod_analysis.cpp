#include "solvers/linear/cholmod_analysis.hpp"

namespace tack {
namespace {

// Returns the graph of the blocks; CHOLMOD only reads its arrays.
cholmod_sparse graph_of(const BlockMatrix& matrix) {
  return lower_view(matrix.columns(), const_cast<std::vector<int>&>(matrix.column_start),
                    const_cast<std::vector<int>&>(matrix.row), nullptr);
}

}  // namespace

void CholmodAnalysis::fields(Fields& f) {
  f.choice("ordering", ordering_,
           {{"best", Ordering::best, "the cheaper of the two by predicted operations"},
            {"amd", Ordering::amd, "approximate minimum degree"},
            {"metis", Ordering::metis, "nested dissection"}},
           "fill-reducing ordering");
}

void CholmodAnalysis::configure() {
  session_->print = 0;
  session_->supernodal = kind_ == Kind::simplicial ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
  session_->final_ll = 1;
  session_->nmethods = 1;
  session_->method[0].ordering = CHOLMOD_GIVEN;
  session_->postorder = 1;
  session_->quick_return_if_not_posdef = 1;
  // Numbers of columns, in blocks, below which supernodes merge.
  if (kind_ == Kind::supernodal_blocks) {
    session_->nrelax[0] = 2;
    session_->nrelax[1] = 6;
    session_->nrelax[2] = 16;
  }
}

bool CholmodAnalysis::update(const BlockMatrix& matrix, Kind kind) {
  if (matrix.version == version_ && factor_ && kind == kind_) return false;
  kind_ = kind;
  configure();
  if (kind != Kind::supernodal_blocks) csc_.set_structure(matrix);
  const bool same_size = block_order_.size() == static_cast<size_t>(matrix.columns());
  factor_ = same_size ? analyze_with(matrix, block_order_) : nullptr;
  cost_ = last_cost(kind_);
  constexpr double tolerated_growth = 1.3;
  if (!factor_ || session_->fl > tolerated_growth * operations_) order(matrix);
  version_ = matrix.version;
  ++count_;
  return true;
}

// Returns the predicted cost in scalars; a product of blocks is 27 scalar products.
FactorCost CholmodAnalysis::last_cost(Kind kind) const {
  const bool blocks = kind == Kind::supernodal_blocks;
  return {session_.get()->fl * (blocks ? 27 : 1), session_.get()->lnz * (blocks ? 9 : 1)};
}

FactorCost CholmodAnalysis::bound(const BlockMatrix& matrix) {
  cholmod_sparse graph = graph_of(matrix);
  std::vector<int> block_order(matrix.columns());
  cholmod_amd(&graph, nullptr, 0, block_order.data(), session_.get());
  return last_cost(Kind::supernodal_blocks);
}

FactorPtr CholmodAnalysis::analyze_with(const BlockMatrix& matrix, std::vector<int>& block_order) {
  const FactorDeleter deleter{session_.get()};
  const int n = matrix.columns();
  if (kind_ == Kind::supernodal_blocks) {
    cholmod_sparse graph = graph_of(matrix);
    return {cholmod_analyze_p(&graph, block_order.data(), nullptr, 0, session_.get()), deleter};
  }
  std::vector<int> order(3 * n);
  for (int k = 0; k < 3 * n; ++k) order[k] = 3 * block_order[k / 3] + k % 3;
  cholmod_sparse view = lower_view(3 * n, csc_.column_start, csc_.row, nullptr);
  return {cholmod_analyze_p(&view, order.data(), nullptr, 0, session_.get()), deleter};
}

// Orders the graph of blocks and keeps the cheapest ordering.
void CholmodAnalysis::order(const BlockMatrix& matrix) {
  const int n = matrix.columns();
  cholmod_sparse graph = graph_of(matrix);
  factor_ = nullptr;
  for (const Ordering choice : {Ordering::amd, Ordering::metis}) {
    if (ordering_ != Ordering::best && ordering_ != choice) continue;
    std::vector<int> block_order(n);
    const bool ok = choice == Ordering::amd
                        ? cholmod_amd(&graph, nullptr, 0, block_order.data(), session_.get())
                        : cholmod_metis(&graph, nullptr, 0, 1, block_order.data(), session_.get());
    if (!ok) continue;
    FactorPtr factor = analyze_with(matrix, block_order);
    if (!factor || (factor_ && session_->fl >= operations_)) continue;
    operations_ = session_->fl;
    cost_ = last_cost(kind_);
    block_order_ = std::move(block_order);
    factor_ = std::move(factor);
  }
}

}  // namespace tack
