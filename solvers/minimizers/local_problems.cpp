#include "solvers/minimizers/local_problems.hpp"

#include <utility>

namespace tack {
namespace {

Eigen::Index first_of(int block) { return 3 * static_cast<Eigen::Index>(block); }

// The whole objective as a function of some blocks.
class BlocksOf : public Objective {
 public:
  BlocksOf(Objective& whole, std::vector<int> blocks, const VecX& q) : whole_(whole), blocks_(std::move(blocks)), q_(q) {}

  const std::vector<int>& blocks() const { return blocks_; }
  VecX gathered(const VecX& all) const {
    VecX own(size());
    for (size_t i = 0; i < blocks_.size(); ++i) own.segment<3>(first_of(static_cast<int>(i))) = all.segment<3>(first_of(blocks_[i]));
    return own;
  }
  VecX scattered(const VecX& own, VecX all) const {
    for (size_t i = 0; i < blocks_.size(); ++i) all.segment<3>(first_of(blocks_[i])) = own.segment<3>(first_of(static_cast<int>(i)));
    return all;
  }

  int size() const override { return 3 * static_cast<int>(blocks_.size()); }
  void move_to(const VecX& q) override { whole_.move_to(scattered(q, q_)); }
  double value() override { return whole_.value(); }
  double value_noise() const override { return whole_.value_noise(); }
  const VecX& gradient() override { return gradient_ = gathered(whole_.gradient()); }
  const BlockMatrix& hessian(const HessianRequest& request) override {
    const BlockMatrix& all = whole_.hessian(request);
    std::vector<int> local(all.columns(), -1);
    for (size_t i = 0; i < blocks_.size(); ++i) local[blocks_[i]] = static_cast<int>(i);
    matrix_.column_start.assign(1, 0);
    matrix_.row.clear();
    matrix_.values.clear();
    ++matrix_.version;
    for (const int c : blocks_) {
      for (int k = all.column_start[c]; k < all.column_start[c + 1]; ++k) {
        if (local[all.row[k]] < 0) continue;
        matrix_.row.push_back(local[all.row[k]]);
        matrix_.values.insert(matrix_.values.end(), all.block(k).data(), all.block(k).data() + 9);
      }
      matrix_.column_start.push_back(matrix_.blocks());
    }
    return matrix_;
  }
  int value_count() const override { return whole_.value_count(); }

 private:
  Objective& whole_;
  std::vector<int> blocks_;
  const VecX& q_;
  VecX gradient_;
  BlockMatrix matrix_;
};

}  // namespace

std::vector<LocalProblem> local_problems(const MinimizerProblem& problem, const std::vector<std::vector<int>>& sets, VecX& q) {
  if (problem.locals) return problem.locals(sets);
  std::vector<LocalProblem> all;
  for (const std::vector<int>& blocks : sets) {
    auto objective = std::make_unique<BlocksOf>(problem.objective, blocks, q);
    const BlocksOf* const own = objective.get();
    LocalProblem& local = all.emplace_back();
    local.feasible_step = [&problem, &q, own](const VecX& at, const VecX& p) {
      return problem.feasible_step(own->scattered(at, q), own->scattered(p, VecX::Zero(q.size())));
    };
    local.block_bounds = [step = local.feasible_step](const VecX& at, const VecX& p) { return VecX::Constant(at.size() / 3, step(at, p)).eval(); };
    local.resume = [&q, own, target = objective.get()] {
      const VecX at = own->gathered(q);
      target->move_to(at);
      return at;
    };
    local.q = own->gathered(q);
    local.objective = std::move(objective);
  }
  return all;
}

}  // namespace tack
