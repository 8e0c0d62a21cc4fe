#include "framework/contact/terms/contact_term.hpp"

#include <cmath>

#include "framework/contact/stencils/stencil_energy.hpp"
#include "framework/contact/stencils/stencil_projection.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Stencils first..last of one chunk, with gaps and law samples. Laws are called once per run of
// stencils with the same law.
template <class Kind>
struct ChunkSamples {
  std::array<double, chunk_size> gap;
  std::array<LawSample, chunk_size> sample;
  std::array<double, chunk_size> value;

  void gaps(const VecX& x, const StencilsOf<Kind>& stencils, int first, int last) {
    for (int i = first; i < last; ++i)
      gap[i - first] = std::sqrt(stencil_distance<ValueKernels>(Kind{}, x, stencils[i]));
  }
  template <class Call>
  static void runs(const StencilsOf<Kind>& stencils, int first, int last, const Call& call) {
    for (int i = first; i < last;) {
      int end = i + 1;
      while (end < last && stencils[end].law == stencils[i].law) ++end;
      call(stencils[i].law, i - first, end - i);
      i = end;
    }
  }
};

double mollifier_of(const VecX& x, const std::array<int, 4>& v, double eps_x) {
  return edge_edge_mollifier(vertex(x, v[0]), vertex(x, v[1]), vertex(x, v[2]), vertex(x, v[3]), eps_x);
}

template <class Kind>
double kind_value(const VecX& x, const std::vector<PairLaw>& laws,
                  const StencilsOf<Kind>& stencils, const double* thresholds) {
  return sum_chunks(static_cast<int>(stencils.size()), [&](int first, int last) {
    ChunkSamples<Kind> chunk;
    chunk.gaps(x, stencils, first, last);
    chunk.runs(stencils, first, last, [&](int law, int at, int n) {
      laws[law].values(n, chunk.gap.data() + at, chunk.value.data() + at);
    });
    double sum = 0;
    for (int i = first; i < last; ++i) {
      double energy = stencils[i].weight * chunk.value[i - first];
      if constexpr (std::is_same_v<Kind, EdgeEdgeKind>)
        energy *= mollifier_of(x, stencils[i].vertices, thresholds[i]);
      sum += energy;
    }
    return sum;
  });
}

// Calls body(first, last, samples) for every chunk of stencils of a kind, in parallel.
template <class Kind, class Body>
void for_each_sampled_chunk(const VecX& x, const std::vector<PairLaw>& laws, const StencilsOf<Kind>& stencils,
                            const Body& body) {
  for_each_chunk(static_cast<int>(stencils.size()), [&](int, int first, int last) {
    ChunkSamples<Kind> chunk;
    chunk.gaps(x, stencils, first, last);
    chunk.runs(stencils, first, last, [&](int law, int at, int n) {
      laws[law].samples(n, chunk.gap.data() + at, chunk.sample.data() + at);
    });
    body(first, last, chunk);
  });
}

// Calls body(stencil index, gap, sample) for every stencil of a kind, in parallel.
template <class Kind, class Body>
void for_each_sample(const VecX& x, const std::vector<PairLaw>& laws,
                     const StencilsOf<Kind>& stencils, const Body& body) {
  for_each_sampled_chunk<Kind>(x, laws, stencils, [&](int first, int last, const ChunkSamples<Kind>& chunk) {
    for (int i = first; i < last; ++i) body(i, chunk.gap[i - first], chunk.sample[i - first]);
  });
}

}  // namespace

ContactTerm::ContactTerm(const ContactSystem& system) : ContactTerm(system, system.contacts()) {}

ContactTerm::ContactTerm(const ContactSystem& system, const ContactSet& contacts)
    : Term("contact"), system_(system), contacts_(contacts), residuals_(system) {}

double ContactTerm::value(const VecX& x) const { return term_value(x, LawTerm::all); }

double ContactTerm::term_value(const VecX& x, LawTerm term) const {
  double sum = 0;
  for_each_kind(contacts_, [&](auto kind, const auto& stencils, const double* thresholds) {
    sum += kind_value<decltype(kind)>(x, laws(term), stencils, thresholds);
  });
  return sum;
}

std::vector<StencilBatch> ContactTerm::batches() const {
  std::vector<StencilBatch> batches;
  for_each_kind(contacts_, [&](auto kind, const auto& stencils, const double*) {
    auto& vertices = batch_vertices_[batches.size()];
    vertices.clear();
    for (const auto& s : stencils) vertices.insert(vertices.end(), s.vertices.begin(), s.vertices.end());
    batches.push_back({decltype(kind)::arity, static_cast<int>(stencils.size()), vertices.data()});
  });
  return batches;
}

