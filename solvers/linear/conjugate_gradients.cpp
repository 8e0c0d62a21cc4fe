#include "solvers/linear/conjugate_gradients.hpp"

#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int chunk = 4096;  // numbers per chunk; shorter vectors run on one thread

}  // namespace

double ConjugateGradients::dot(const VecX& a, const VecX& b) {
  const int n = static_cast<int>(a.size());
  partial_.assign(chunk_count(n, chunk), 0.0);
  for_each_chunk(n, [&](int c, int first, int last) {
    partial_[c] = a.segment(first, last - first).dot(b.segment(first, last - first));
  }, chunk);
  double sum = 0;
  for (const double part : partial_) sum += part;
  return sum;
}

void ConjugateGradients::advance(double step, VecX& x) {
  for_each_chunk(static_cast<int>(x.size()), [&](int, int first, int last) {
    x.segment(first, last - first) += step * direction_.segment(first, last - first);
    residual_.segment(first, last - first) -= step * product_.segment(first, last - first);
  }, chunk);
}

void ConjugateGradients::turn(double ratio) {
  for_each_chunk(static_cast<int>(z_.size()), [&](int, int first, int last) {
    direction_.segment(first, last - first) =
        z_.segment(first, last - first) + ratio * direction_.segment(first, last - first);
  }, chunk);
}

}  // namespace tack
