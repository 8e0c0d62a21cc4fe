#include "framework/assembly/assembler.hpp"

#include <catch2/catch.hpp>
#include <numeric>

#include "framework/core/term_times.hpp"
#include "geometry/errors.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/polynomial_term.hpp"
#include "tests/support/random_blocks.hpp"

using namespace tack;

namespace {

constexpr int vertices = 30;

// Stencils on random, different vertices.
std::vector<int> stencils(int arity, int count, RandomMotions& random) {
  std::vector<int> all;
  for (int s = 0; s < count; ++s) {
    std::vector<int> order(vertices);
    std::iota(order.begin(), order.end(), 0);
    for (int i = 0; i < arity; ++i) {
      std::swap(order[i], order[i + static_cast<int>(random.uniform(0, vertices - i))]);
      all.push_back(order[i]);
    }
  }
  return all;
}

struct Problem {
  Problem() {
    movable.assign(vertices, 1);
    for (const int fixed : {0, 7, 8, 29}) movable[fixed] = 0;
    depend({});
    x = random.vectors(3 * vertices);
  }

  void depend(const Dependences& dependences) {
    dofs = DofMap(movable, dependences);
    // x = D x + L q.
    MatX d = MatX::Identity(3 * vertices, 3 * vertices);
    for (const Dependence& dependence : dependences)
      for (const auto& [on, weight] : dependence.on)
        d.block<3, 3>(3 * dependence.vertex, 3 * on) -= weight * Mat3::Identity();
    MatX own = MatX::Zero(3 * vertices, dofs.size());
    for (int b = 0; b < dofs.block_count(); ++b) own.block<3, 3>(3 * dofs.vertex_of_block(b), 3 * b).setIdentity();
    w = d.partialPivLu().solve(own);
    mass = VecX::Constant(dofs.block_count(), 0.7) + 0.1 * random.vectors(dofs.block_count());
  }

  // Scale times the sum over the free unknowns, plus the masses.
  MatX expected_hessian(const TermScales& scales) const {
    MatX full = MatX::Zero(x.size(), x.size());
    for (const Term* term : terms) full += scales.of(*term) * dense_hessian(*term, x, Projection::none);
    MatX free = w.transpose() * full * w;
    for (int r = 0; r < dofs.block_count(); ++r)
      free.block<3, 3>(3 * r, 3 * r) += mass(r) * Mat3::Identity();
    return free;
  }
  VecX expected_gradient(const TermScales& scales) const {
    VecX full = VecX::Zero(x.size());
    for (const Term* term : terms) full += scales.of(*term) * dense_gradient(*term, x);
    return w.transpose() * full;
  }
  void check(Assembler& assembler, BlockMatrix& matrix) const {
    const TermScales scales{0.3, 0.7};
    VecX gradient = VecX::Constant(dofs.size(), 2.0), alone = VecX::Zero(dofs.size());
    assembler.assemble(x, scales, {Projection::none}, mass, gradient, matrix);
    assembler.add_gradient(x, scales, alone);
    const MatX hessian = expected_hessian(scales);
    CHECK((dense(matrix) - hessian).norm() <= 1e-13 * hessian.norm());
    CHECK((gradient - VecX::Constant(dofs.size(), 2.0) - expected_gradient(scales)).norm() <= 1e-12 * gradient.norm());
    CHECK((alone - expected_gradient(scales)).norm() <= 1e-13 * alone.norm());
    for (int c = 0; c < matrix.columns(); ++c) {
      CHECK(matrix.row[matrix.column_start[c]] == c);
      for (int k = matrix.column_start[c] + 1; k < matrix.column_start[c + 1]; ++k)
        CHECK(matrix.row[k] > matrix.row[k - 1]);
    }
  }

  RandomMotions random{2};
  std::vector<char> movable;
  DofMap dofs;
  MatX w;
  VecX x, mass;
  PolynomialTerm pairs{2, stencils(2, 60, random)}, triples{3, stencils(3, 40, random)},
      quads{4, stencils(4, 50, random)}, contact{4, stencils(4, 20, random), true},
      close{2, {}, true};
  std::vector<const Term*> terms = {&pairs, &contact, &triples, &close, &quads};
  PhaseClock clock;
};

}  // namespace

