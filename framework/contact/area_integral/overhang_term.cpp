#include "framework/contact/area_integral/overhang_term.hpp"

#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/core/local_stencils.hpp"
#include "framework/core/records.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int arity = 6, blocks = hessian_blocks(arity);

}  // namespace

// Part of the term in a local problem.
class LocalOverhangTerm : public OverhangTerm {
 public:
  LocalOverhangTerm(std::vector<Overhang> overhangs, VecX start) { set(std::move(overhangs), std::move(start)); }
};

OverhangTerm::OverhangTerm(const AreaIntegral& integral) : Term("overhangs"), integral_(&integral) {}

void OverhangTerm::set(std::vector<Overhang> overhangs, VecX start) {
  overhangs_ = std::move(overhangs);
  start_ = std::move(start);
  vertices_.clear();
  for (const Overhang& o : overhangs_) vertices_.insert(vertices_.end(), o.vertices.begin(), o.vertices.end());
}

void OverhangTerm::clear_caches() {
  if (integral_) set({}, {});
}

void OverhangTerm::begin_step(const StepStart& start) {
  if (integral_) set(integral_->overlap_boundary_forces().overhangs(), start.x);
}

double OverhangTerm::value(const VecX& x) const {
  return sum_chunks(static_cast<int>(overhangs_.size()), [&](int first, int last) {
    double sum = 0;
    for (int s = first; s < last; ++s) sum += overhangs_[s].value(overhangs_[s].width(x, start_));
    return sum;
  });
}

std::vector<StencilBatch> OverhangTerm::batches() const {
  StencilBatch batch{arity, static_cast<int>(overhangs_.size()), vertices_.data()};
  batch.rank_one = true;
  return {batch};
}

void OverhangTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  for_each(static_cast<int>(overhangs_.size()), [&](int s) {
    const Overhang& o = overhangs_[s];
    const double w = o.width(x, start_), slope = o.slope(w);
    for (int i = 0; i < arity; ++i) Eigen::Map<Vec3>{gradient + 3 * (arity * s + i)} = slope * o.gradient[i];
    if (!hessian) return;
    const double curvature = projected(o.curvature(w), projection);
    double* block = hessian + 9 * blocks * s;
    for (int i = 0; i < arity; ++i)
      for (int j = 0; j <= i; ++j, block += 9) Eigen::Map<Mat3>{block} = curvature * o.gradient[i] * o.gradient[j].transpose();
  });
}

std::unique_ptr<Term> OverhangTerm::restricted(const StencilChoice& choice) const {
  std::vector<Overhang> chosen;
  for (const int s : choice.stencils[0]) {
    chosen.push_back(overhangs_[s]);
    chosen.back().vertices = choice.local(overhangs_[s].vertices);
  }
  VecX start(3 * choice.vertices.count());
  for (int i = 0; i < choice.vertices.count(); ++i) vertex(start, i) = vertex(start_, choice.vertices.global(i));
  return std::make_unique<LocalOverhangTerm>(std::move(chosen), std::move(start));
}

bool OverhangTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  for (const Overhang& o : overhangs_) visit(o.vertices, o.value(o.width(x, start_)));
  return true;
}

// Publishes the forces and the energy as adhesion. Their work is part of the energy that contact stores.
void OverhangTerm::publish(Records& records) const {
  ForceRecord force_record{"rim", ForceDirection::normal, {"adhesion"}};
  force_record.add = [this](const VecX& x, std::string_view, VecX& forces) {
    for (const Overhang& o : overhangs_) {
      const double slope = o.slope(o.width(x, start_));
      for (int i = 0; i < arity; ++i) vertex(forces, o.vertices[i]) -= slope * o.gradient[i];
    }
  };
  force_record.between = [this](const VecX& x, std::string_view, ObjectPair pair) {
    Vec3 sum = Vec3::Zero();
    for (const Overhang& o : overhangs_) {
      const bool own = o.object == pair.a && o.other_object == pair.b, other = o.object == pair.b && o.other_object == pair.a;
      if (!own && !other) continue;
      const double slope = o.slope(o.width(x, start_));
      for (int i = own ? 0 : 3; i < (own ? 3 : 6); ++i) sum -= slope * o.gradient[i];
    }
    return sum;
  };
  records.add(std::move(force_record));
  records.add(EnergyRecord{"adhesion", EnergyKind::contact, [this](const VecX& x) { return value(x); }});
  records.add(FlowRecord{"overhangs", {{"work_rim", FlowKind::within}}, [this](const VecX& x, double* amounts) { amounts[0] = -value(x); }});
}

}  // namespace tack
