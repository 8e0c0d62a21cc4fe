// Values of many terms are those of each term by itself, whichever are evaluated side by side.
#include <catch2/catch.hpp>

#include <cmath>
#include <memory>
#include <vector>

#include "framework/core/term_times.hpp"
#include "framework/core/term_values.hpp"
#include "geometry/parallel.hpp"

using namespace tack;

namespace {

// sum over vertices of factor * cos(x), with a stencil of one vertex each.
class CosineTerm : public Term, public StencilRanges {
 public:
  CosineTerm(int count, double factor, bool ranged, bool dynamic)
      : Term("cosine"), factor_(factor), ranged_(ranged), dynamic_(dynamic), vertices_(count) {
    for (int i = 0; i < count; ++i) vertices_[i] = i;
  }
  double value(const VecX& x) const override {
    return sum_chunks(static_cast<int>(vertices_.size()), [&](int first, int last) {
      double sum = 0;
      for (int i = first; i < last; ++i) sum += factor_ * std::cos(x[3 * i]);
      return sum;
    });
  }
  std::vector<StencilBatch> batches() const override {
    return {{1, static_cast<int>(vertices_.size()), vertices_.data()}};
  }
  bool dynamic() const override { return dynamic_; }
  std::vector<const StencilRanges*> ranges() const override {
    return ranged_ ? std::vector<const StencilRanges*>{this} : std::vector<const StencilRanges*>();
  }
  void range_derivatives(const VecX&, Projection, int, int, double*, double*) const override {}

 private:
  double factor_;
  bool ranged_, dynamic_;
  std::vector<int> vertices_;
};

}  // namespace

TEST_CASE("small terms have ranges, lasting stencils and one chunk of them at most") {
  CHECK(is_small(CosineTerm(1, 1, true, false)));
  CHECK(is_small(CosineTerm(chunk_size, 1, true, false)));
  CHECK_FALSE(is_small(CosineTerm(chunk_size + 1, 1, true, false)));
  CHECK_FALSE(is_small(CosineTerm(1, 1, false, false)));
  CHECK_FALSE(is_small(CosineTerm(1, 1, true, true)));
}

TEST_CASE("the values of terms are evaluated once each, with the bits of one after the other") {
  std::vector<std::unique_ptr<CosineTerm>> owned;
  for (int i = 0; i < 300; ++i) owned.push_back(std::make_unique<CosineTerm>(1 + 7 * i % 900, 1 + 1e-3 * i, i % 5 != 0, i % 11 == 0));
  std::vector<const Term*> terms;
  for (const auto& term : owned) terms.push_back(term.get());
  const VecX x = VecX::LinSpaced(2700, -1, 3);
  const TermValues values(terms);
  TermTimes times;
  const std::vector<double> plain = values.at(x, nullptr), timed = values.at(x, &times);
  REQUIRE(plain.size() == terms.size());
  CHECK(plain == timed);
  for (size_t i = 0; i < terms.size(); ++i) {
    CAPTURE(i);
    CHECK(plain[i] == terms[i]->value(x));
    CHECK(times.of(terms[i]).evaluations[static_cast<int>(Evaluation::value)] == 1);
  }
  CHECK(TermValues({}).at(x, nullptr).empty());
}
