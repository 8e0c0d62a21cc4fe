#include "framework/contact/terms/friction_term.hpp"

#include <algorithm>
#include <iterator>

#include "framework/contact/points/grain.hpp"
#include "framework/contact/terms/slip.hpp"
#include "framework/core/local_stencils.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

template <class Point, class Number>
double sum_over(const std::vector<Point>& points, const PairTable& pairs, const VecX& x, const VecX& start, const Number& number) {
  return sum_chunks(static_cast<int>(points.size()), [&](int first, int last) {
    double sum = 0;
    for (int i = first; i < last; ++i) sum += number(Slip(points[i], x, start), pairs.tangential(points[i].law));
    return sum;
  });
}

TangentialTerm tangential_term(std::string_view summand) {
  if (summand.empty()) return TangentialTerm::all;
  return summand == "friction" ? TangentialTerm::friction : TangentialTerm::adhesion;
}

}  // namespace

template <class Number>
double FrictionTerm::sum_of(const VecX& x, const Number& number) const {
  double sum = 0;
  for_each_arity(sliding(), [&](const auto& points) { sum += sum_over(points, system_.pairs(), x, start_, number); });
  for (const RollingGroup& group : rolling_) sum += sum_over(group.points, system_.pairs(), x, start_, number);
  return sum;
}

FrictionTerm::FrictionTerm(const ContactSystem& system, ContactSpins spins)
    : Term("friction"), system_(system), sticks_(StickAnchors::any(system.pairs())), spins_(std::move(spins)) {
  for (size_t law = 0; law < system.pairs().laws().size(); ++law)
    wanted_.push_back(system.pairs().tangential(static_cast<int>(law)).acts());
}

void FrictionTerm::set_grains(std::vector<Vec3> grains) {
  grains_ = std::move(grains);
  for (size_t law = 0; law < wanted_.size(); ++law) grained_ = grained_ || system_.pairs().tangential(static_cast<int>(law)).across != 1;
}

void FrictionTerm::publish(Records& records) const {
  ForceRecord force{"friction", ForceDirection::tangential, {"friction", "adhesion"}};
  force.add = [this](const VecX& x, std::string_view part, VecX& sum) { sum += forces(x, tangential_term(part)); };
  force.between = [this](const VecX& x, std::string_view part, ObjectPair pair) { return force_between(x, tangential_term(part), pair); };
  force.stored = false;
  records.add(std::move(force));
  for (const auto& [name, term] : {std::pair{"friction", TangentialTerm::friction}, {"tangential_adhesion", TangentialTerm::adhesion}})
    records.add(EnergyRecord{name, EnergyKind::of_step, [this, term = term](const VecX& x) { return term_value(x, term); }});
  records.add(FlowRecord{"friction", {{"dissipated_friction"}, {"dissipated_adhesion"}}, [this](const VecX& x, double* amounts) {
    amounts[0] = dissipated(x, TangentialTerm::friction);
    amounts[1] = dissipated(x, TangentialTerm::adhesion);
  }, [this](const VecX& x, const EnergyVisitor& visit) { visit_dissipation(x, visit); }});
}

ContactPoints FrictionTerm::lagged_at(const VecX& x) const {
  ContactPoints points = contact_points({system_, wanted_, x});
  // Points of clipped adhesion carry no pressure.
  std::erase_if(points.of<6>(), [this](const ContactPoint<6>& c) {
    const TangentialLaw& law = system_.pairs().tangential(c.law);
    return c.normal_force == 0 && law.mu_a * law.peak_traction == 0;
  });
  if (grained_) scale_across_grain(system_, grains_, x, points);
  if (sticks_) anchors_.assign(system_.pairs(), start_, points);
  return points;
}

void FrictionTerm::take(ContactPoints points) {
  points_ = std::move(points);
  if (spins_.empty()) return;
  FrictionPoints split = split_by_spin(points_, spins_, start_);
  sliding_ = std::move(split.sliding);
  rolling_ = std::move(split.rolling);
}

void FrictionTerm::begin_step(const StepStart& start) {
  start_ = start.x;
  h_ = start.h;
}

double FrictionTerm::residual(const VecX& x, const ContactPoints& points) const {
  const VecX lagged_force = forces(x, TangentialTerm::all);
  const FrictionPoints split = spins_.empty() ? FrictionPoints{} : split_by_spin(points, spins_, start_);
  const VecX force = forces_of(spins_.empty() ? points : split.sliding, split.rolling, x, TangentialTerm::all, std::nullopt);
  double largest = 0, difference = 0;
  for (int v = 0; v < x.size() / 3; ++v) {
    largest = std::max({largest, vertex(lagged_force, v).norm(), vertex(force, v).norm()});
    difference = std::max(difference, (vertex(lagged_force, v) - vertex(force, v)).norm());
  }
  return largest > 0 ? difference / largest : 0;
}

