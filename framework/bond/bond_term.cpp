#include "framework/bond/bond_term.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "framework/bond/bond_fields.hpp"
#include "framework/bond/bond_sites.hpp"
#include "framework/bond/bond_traction.hpp"
#include "framework/contact/contact_potential.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Returns the Hessian by r, per area.
Mat3 curvature(const BondSample& s, const Bond& bond, const Opening& o, Projection projection) {
  const Vec3& n = bond.normal;
  const double slip = std::sqrt(o.s), across = projected(2 * s.by_s, projection);
  const Vec3 t = slip > 0 ? Vec3(o.u / slip) : n.unitOrthogonal();
  // Components along n and t.
  double nn = s.by_dd, nt = 2 * s.by_ds * slip, tt = 4 * s.by_ss * o.s + 2 * s.by_s;
  if (projection != Projection::none) {
    const double mean = (nn + tt) / 2, half = (nn - tt) / 2, radius = std::hypot(half, nt);
    const double high = projected(mean + radius, projection), low = projected(mean - radius, projection);
    // f(A) of a symmetric 2x2 matrix: the mean of f at both eigenvalues, and half their difference
    // along the deviator of A.
    const double spread = radius > 0 ? (high - low) / (2 * radius) : 0, middle = (high + low) / 2;
    nn = middle + spread * half, tt = middle - spread * half, nt *= spread;
  }
  return nn * n * n.transpose() + nt * (n * t.transpose() + t * n.transpose()) + (tt - across) * t * t.transpose() +
         across * (Mat3::Identity() - n * n.transpose());
}

// Returns the Hessian by r of a directed law, per area.
Mat3 curvature(const DirectedSample& s, const Mat3& frame, Projection projection) {
  if (projection == Projection::none) return frame * s.hessian * frame.transpose();
  const Eigen::SelfAdjointEigenSolver<Mat3> eigen(s.hessian);
  Vec3 values;
  for (int k = 0; k < 3; ++k) values[k] = projected(eigen.eigenvalues()[k], projection);
  const Mat3 axes = frame * eigen.eigenvectors();
  return axes * values.asDiagonal() * axes.transpose();
}

// Writes B_v^T H B_w with B_v = c_v I + (M g_v) n_S^T, and the work of the traction on levers that
// turn: l_S (t . n_S) times the second derivative of -(1 - q/2 - q^2/8) by the tilt, which is
// positive definite.
void write_blocks(const Bond& bond, const Opening& o, const Mat3& h, const Vec3& traction, Projection projection, double* out) {
  const std::array<Mat3, 2> turn = {turn_of(bond, o, 0), turn_of(bond, o, 1)};
  const std::array<Mat3, 2> bend = {h * turn[0], h * turn[1]};
  std::array<Mat3, 2> lever;
  for (int side = 0; side < 2; ++side) {
    const Vec3& tilt = o.tilts[side];
    const double size = projected(bond.lever[side] * traction.dot(bond.normals[side]), projection);
    lever[side] = size * tilt * tilt.transpose();
    lever[side].diagonal().array() += size * (1 + tilt.squaredNorm() / 2);
  }
  std::array<Vec3, Bond::most> bent;  // H M g_w
  for (int v = 0; v < bond.count(); ++v) {
    const int side = bond.side_of(v);
    const Vec3 &n = bond.normals[side], &g = bond.gradients[v];
    bent[v] = bend[side] * g;
    const Vec3 turned = turn[side] * g, levered = lever[side] * g;
    const Mat3 left = bond.c[v] * h + n * bent[v].transpose();
    for (int w = 0; w <= v; ++w, out += 9) {
      const int other = bond.side_of(w);
      double both = turned.dot(bent[w]);
      if (other == side) both += levered.dot(bond.gradients[w]);
      // Written by components: vectors that are assembled and read at once stall the processor.
      const double c = bond.c[w], d = bond.c[v];
      const double q[3] = {d * bent[w][0] + both * n[0], d * bent[w][1] + both * n[1], d * bent[w][2] + both * n[2]};
      for (int k = 0; k < 3; ++k) {
        const double m = bond.normals[other][k];
        for (int r = 0; r < 3; ++r) out[3 * k + r] = c * left.data()[3 * k + r] + q[r] * m;
      }
    }
  }
}

}  // namespace