TEST_CASE("the toy term's derivatives are those of its value", "[assembly]") {
  Problem p;
  for (const Term* term : p.terms) {
    const VecX slopes = gradient_by_differences([&](const VecX& y) { return term->value(y); }, p.x, 1e-3);
    CHECK((slopes - dense_gradient(*term, p.x)).norm() <= 1e-8 * (1 + slopes.norm()));
    const MatX curvatures =
        hessian_by_differences([&](const VecX& y) { return dense_gradient(*term, y); }, p.x, 1e-3);
    CHECK((curvatures - dense_hessian(*term, p.x, Projection::none)).norm() <= 1e-8 * (1 + curvatures.norm()));
  }
}

TEST_CASE("assembly: the sum of all stencils over the free vertices", "[assembly]") {
  Problem p;
  Assembler assembler(p.terms, p.dofs, p.clock);
  BlockMatrix matrix;
  p.check(assembler, matrix);
}

TEST_CASE("assembly: stencils that are summed chunk by chunk", "[assembly]") {
  Problem p;
  p.triples.by_ranges();
  PolynomialTerm many = PolynomialTerm(4, stencils(4, 1100, p.random)).by_ranges();
  PolynomialTerm none = PolynomialTerm(3, {}).by_ranges();
  p.terms.insert(p.terms.begin() + 1, {&many, &none});
  Assembler assembler(p.terms, p.dofs, p.clock);
  BlockMatrix matrix;
  p.check(assembler, matrix);
  p.contact.set_vertices(stencils(4, 40, p.random));
  p.check(assembler, matrix);

  // Flags clamp the stencils that are clamped when slots are gathered at once.
  std::vector<char> flags(p.dofs.block_count(), 0);
  flags[3] = flags[11] = 1;
  VecX gradient = VecX::Zero(p.dofs.size());
  assembler.assemble(p.x, {}, {.clamp_at = &flags}, p.mass, gradient, matrix);
  PolynomialTerm slots(4, many.vertex_list());
  p.terms[1] = &slots;
  Assembler other(p.terms, p.dofs, p.clock);
  BlockMatrix expected;
  other.assemble(p.x, {}, {.clamp_at = &flags}, p.mass, gradient, expected);
  CHECK((dense(matrix) - dense(expected)).norm() <= 1e-13 * dense(expected).norm());
  CHECK(assembler.largest_stencil_force() == other.largest_stencil_force());
}

TEST_CASE("assembly: a term with several batches by ranges", "[assembly]") {
  class Batches : public Term {
   public:
    explicit Batches(std::vector<PolynomialTerm> parts) : Term("batches"), parts_(std::move(parts)) {}
    double value(const VecX& x) const override {
      double sum = 0;
      for (const auto& part : parts_) sum += part.value(x);
      return sum;
    }
    std::vector<StencilBatch> batches() const override {
      std::vector<StencilBatch> all;
      for (const auto& part : parts_) all.push_back(part.batches()[0]);
      return all;
    }
    std::vector<const StencilRanges*> ranges() const override {
      std::vector<const StencilRanges*> all;
      for (const auto& part : parts_) all.push_back(&part);
      return all;
    }
    void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
      for (const auto& part : parts_) {
        const StencilBatch batch = part.batches()[0];
        part.derivatives(x, projection, gradient, hessian);
        gradient += 3 * batch.arity * batch.count;
        if (hessian) hessian += 9 * hessian_blocks(batch.arity) * batch.count;
      }
    }

   private:
    std::vector<PolynomialTerm> parts_;
  };
  Problem p;
  p.triples.by_ranges();
  const Batches batches({{largest_arity, stencils(largest_arity, 700, p.random)}, {3, {}}, {7, stencils(7, 40, p.random)}});
  p.terms.insert(p.terms.begin(), &batches);
  TermTimes times;
  p.clock.time_terms(&times);
  Assembler assembler(p.terms, p.dofs, p.clock);
  BlockMatrix matrix;
  p.check(assembler, matrix);
  for (const Term* term : {static_cast<const Term*>(&batches), static_cast<const Term*>(&p.triples)})
    CHECK(times.of(term).evaluations[static_cast<int>(Evaluation::hessian)] == 1);
  // Clamping stencil by stencil, including the largest stencil.
  const std::vector<char> flags(p.dofs.block_count(), 1);
  VecX gradient = VecX::Zero(p.dofs.size());
  assembler.assemble(p.x, {}, {.clamp_at = &flags}, p.mass, gradient, matrix);
  CHECK(smallest_eigenvalue(dense(matrix)) > 0);
}