FrictionTerm::PairForces FrictionTerm::normal_forces(const ContactPoints& points) const {
  PairForces sums;
  auto sum = sums.end();  // most points are of the objects of the point before
  for_each_record(points, [&](const auto& c) {
    if (system_.pairs().tangential(c.law).mu_static == 0) return;
    const Objects objects = c.objects();
    if (sum == sums.end() || sum->first != objects) sum = sums.try_emplace(objects, 0.0).first;
    sum->second += c.normal_force;
  });
  return sums;
}

void FrictionTerm::replace_points(const ContactPoints& now, const std::set<Objects>& between) {
  const auto is_chosen = [&](const auto& c) { return between.contains(c.objects()); };
  for_each_arity(points_, [&]<int K>(std::vector<ContactPoint<K>>& points) {
    std::erase_if(points, is_chosen);
    std::copy_if(now.of<K>().begin(), now.of<K>().end(), std::back_inserter(points), is_chosen);
  });
  take(std::move(points_));
}

void FrictionTerm::scale_normal_forces(const PairForces& factors) {
  for_each_record(points_, [&](auto& c) {
    if (const auto factor = factors.find(c.objects()); factor != factors.end()) c.normal_force *= factor->second;
  });
  take(std::move(points_));
}

double FrictionTerm::term_value(const VecX& x, TangentialTerm term) const {
  return sum_of(x, [&](const auto& slip, const TangentialLaw& law) { return slip.sample(law, h_, term).value; });
}

double FrictionTerm::dissipated(const VecX& x, TangentialTerm term) const {
  return sum_of(x, [&](const auto& slip, const TangentialLaw& law) { return slip.work(slip.sample(law, h_, term), law); });
}

void FrictionTerm::commit(const VecX& x, History& history) const {
  if (sticks_) StickAnchors::write(points_, system_.pairs(), system_.lagged_surface().topology(), system_.surface().mesh, start_, x, history);
}

// Without points that roll, whose contact points have batches of their own.
std::unique_ptr<Term> FrictionTerm::restricted(const StencilChoice& choice) const {
  if (!spins_.empty()) return nullptr;
  auto part = std::make_unique<FrictionTerm>(system_);
  part->h_ = h_;
  part->start_ = VecX::Zero(3 * choice.vertices.count());
  if (start_.size() > 0)
    for (int i = 0; i < choice.vertices.count(); ++i) vertex(part->start_, i) = vertex(start_, choice.vertices.global(i));
  size_t batch = 0;
  for_each_arity(points_, [&]<int K>(const std::vector<ContactPoint<K>>& points) {
    for (const int i : choice.stencils[batch]) {
      ContactPoint<K>& own = part->points_.of<K>().emplace_back(points[i]);
      own.vertices = choice.local(own.vertices);
    }
    ++batch;
  });
  return part;
}

std::vector<StencilBatch> FrictionTerm::batches() const {
  std::vector<StencilBatch> batches;
  for_each_arity(sliding(), [&]<int K>(const std::vector<ContactPoint<K>>& points) {
    auto& vertices = batch_vertices_[batches.size()];
    vertices.clear();
    for (const auto& c : points) vertices.insert(vertices.end(), c.vertices.begin(), c.vertices.end());
    batches.push_back({K, static_cast<int>(points.size()), vertices.data()});
  });
  for (const RollingGroup& group : rolling_) batches.push_back(group.batch());
  return batches;
}