BondTerm::BondTerm(ContactSystem& system, BondTable table)
    : Term("bonds"), system_(system), table_(std::move(table)), list_(system.surface(), system.pairs(), table_), stored_(list_),
      once_(std::any_of(table_.rules().begin(), table_.rules().end(), [](const BondRule& rule) { return rule.once; })),
      sees_sites_(std::any_of(table_.rules().begin(), table_.rules().end(), [](const BondRule& rule) { return rule.law->sees_site(); })),
      directs_(std::any_of(table_.rules().begin(), table_.rules().end(), [](const BondRule& rule) { return rule.law->directed(); })) {}

void BondTerm::set_environment(const Environment* environment, std::vector<std::string> object_names) {
  environment_ = environment;
  object_names_ = std::move(object_names);
}

void BondTerm::publish(Records& records) const {
  Term::publish(records);
  ForceRecord force{"bonds", ForceDirection::normal, {"barrier", "adhesion"}};
  force.add = [this](const VecX& x, std::string_view summand, VecX& sum) { sum += forces(x, law_term(summand)); };
  force.between = [this](const VecX& x, std::string_view summand, ObjectPair pair) { return force_between(x, law_term(summand), pair); };
  force.add_compressions = [this](const VecX& x, std::string_view summand, VecX& sum) { sum += compressions(x, law_term(summand)); };
  records.add(std::move(force));
  std::vector<FlowColumn> columns{{"dissipated_adhesion"}, {"work_healing", FlowKind::fed}};
  if (sees_sites_) columns.push_back({"work_environment", FlowKind::fed});
  records.add(FlowRecord{"bonds", std::move(columns), [this](const VecX& x, double* amounts) {
    const Changes step = changes(x);
    amounts[0] = step.dissipated;
    amounts[1] = -step.healed;
    if (sees_sites_) amounts[2] = step.environment;
  }, [this](const VecX& x, const EnergyVisitor& visit) { visit_changes(x, visit); }});
  records.add(FieldRecord{"bond_intensity", [this](const VecX& x) { return bond_intensities(*this, x.size() / 3); }});
  records.add(FieldRecord{"bond_traction", [this](const VecX& x) { return bond_tractions(*this, x); }});
}

void BondTerm::load_history(const History& history) {
  h_ = 0;
  pressures_.clear();
  begun_ = stored_.read(history);
  if (once_) read_bonded_once(history);
  system_.potential().keep_sides(stored_.pairs());
  list_ = stored_;
  framed_ = false;
  end_time_ = state_time_;
  sites_.clear();
  environment_work_.clear();
  make_blocks();
}

void BondTerm::begin_step(const StepStart& start) {
  h_ = start.h;
  begins_ = true;
  pressures_.clear();
  start_time_ = state_time_ = start.time;
  end_time_ = start.time + start.h;
}