void ContactTerm::derivatives(const VecX& x, Projection projection, double* gradient,
                              double* hessian) const {
  for_each_kind(contacts_, [&](auto kind, const auto& stencils, const double* thresholds) {
    using K = decltype(kind);
    using Energy = StencilEnergy<K>;
    constexpr int n = Energy::n, slots = 9 * hessian_blocks(K::arity);
    if (hessian && projection != Projection::none) {
      for_each_sampled_chunk<K>(x, laws(LawTerm::all), stencils, [&](int first, int last, const ChunkSamples<K>& chunk) {
        projected_derivatives<K>(x, stencils, first, last, thresholds, chunk.gap.data(), chunk.sample.data(), projection,
                                 gradient, hessian);
      });
    } else {
      for_each_sample<K>(x, laws(LawTerm::all), stencils, [&](int i, double gap, const LawSample& l) {
        const double eps_x = thresholds ? thresholds[i] : 0;
        Eigen::Map<typename Energy::Vector> g(gradient + n * static_cast<size_t>(i));
        if (!hessian) {
          g = Energy::gradient(x, stencils[i], l, gap, eps_x);
          return;
        }
        typename Energy::Vector full_g;
        typename Energy::Matrix full_h;
        Energy::derivatives(x, stencils[i], l, gap, eps_x, full_g, full_h);
        g = full_g;
        store_blocks<K::arity>(full_h, hessian + slots * static_cast<size_t>(i));
      });
    }
    const int count = static_cast<int>(stencils.size());
    gradient += n * static_cast<size_t>(count);
    if (hessian) hessian += slots * static_cast<size_t>(count);
  });
}

// Calls act(kind, stencil, gradient) for each stencil, in order.
template <class Act>
void ContactTerm::for_each_gradient(const VecX& x, LawTerm term, const Act& act) const {
  for_each_kind(contacts_, [&](auto kind, const auto& stencils, const double* thresholds) {
    using K = decltype(kind);
    std::vector<typename StencilEnergy<K>::Vector> gradients(stencils.size());
    for_each_sample<K>(x, laws(term), stencils, [&](int i, double gap, const LawSample& l) {
      gradients[i] = StencilEnergy<K>::gradient(x, stencils[i], l, gap, thresholds ? thresholds[i] : 0);
    });
    for (size_t i = 0; i < stencils.size(); ++i) act(kind, stencils[i], gradients[i]);
  });
}

VecX ContactTerm::forces(const VecX& x, LawTerm term, std::optional<ObjectPair> only) const {
  VecX force = VecX::Zero(x.size());
  const auto& object = system_.surface().mesh.vertex_object;
  for_each_gradient(x, term, [&](auto kind, const auto& stencil, const auto& gradient) {
    using K = decltype(kind);
    const auto& v = stencil.vertices;
    const int a = object[v[0]], b = object[v[K::first_vertices]];
    if (only && !((a == only->a && b == only->b) || (a == only->b && b == only->a))) return;
    for (int k = 0; k < K::arity; ++k) vertex(force, v[k]) -= gradient.template segment<3>(3 * k);
  });
  return force;
}

VecX ContactTerm::compressions(const VecX& x, LawTerm term) const {
  VecX sums = VecX::Zero(x.size());
  for_each_gradient(x, term, [&](auto kind, const auto& stencil, const auto& gradient) {
    using K = decltype(kind);
    const auto& v = stencil.vertices;
    // Distances are homogeneous of degree one, so that sum_i f_i . x_i is the distance times the
    // force: positive for repulsion.
    double virial = 0;
    Vec3 push = -gradient.template segment<3>(0);  // force on the first side, then the direction of repulsion
    for (int k = 1; k < K::arity; ++k) {
      virial -= gradient.template segment<3>(3 * k).dot(vertex(x, v[k]) - vertex(x, v[0]));
      if (k < K::first_vertices) push -= gradient.template segment<3>(3 * k);
    }
    if (const double size = push.norm(); size > 0) push *= std::copysign(1 / size, virial);
    for (int k = 0; k < K::arity; ++k)
      sums(3 * v[k]) -= (k < K::first_vertices ? 1 : -1) * gradient.template segment<3>(3 * k).dot(push);
  });
  return sums;
}

Vec3 ContactTerm::force_between(const VecX& x, LawTerm term, ObjectPair pair) const {
  const VecX force = forces(x, term, pair);
  const auto& object = system_.surface().mesh.vertex_object;
  Vec3 sum = Vec3::Zero();
  for (size_t v = 0; v < object.size(); ++v)
    if (object[v] == pair.a) sum += vertex(force, static_cast<int>(v));
  return sum;
}

void ContactTerm::visit_points(const VecX& x, std::string_view summand, const ForcePointVisitor& visit) const {
  const auto& object = system_.surface().mesh.vertex_object;
  for_each_gradient(x, law_term(summand), [&](auto kind, const auto& stencil, const auto& gradient) {
    using K = decltype(kind);
    const auto& v = stencil.vertices;
    const auto s = stencil_distance<GradientKernels>(kind, x, stencil);
    ForcePoint point;
    point.object = object[v[0]];
    point.opposite = object[v[K::first_vertices]];
    point.vertices = v;
    point.own_vertex_count = K::first_vertices;
    point.gap = std::sqrt(s.value);
    point.area = stencil.weight;
    if constexpr (std::is_same_v<K, EdgeEdgeKind>)
      point.area *= mollifier_of(x, v, contacts_.mollifier_threshold[&stencil - contacts_.edge_edge.data()]);
    for (int k = 0; k < K::first_vertices; ++k) {
      point.normal += s.gradient.template segment<3>(3 * k) / (2 * point.gap);
      point.force -= gradient.template segment<3>(3 * k);
    }
    // Closest points are stationary: the slope of the distance by a vertex is its coefficient times
    // the normal.
    std::array<double, K::arity> coefficients;
    for (int k = 0; k < K::arity; ++k) coefficients[k] = s.gradient.template segment<3>(3 * k).dot(point.normal) / (2 * point.gap);
    point.coefficients = coefficients;
    point.normal_force = point.force.dot(point.normal);
    visit(point);
  });
}

}  // namespace tack