void FrictionTerm::derivatives(const VecX& x, Projection projection, double* gradient,
                               double* hessian) const {
  for_each_arity(sliding(), [&]<int K>(const std::vector<ContactPoint<K>>& points) {
    constexpr int slots = 9 * hessian_blocks(K);
    const int count = static_cast<int>(points.size());
    for_each(count, [&](int n) {
      const Slip slip(points[n], x, start_);
      const auto& c = points[n].coefficients;
      const TangentialLaw& law = system_.pairs().tangential(points[n].law);
      const SlipSample s = slip.sample(law, h_, TangentialTerm::all);
      const Vec3 slope = slip.slope(s);
      for (int i = 0; i < K; ++i)
        Eigen::Map<Vec3>(gradient + 3 * (K * static_cast<size_t>(n) + i)) = c[i] * slope;
      if (!hessian) return;
      const Mat3 curvature = slip.curvature(s, projection);
      double* out = hessian + slots * static_cast<size_t>(n);
      for (int i = 0; i < K; ++i)
        for (int j = 0; j <= i; ++j, out += 9) Eigen::Map<Mat3>{out} = c[i] * c[j] * curvature;
    });
    gradient += 3 * K * static_cast<size_t>(count);
    if (hessian) hessian += slots * static_cast<size_t>(count);
  });
  for (const RollingGroup& group : rolling_) {
    const int arity = group.vector_count + group.scalar_count, count = static_cast<int>(group.points.size());
    for_each(count, [&](int n) {
      const RollingPoint& p = group.points[n];
      const Slip slip(p, x, start_);
      const SlipSample s = slip.sample(system_.pairs().tangential(p.law), h_, TangentialTerm::all);
      const Vec3 slope = slip.slope(s);
      for (int i = 0; i < arity; ++i) Eigen::Map<Vec3>(gradient + 3 * (arity * static_cast<size_t>(n) + i)) = p.slope_of(i, slope);
      if (hessian) p.fill_hessian(slip.curvature(s, projection), hessian + 9 * hessian_blocks(arity) * static_cast<size_t>(n));
    });
    gradient += 3 * arity * static_cast<size_t>(count);
    if (hessian) hessian += 9 * hessian_blocks(arity) * static_cast<size_t>(count);
  }
}

VecX FrictionTerm::forces_of(const ContactPoints& sliding, const std::vector<RollingGroup>& rolling, const VecX& x, TangentialTerm term,
                             std::optional<ObjectPair> only) const {
  VecX force = VecX::Zero(x.size());
  const auto slope_at = [&](const auto& point) {
    const Slip slip(point, x, start_);
    return slip.slope(slip.sample(system_.pairs().tangential(point.law), h_, term));
  };
  for_each_arity(sliding, [&]<int K>(const std::vector<ContactPoint<K>>& list) {
    for (const ContactPoint<K>& c : list) {
      if (only && !c.between(only->a, only->b)) continue;
      const Vec3 slope = slope_at(c);
      for (int i = 0; i < K; ++i) vertex(force, c.vertices[i]) -= c.coefficients[i] * slope;
    }
  });
  for (const RollingGroup& group : rolling)
    for (const RollingPoint& p : group.points) {
      if (only && !p.between(only->a, only->b)) continue;
      const Vec3 slope = slope_at(p);
      for (int i = 0; i < p.arity(); ++i) vertex(force, p.vertices[i]) -= p.slope_of(i, slope);
    }
  return force;
}

VecX FrictionTerm::forces(const VecX& x, TangentialTerm term,
                          std::optional<ObjectPair> only) const {
  return forces_of(sliding(), rolling_, x, term, only);
}

void FrictionTerm::visit_points(const VecX& x, std::string_view summand, const ForcePointVisitor& visit) const {
  const TangentialTerm term = tangential_term(summand);
  const auto show = [&](const auto& c, std::span<const int> vertices, std::span<const double> coefficients, const Vec3& normal, double gap) {
    ForcePoint point;
    point.object = c.object;
    point.opposite = c.opposite;
    point.vertices = vertices;
    point.coefficients = coefficients;
    point.own_vertex_count = c.own_vertex_count;
    point.normal = normal;
    point.gap = gap;
    point.area = c.area;
    point.normal_force = c.normal_force;
    const Slip slip(c, x, start_);
    point.force = -slip.slope(slip.sample(system_.pairs().tangential(c.law), h_, term));
    visit(point);
  };
  for_each_record(sliding(), [&](const auto& c) { show(c, c.vertices, c.coefficients, c.normal, c.gap); });
  for (const RollingGroup& group : rolling_)
    for (const RollingPoint& p : group.points) {
      const size_t count = static_cast<size_t>(p.vector_count);
      show(p, {p.vertices.data(), count}, {p.coefficients.data(), count}, p.normal, p.gap);
    }
}

Vec3 FrictionTerm::force_between(const VecX& x, TangentialTerm term, ObjectPair pair) const {
  VecX force = forces(x, term, pair);
  for (const RollingGroup& group : rolling_)  // moments
    for (const RollingPoint& p : group.points)
      for (int j = p.vector_count; j < p.arity(); ++j) vertex(force, p.vertices[j]).setZero();
  const auto& object = system_.surface().mesh.vertex_object;
  Vec3 sum = Vec3::Zero();
  for (size_t v = 0; v < object.size(); ++v)
    if (object[v] == pair.a) sum += vertex(force, static_cast<int>(v));
  return sum;
}

}  // namespace tack