// A site that bonds does not bond again, even if the overlap has changed since: a triangle with
// bonds makes no others, except at its remaining Gauss points.
void BondTerm::make_bonds(const VecX& x) {
  unbonded_.clear();
  const bool any_on_contact = std::any_of(table_.rules().begin(), table_.rules().end(), [](const BondRule& r) { return r.on_contact; });
  if (begun_ && !any_on_contact) return;
  std::map<std::array<int, 3>, std::vector<const Bond*>> bonded;  // by triangle, or else vertex, and other object
  for (const Bond& b : stored_.bonds()) bonded[key_of(b.triangle, b.vertices[0], b.b)].push_back(&b);
  const auto before = stored_.pairs();
  std::vector<BondSite> sites = bond_sites(system_, table_, x);
  const std::vector<int>& object = system_.surface().mesh.vertex_object;
  const auto may_bond = [&](int rule, int a, int b) {
    const std::pair<int, int> pair = std::minmax(a, b);
    return table_.rules()[rule].on_contact || (!begun_ && !std::binary_search(before.begin(), before.end(), pair));
  };
  std::erase_if(sites, [&](const BondSite& site) {
    const int a = object[site.vertex];
    // The rule among regions depends on the opposite triangle, which is not known yet.
    if (!system_.pairs().has_regions(a, site.object) && !may_bond(table_.between(a, site.object, -1), a, site.object)) return true;
    const auto here = bonded.find(key_of(site.triangle, site.vertex, site.object));
    if (here == bonded.end()) return false;
    return !site.whole || std::any_of(here->second.begin(), here->second.end(), [&](const Bond* b) {
      double least = 1;
      for (int i = 0; i < 3; ++i) least = std::min(least, std::abs(b->c[i] - 2.0 / 3));
      const bool at_point = least < 1e-9;  // of Gauss' rule
      return !at_point || (Vec3(b->c[0], b->c[1], b->c[2]) - site.inside).norm() < 1e-9;
    });
  });
  std::vector<std::optional<Bond>> made(sites.size());
  for_each(static_cast<int>(sites.size()), [&](int i) { made[i] = make_bond(sites[i], system_, table_, x); });
  std::vector<double> variables;
  for (const auto& bond : made) {
    if (!bond || !may_bond(bond->rule, bond->a, bond->b) || !may_form(*bond, x)) continue;
    const BondRule& rule = table_.rules()[bond->rule];
    variables.assign(rule.law->width(), 0.0);
    rule.law->initialize(begun_, variables.data());
    list_.add(*bond, variables.data());
  }
  list_.sort();
  if (begun_) return;
  std::vector<char> bonds(table_.rules().size(), 0);
  for (const Bond& b : list_.bonds()) bonds[b.rule] = 1;
  for (size_t i = 0; i < bonds.size(); ++i)
    if (!bonds[i] && !table_.rules()[i].on_contact) unbonded_.push_back(static_cast<int>(i));
}

// Returns whether a new bond may form at x: pressed enough, and not again if its rule lets a site bond once.
bool BondTerm::may_form(const Bond& bond, const VecX& x) const {
  const BondRule& rule = table_.rules()[bond.rule];
  if (rule.once && bonded_once_.contains(key_of(bond.triangle, bond.vertices[0], bond.b))) return false;
  if (rule.pressure == 0) return true;
  Bond framed = bond;
  lag_frame(framed, x);
  return -rule.barrier.at(opening_of(framed, x).d + bond.rest).slope >= rule.pressure;
}

void BondTerm::make_blocks() {
  blocks_.clear();
  const std::vector<Bond>& bonds = list_.bonds();
  for (int i = 0; i < list_.size(); ++i) {
    const bool fits = !blocks_.empty() && blocks_.back().last - blocks_.back().first < most_in_block &&
                      bonds[i].rule == bonds[blocks_.back().first].rule && bonds[i].site_count == bonds[blocks_.back().first].site_count;
    if (!fits) blocks_.push_back({i, i});
    blocks_.back().last = i + 1;
  }
  for (auto& vertices : batch_vertices_) vertices.clear();
  for (const Bond& b : bonds) {
    auto& vertices = batch_vertices_[b.site_count == 1 ? 0 : 1];
    vertices.insert(vertices.end(), b.vertices.begin(), b.vertices.begin() + b.count());
  }
}

