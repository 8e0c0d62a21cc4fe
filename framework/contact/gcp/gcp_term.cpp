#include "framework/contact/gcp/gcp_term.hpp"

#include <algorithm>

#include "framework/assembly/stencil_clamp.hpp"
#include "framework/contact/gcp/gcp_energy.hpp"
#include "framework/contact/gcp/gcp_points.hpp"
#include "geometry/errors.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int chunk = 64;

// Writes the lower triangle of blocks.
void store(const GcpHessian& h, int arity, double* out) {
  for (int i = 0; i < arity; ++i)
    for (int j = 0; j <= i; ++j, out += 9) Eigen::Map<Mat3>{out} = h.block<3, 3>(3 * i, 3 * j);
}

bool is_of_barrier(std::string_view summand) { return summand.empty() || summand == "barrier"; }

}  // namespace

GcpContacts::GcpContacts(const ContactSurface& surface, const PairTable& pairs, const GcpSmoothing& smoothing)
    : surface_(surface), pairs_(pairs), smoothing_(smoothing), rings_(surface) {
  if (rings_.valence_max() > gcp_valence_max)
    throw InputError("a surface vertex has " + std::to_string(rings_.valence_max()) + " neighbours, and the geometric contact potential takes at most " +
                     std::to_string(gcp_valence_max) + "; mesh the surface anew");
  rest_ = gcp_rest_ranges(surface, rings_, pairs, smoothing);
}

void GcpContacts::find(const Candidates& candidates, const VecX& x) {
  stencils_ = find_gcp_stencils({surface_, rings_, pairs_, smoothing_, rest_, free_}, candidates, x);
}

GcpTerm::GcpTerm(const GcpContacts& contacts) : Term("contact"), contacts_(contacts) {}

// Calls body(index, positions, sample of the shortened law) for each stencil, in parallel. Laws are
// called once per run of stencils of one law.
template <class Body>
void GcpTerm::for_each_sample(const VecX& x, const Body& body) const {
  const GcpStencils& all = contacts_.stencils();
  const std::vector<PairLaw>& laws = contacts_.pairs().laws();
  for_each_chunk(
      static_cast<int>(all.stencils.size()),
      [&](int, int first, int last) {
        std::array<double, chunk> distance;
        std::array<LawSample, chunk> sample;
        GcpPositions c;
        for (int i = first; i < last; ++i) {
          const GcpStencil& s = all.stencils[i];
          gcp_positions(x, all.vertices_of(s).first(gcp_core_count(s.kind)), c);
          distance[i - first] = laws[s.law].offset() + s.shortening * (gcp_distance(s.kind, c) - s.offset);
        }
        for (int i = first; i < last;) {
          int end = i + 1;
          while (end < last && all.stencils[end].law == all.stencils[i].law) ++end;
          laws[all.stencils[i].law].samples(end - i, distance.data() + i - first, sample.data() + i - first);
          i = end;
        }
        for (int i = first; i < last; ++i) {
          const GcpStencil& s = all.stencils[i];
          LawSample& l = sample[i - first];
          l.value /= s.shortening;
          l.curvature *= s.shortening;
          gcp_positions(x, all.vertices_of(s), c);
          body(i, c, l);
        }
      },
      chunk);
}

double GcpTerm::value(const VecX& x) const {
  const GcpStencils& all = contacts_.stencils();
  std::vector<double> energies(all.stencils.size());
  for_each_sample(x, [&](int i, const GcpPositions& c, const LawSample& l) {
    const GcpStencil& s = all.stencils[i];
    energies[i] = s.weight * l.value * gcp_direction(s, all.factors_of(s), contacts_.smoothing(), c);
  });
  return sum_chunks(static_cast<int>(energies.size()), [&](int first, int last) {
    double sum = 0;
    for (int i = first; i < last; ++i) sum += energies[i];
    return sum;
  });
}

std::vector<StencilBatch> GcpTerm::batches() const {
  const GcpStencils& all = contacts_.stencils();
  std::vector<StencilBatch> batches;
  for (const GcpStencil& s : all.stencils) {
    if (batches.empty() || batches.back().arity != s.arity) batches.push_back({s.arity, 0, all.vertices.data() + s.vertex_begin});
    ++batches.back().count;
  }
  return batches;
}

void GcpTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  const GcpStencils& all = contacts_.stencils();
  // Hessian slots before each arity.
  std::array<size_t, gcp_arity_max + 2> slot{};
  std::array<int, gcp_arity_max + 2> first{};
  for (const StencilBatch& b : batches()) {
    for (int a = b.arity + 1; a <= gcp_arity_max + 1; ++a) slot[a] += 9 * static_cast<size_t>(hessian_blocks(b.arity)) * b.count, first[a] += b.count;
  }
  for_each_sample(x, [&](int i, const GcpPositions& c, const LawSample& l) {
    const GcpStencil& s = all.stencils[i];
    GcpGradient g;
    GcpHessian h;
    gcp_derivatives(s, all.factors_of(s), contacts_.smoothing(), c, l, g, hessian ? &h : nullptr);
    Eigen::Map<VecX>(gradient + 3 * static_cast<size_t>(s.vertex_begin), 3 * s.arity) = g;
    if (!hessian) return;
    double* const out = hessian + slot[s.arity] + 9 * static_cast<size_t>(hessian_blocks(s.arity)) * (i - first[s.arity]);
    store(h, s.arity, out);
    project_slots({s.arity, 1, nullptr}, out, projection);
  });
}

