// Owners of CHOLMOD's objects. Only the CHOLMOD solver includes this file.
#pragma once

#include <cholmod.h>

#include <memory>
#include <vector>

namespace tack {

class CholmodSession {
 public:
  CholmodSession() { cholmod_start(&common_); }
  ~CholmodSession() { cholmod_finish(&common_); }
  CholmodSession(const CholmodSession&) = delete;
  CholmodSession& operator=(const CholmodSession&) = delete;
  cholmod_common* get() { return &common_; }
  const cholmod_common* get() const { return &common_; }
  cholmod_common* operator->() { return &common_; }

 private:
  cholmod_common common_{};
};

struct FactorDeleter {
  cholmod_common* common = nullptr;
  void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, common); }
};
using FactorPtr = std::unique_ptr<cholmod_factor, FactorDeleter>;

// Work memory that solves reuse.
struct SolveWork {
  explicit SolveWork(cholmod_common* session) : common(session) {}
  ~SolveWork() {
    for (cholmod_dense** dense : {&solution, &y, &e}) cholmod_free_dense(dense, common);
  }
  SolveWork(const SolveWork&) = delete;
  SolveWork& operator=(const SolveWork&) = delete;
  void solve(cholmod_factor* factor, cholmod_dense* right, cholmod_common* session) {
    cholmod_solve2(CHOLMOD_A, factor, right, nullptr, &solution, nullptr, &y, &e, session);
  }

  cholmod_common* common;
  cholmod_dense *solution = nullptr, *y = nullptr, *e = nullptr;
};

// Returns a CHOLMOD view of lower compressed columns. The caller keeps the arrays.
inline cholmod_sparse lower_view(int n, std::vector<int>& column_start, std::vector<int>& row,
                                 double* values) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<size_t>(n);
  view.nzmax = row.size();
  view.p = column_start.data();
  view.i = row.data();
  view.x = values;
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = values ? CHOLMOD_REAL : CHOLMOD_PATTERN;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

}  // namespace tack