void BondTerm::lag(const VecX& x) {
  if (begins_) {
    begins_ = false;
    list_ = stored_;
    make_bonds(x);
    make_blocks();
    lag_frames(x);
    find_sites(x);
    find_environment_work(x);
    return;
  }
  lag_frames(x);
  for (int i = 0; directs_ && i < list_.size(); ++i)
    if (law_of(i).directed()) set_tangents(list_.bonds()[i], x, sites_[i]);
}

void BondTerm::lag_frames(const VecX& x) const {
  framed_ = true;
  for_each(list_.size(), [&](int i) { lag_frame(list_.bonds()[i], x); });
}

// Between steps, callers evaluate at the state; the frames are taken there when first needed.
void BondTerm::ensure_frames(const VecX& x) const {
  if (framed_) return;
  lag_frames(x);
  find_sites(x);
}

SiteState BondTerm::site_at(const Bond& bond, double time, const VecX& x) const {
  const VecX& rest = system_.surface().rest;
  SiteState site{.time = time, .objects = {bond.a, bond.b}};
  for (int side = 0; side < 2; ++side)
    if (site.objects[side] < static_cast<int>(object_names_.size())) site.names[side] = object_names_[site.objects[side]];
  for (int i = 0; i < bond.site_count; ++i) {
    site.rest_position += bond.c[i] * vertex(rest, bond.vertices[i]);
    site.position += bond.c[i] * vertex(x, bond.vertices[i]);
  }
  if (environment_) site.temperature = environment_->temperature(time, site.rest_position);
  set_tangents(bond, x, site);
  const Vec3 slip = opening_of(bond, x).u;
  site.slip = {site.tangents[0].dot(slip), site.tangents[1].dot(slip)};
  return site;
}

// Sets normal and tangents to those of the bond's frame, which is that of x.
void BondTerm::set_tangents(const Bond& bond, const VecX& x, SiteState& site) const {
  const Vec3 edge = vertex(x, bond.vertices[bond.site_count + 1]) - vertex(x, bond.vertices[bond.site_count]);
  site.normal = bond.normal;
  site.tangents[0] = (edge - bond.normal.dot(edge) * bond.normal).normalized();
  site.tangents[1] = bond.normal.cross(site.tangents[0]);
}

Vec3 BondTerm::jump_of(int bond, const Opening& o) const { return {o.d, sites_[bond].tangents[0].dot(o.u), sites_[bond].tangents[1].dot(o.u)}; }

DirectedSample BondTerm::directed_sample(int bond, const Opening& o) const {
  DirectedSample sample;
  const Vec3 jump = jump_of(bond, o);
  law_of(bond).add_directed_samples(1, &jump, list_.variables(bond), step_of(bond), &sample);
  return sample;
}

// Sets the sites at the end of the step that begins at x, or at the state x between steps. Frames are those of x.
void BondTerm::find_sites(const VecX& x) const {
  if (!sees_sites_) return;
  sites_.assign(list_.size(), {});
  for (int i = 0; i < list_.size(); ++i)
    if (law_of(i).sees_site()) sites_[i] = site_at(list_.bonds()[i], end_time_, x);
}

std::vector<Opening> BondTerm::openings(const VecX& x) const {
  ensure_frames(x);
  std::vector<Opening> openings;
  for (const Bond& b : list_.bonds()) openings.push_back(opening_of(b, x));
  return openings;
}

double BondTerm::value(const VecX& x) const {
  ensure_frames(x);
  return sum_chunks(static_cast<int>(blocks_.size()), [&](int begin, int end) {
    double sum = 0;
    for (int k = begin; k < end; ++k) {
      const auto [first, last] = blocks_[k];
      if (directed(blocks_[k])) {
        for (int i = first; i < last; ++i) {
          const Vec3 jump = jump_of(i, opening_of(list_.bonds()[i], x));
          double phi = 0;
          law_of(i).add_directed_values(1, &jump, list_.variables(i), step_of(i), &phi);
          sum += list_.bonds()[i].area * phi;
        }
        continue;
      }
      std::array<double, most_in_block> d, s, phi{};
      for (int i = first; i < last; ++i) {
        const Opening o = opening_of(list_.bonds()[i], x);
        d[i - first] = o.d;
        s[i - first] = o.s;
      }
      table_.rules()[list_.bonds()[first].rule].law->add_values(last - first, d.data(), s.data(), list_.variables(first), step_of(first), phi.data());
      for (int i = first; i < last; ++i) sum += list_.bonds()[i].area * phi[i - first];
    }
    return sum;
  });
}