bool GcpTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  const GcpStencils& all = contacts_.stencils();
  std::vector<double> energies(all.stencils.size());
  for_each_sample(x, [&](int i, const GcpPositions& c, const LawSample& l) {
    const GcpStencil& s = all.stencils[i];
    energies[i] = s.weight * l.value * gcp_direction(s, all.factors_of(s), contacts_.smoothing(), c);
  });
  for (size_t i = 0; i < energies.size(); ++i) visit(all.vertices_of(all.stencils[i]), energies[i]);
  return true;
}

VecX GcpTerm::forces(const VecX& x, std::optional<ObjectPair> only) const {
  const GcpStencils& all = contacts_.stencils();
  const std::vector<int>& object = contacts_.surface().mesh.vertex_object;
  std::vector<double> gradient(3 * all.vertices.size());
  derivatives(x, Projection::none, gradient.data(), nullptr);
  VecX force = VecX::Zero(x.size());
  for (const GcpStencil& s : all.stencils) {
    const auto v = all.vertices_of(s);
    const int a = object[v[0]], b = object[v[gcp_first_count(s.kind)]];
    if (only && !((a == only->a && b == only->b) || (a == only->b && b == only->a))) continue;
    for (int k = 0; k < s.arity; ++k) vertex(force, v[k]) -= Eigen::Map<const Vec3>(gradient.data() + 3 * (s.vertex_begin + k));
  }
  return force;
}

Vec3 GcpTerm::force_between(const VecX& x, ObjectPair pair) const {
  const VecX force = forces(x, pair);
  const std::vector<int>& object = contacts_.surface().mesh.vertex_object;
  Vec3 sum = Vec3::Zero();
  for (size_t v = 0; v < object.size(); ++v)
    if (object[v] == pair.a) sum += vertex(force, static_cast<int>(v));
  return sum;
}

std::vector<double> GcpTerm::normal_forces(const VecX& x) const {
  const GcpStencils& all = contacts_.stencils();
  std::vector<double> forces(all.stencils.size());
  for_each_sample(x, [&](int i, const GcpPositions& c, const LawSample& l) {
    const GcpStencil& s = all.stencils[i];
    forces[i] = -s.weight * l.slope * gcp_direction(s, all.factors_of(s), contacts_.smoothing(), c);
  });
  return forces;
}

void GcpTerm::visit_points(const VecX& x, std::string_view summand, const ForcePointVisitor& visit) const {
  if (!is_of_barrier(summand)) return;
  const GcpStencils& all = contacts_.stencils();
  const std::vector<int>& object = contacts_.surface().mesh.vertex_object;
  std::vector<double> gradient(3 * all.vertices.size());
  derivatives(x, Projection::none, gradient.data(), nullptr);
  const std::vector<double> normal = normal_forces(x);
  GcpPositions c;
  for (size_t i = 0; i < all.stencils.size(); ++i) {
    const GcpStencil& s = all.stencils[i];
    const std::span<const int> v = all.vertices_of(s);
    gcp_positions(x, v, c);
    const std::array<double, 4> coefficients = gcp_coefficients(s.kind, c);
    const size_t core = static_cast<size_t>(gcp_core_count(s.kind));
    ForcePoint point;
    point.own_vertex_count = gcp_first_count(s.kind);
    point.object = object[v[0]];
    point.opposite = object[v[point.own_vertex_count]];
    point.vertices = v.first(core);
    point.coefficients = {coefficients.data(), core};
    const Vec3 separation = point.point(x) - point.opposite_point(x);
    point.gap = separation.norm();
    point.normal = separation / point.gap;
    point.area = s.weight * gcp_direction(s, all.factors_of(s), contacts_.smoothing(), c);
    if (point.object == point.opposite) point.force = normal[i] * point.normal;
    else
      for (int k = 0; k < s.arity; ++k)
        if (object[v[k]] == point.object) point.force -= Eigen::Map<const Vec3>(gradient.data() + 3 * (s.vertex_begin + k));
    point.normal_force = point.force.dot(point.normal);
    visit(point);
  }
}

void GcpTerm::publish(Records& records) const {
  const auto for_each_point = [this](const VecX& x, const auto& body) {
    for_each_record(gcp_points(contacts_, *this, std::vector<char>(contacts_.pairs().laws().size(), 1), x), body);
  };
  ForceRecord force{"contact", ForceDirection::normal, {"barrier", "adhesion"}};
  force.add = [this](const VecX& x, std::string_view summand, VecX& sum) {
    if (is_of_barrier(summand)) sum += forces(x);
  };
  force.between = [this](const VecX& x, std::string_view summand, ObjectPair pair) {
    return is_of_barrier(summand) ? force_between(x, pair) : Vec3(Vec3::Zero());
  };
  force.add_compressions = [=](const VecX& x, std::string_view summand, VecX& pressed) {
    if (!is_of_barrier(summand)) return;
    for_each_point(x, [&](const auto& c) {
      for (size_t i = 0; i < c.vertices.size(); ++i) pressed(3 * c.vertices[i]) += c.normal_force * std::abs(c.coefficients[i]);
    });
  };
  force.add_areas = [=](const VecX& x, VecX& areas) {
    for_each_point(x, [&](const auto& c) {
      for (size_t i = 0; i < c.vertices.size(); ++i) areas(3 * c.vertices[i]) += c.area * std::abs(c.coefficients[i]);
    });
  };
  records.add(std::move(force));
  records.add(EnergyRecord{"barrier", EnergyKind::between_objects, [this](const VecX& x) { return value(x); }});
}

}  // namespace tack