TEST_CASE("assembly: contact that comes and goes", "[assembly]") {
  Problem p;
  Assembler assembler(p.terms, p.dofs, p.clock);
  BlockMatrix matrix;
  p.check(assembler, matrix);
  const auto version = matrix.version;
  p.contact.set_vertices({});  // blocks stay as explicit zeros
  p.check(assembler, matrix);
  CHECK(matrix.version == version);
  for (int round = 0; round < 6; ++round) {
    p.contact.set_vertices(stencils(4, 5 + 10 * round, p.random));
    p.close.set_vertices(stencils(2, 30 - 5 * round, p.random));
    VecX alone = VecX::Zero(p.dofs.size());
    assembler.add_gradient(p.x, {}, alone);  // of the new stencils, before any Hessian
    for (int same = 0; same < 2; ++same) {
      p.x = p.random.vectors(p.x.size());
      p.check(assembler, matrix);
    }
  }
  CHECK(matrix.version > version);
}

TEST_CASE("assembly: vertices that depend on others", "[assembly]") {
  Problem p;
  p.triples.by_ranges();
  // Dependent on fixed and free vertices, in chains, and two that share the block of a third vertex.
  p.depend({{3, {{1, 0.25}, {2, 0.75}}},
            {4, {{3, 0.5}, {5, 0.5}}},
            {9, {{7, 0.3}, {8, 0.7}}},
            {10, {{0, 0.4}, {12, 0.6}}},
            {13, {{12, 1}}},
            {14, {{13, 1}}},
            {20, {{1, 0.1}, {5, -0.4}, {12, 0.6}, {21, 0.7}}},
            {22, {{1, 0.6}, {5, 0.4}, {12, -0.6}, {21, 0.6}}},
            {23, {{1, 0.2}, {5, 0.1}, {12, 0.3}, {21, 0.4}}}});
  PolynomialTerm many = PolynomialTerm(4, stencils(4, 700, p.random)).by_ranges();
  // Neighbours with equal blocks.
  std::vector<int> same;
  for (int s = 0; s < 200; ++s)
    for (const int v : {20, 22, 23, 26}) same.push_back(v);
  PolynomialTerm bodies(4, same, true);
  PolynomialTerm plain = PolynomialTerm(2, {25, 26, 26, 27}).by_ranges();
  p.terms.insert(p.terms.end(), {&many, &bodies, &plain});
  Assembler assembler(p.terms, p.dofs, p.clock);
  BlockMatrix matrix;
  p.check(assembler, matrix);
  p.contact.set_vertices(stencils(4, 40, p.random));
  p.check(assembler, matrix);
  p.contact.set_vertices({});
  bodies.set_vertices({});
  p.check(assembler, matrix);

  class Push : public Term {
   public:
    Push() : Term("push") {}
    double value(const VecX& x) const override { return 3 * x.sum(); }
    void add_linear_gradient(VecX& gradient) const override { gradient.array() += 3; }
  };
  const Push push;
  p.terms.push_back(&push);
  Assembler pushed(p.terms, p.dofs, p.clock);
  p.check(pushed, matrix);
}