std::vector<StencilBatch> BondTerm::batches() const {
  return {{4, static_cast<int>(batch_vertices_[0].size()) / 4, batch_vertices_[0].data()},
          {6, static_cast<int>(batch_vertices_[1].size()) / 6, batch_vertices_[1].data()}};
}

void BondTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  ensure_frames(x);
  const size_t fours = batch_vertices_[0].size() / 4;
  const auto slot = [&](size_t i, size_t of_four, size_t of_six) { return i < fours ? of_four * i : of_four * fours + of_six * (i - fours); };
  for_each(static_cast<int>(blocks_.size()), [&](int k) {
    const auto [first, last] = blocks_[k];
    const auto write = [&](int i, const Opening& o, const Vec3& slope, const auto& hessian_by_r) {
      const Bond& bond = list_.bonds()[i];
      double* g = gradient + slot(i, 3 * 4, 3 * 6);
      for_each_vertex(bond, o, slope, [&](int v, const Vec3& of_vertex) { Eigen::Map<Vec3>{g + 3 * v} = of_vertex; });
      if (!hessian) return;
      write_blocks(bond, o, bond.area * hessian_by_r(), slope, projection, hessian + slot(i, 9 * hessian_blocks(4), 9 * hessian_blocks(6)));
    };
    if (directed(blocks_[k])) {
      for (int i = first; i < last; ++i) {
        const Opening o = opening_of(list_.bonds()[i], x);
        const DirectedSample sample = directed_sample(i, o);
        const Mat3 frame = frame_of(list_.bonds()[i], sites_[i]);
        write(i, o, list_.bonds()[i].area * traction(sample, frame), [&] { return curvature(sample, frame, projection); });
      }
      return;
    }
    std::array<double, most_in_block> d, s;
    std::array<Opening, most_in_block> openings;
    std::array<BondSample, most_in_block> samples{};
    for (int i = first; i < last; ++i) {
      openings[i - first] = opening_of(list_.bonds()[i], x);
      d[i - first] = openings[i - first].d;
      s[i - first] = openings[i - first].s;
    }
    table_.rules()[list_.bonds()[first].rule].law->add_samples(last - first, d.data(), s.data(), list_.variables(first), step_of(first), samples.data());
    for (int i = first; i < last; ++i) {
      const Bond& bond = list_.bonds()[i];
      const Opening& o = openings[i - first];
      const BondSample& sample = samples[i - first];
      write(i, o, bond.area * traction(sample, bond, o), [&] { return curvature(sample, bond, o, projection); });
    }
  });
}

bool BondTerm::visit_energies(const VecX& x, const EnergyVisitor& visit) const {
  ensure_frames(x);
  for (int i = 0; i < list_.size(); ++i) {
    const Bond& bond = list_.bonds()[i];
    const Opening o = opening_of(bond, x);
    double energy = 0;
    if (law_of(i).directed()) energy = directed_sample(i, o).value;
    else law_of(i).add_values(1, &o.d, &o.s, list_.variables(i), step_of(i), &energy);
    visit(std::span(bond.vertices).first(bond.count()), bond.area * energy);
  }
  return true;
}

std::vector<double> BondTerm::abrupt_times() const {
  std::vector<double> times;
  for (const BondRule& rule : table_.rules())
    for (const double t : rule.law->abrupt_times()) times.push_back(t);
  return times;
}

}  // namespace tack