TEST_CASE("degrees of freedom: dependent vertices are updated, and forces on them move to the independent vertices", "[dofs]") {
  Problem p;
  p.depend({{3, {{1, 0.25}, {2, 0.75}}}, {4, {{3, 0.5}, {5, 0.5}}}, {9, {{7, 0.3}, {8, 0.7}}}, {10, {{0, 0.4}, {12, 0.6}}},
            {13, {{12, 1}}}});
  CHECK(p.dofs.block_count() == vertices - 4 - 5);
  CHECK(p.dofs.block(13) == p.dofs.block(12));
  CHECK(p.dofs.mixed(4));
  CHECK(!p.dofs.moves(9));  // depends on fixed vertices alone
  VecX x = p.x, q = p.random.vectors(p.dofs.size());
  p.dofs.scatter(q, x);
  CHECK(vertex(x, 7) == vertex(p.x, 7));
  CHECK((vertex(x, 4) - (0.125 * vertex(x, 1) + 0.375 * vertex(x, 2) + 0.5 * vertex(x, 5))).norm() < 1e-15);
  CHECK((vertex(x, 9) - (0.3 * vertex(x, 7) + 0.7 * vertex(x, 8))).norm() < 1e-15);
  CHECK((vertex(x, 10) - (0.4 * vertex(x, 0) + 0.6 * vertex(x, 12))).norm() < 1e-15);
  VecX again;
  p.dofs.gather(x, again);
  CHECK(again == q);
  VecX forces = p.random.vectors(3 * vertices);
  const VecX expected = p.w.transpose() * forces;
  const Vec3 on_held = vertex(forces, 7) + 0.3 * vertex(forces, 9);
  p.dofs.move_to_independents(forces);
  VecX collected;
  p.dofs.gather(forces, collected);
  CHECK((collected - expected).norm() < 1e-13);
  CHECK((vertex(forces, 7) - on_held).norm() < 1e-15);
  CHECK(vertex(forces, 9).isZero());
  CHECK_THROWS_AS(DofMap(p.movable, {{3, {{4, 1}}}, {4, {{3, 1}}}}), InputError);
}

TEST_CASE("assembly: a linear term needs no slots", "[assembly]") {
  class Pull : public Term {
   public:
    Pull() : Term("pull") {}
    double value(const VecX& x) const override { return 3 * x.sum(); }
    void add_linear_gradient(VecX& gradient) const override { gradient.array() += 3; }
  };
  Problem p;
  const Pull pull;
  p.terms.push_back(&pull);
  Assembler assembler(p.terms, p.dofs, p.clock);
  BlockMatrix matrix;
  p.check(assembler, matrix);
}

TEST_CASE("assembly: the largest force of any stencil", "[assembly]") {
  const PolynomialTerm pair(2, {0, 1});
  const std::vector<char> movable = {1, 1};
  const DofMap dofs(movable);
  PhaseClock clock;
  Assembler assembler({&pair}, dofs, clock);
  VecX x(6), gradient = VecX::Zero(6);
  x << 2, 0, 0, 0, 0, 0;
  assembler.add_gradient(x, {0.5, 0.5}, gradient);
  CHECK(assembler.largest_stencil_force() == 8.0);  // |u|^3, not scaled
  CHECK(gradient(0) == 4.0);
}

TEST_CASE("assembly: the gradients of the last evaluation at every vertex, fixed ones included", "[assembly]") {
  struct Drag : PolynomialTerm {
    using PolynomialTerm::PolynomialTerm;
    bool stores() const override { return false; }
  };
  Problem p;
  const Drag drag(2, {1, 2});
  p.terms.push_back(&drag);
  Assembler assembler(p.terms, p.dofs, p.clock);
  VecX gradient = VecX::Zero(p.dofs.size());
  assembler.add_gradient(p.x, {0.3, 0.7}, gradient);
  VecX expected = VecX::Zero(p.x.size()), found = VecX::Zero(p.x.size());
  for (const Term* term : p.terms)
    if (term != &drag) expected += dense_gradient(*term, p.x);
  assembler.add_last_gradients(found);
  CHECK((found - expected).norm() <= 1e-13 * expected.norm());
}
