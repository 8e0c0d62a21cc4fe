#include "energies/shell/dihedral_term.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"
#include "geometry/parallel.hpp"

namespace tack {

DihedralTerm::DihedralTerm(std::string name, const Body& body, const VecX& rest, double stiffness, double poisson, bool rest_angles,
                           std::optional<PlasticBending> plastic)
    : Term(std::move(name)), history_name_(fmt::format("{}/energies/{}/turns", body.name, body.energy)) {
  const std::vector<SheetTriangle> sheet = connect_sheet(body.sheet, fmt::format("object '{}': ", body.name));
  const FittedFans fitted = fit_dihedral_stiffness(sheet, rest, stiffness, poisson);
  const std::vector<DihedralFan>& fans = fitted.fans;
  if (fans.empty())
    throw InputError(fmt::format("object '{}': no two triangles of its sheet share an edge, so nothing can bend; weld its vertices, "
                                 "or take the bending energy away", body.name));
  size_t edge_count = 0;
  for (size_t first = 0, last = 0; first < fans.size(); first = last) {
    while (last < fans.size() && fans[last].shape == fans[first].shape) ++last;
    fans_.emplace_back(&fans[first], &fitted.c[first], static_cast<int>(last - first));
    if (rest_angles) fans_.back().set_rest(rest);
    edge_count += static_cast<size_t>(fans_.back().edge_count());
  }
  turns_.assign(edge_count, 0.0);
  if (plastic) set_yield({body, sheet, fans, rest, stiffness, *plastic});
}

void DihedralTerm::load_history(const History& history) {
  if (const auto* values = history_values(history, history_name_, 1, static_cast<int>(turns_.size()))) turns_ = *values;
  else std::fill(turns_.begin(), turns_.end(), 0.0);
  load_flow(history);
}

void DihedralTerm::begin_step(const StepStart& start) {
  const double* turns = turns_.data();
  for (FanStencils& fans : fans_) {
    fans.begin_step(start.x, turns);
    turns += fans.edge_count();
  }
}

// A sheet stores no turns before one of its angles has passed pi.
void DihedralTerm::commit(const VecX& x, History& history) const {
  std::vector<double> all(turns_.size());
  double* turns = all.data();
  for (const FanStencils& fans : fans_) {
    fans.turns(x, turns);
    turns += fans.edge_count();
  }
  if (std::all_of(all.begin(), all.end(), [](double t) { return t == 0; })) history.erase(history_name_);
  else history[history_name_] = {1, std::move(all), {}};
  commit_flow(x, history);
}

double DihedralTerm::value(const VecX& x) const {
  double sum = 0;
  for (const FanStencils& fans : fans_) sum += fans.value(x);
  return sum;
}

std::vector<StencilBatch> DihedralTerm::batches() const {
  std::vector<StencilBatch> all;
  for (const FanStencils& fans : fans_) all.push_back(fans.batch());
  return all;
}

std::vector<const StencilRanges*> DihedralTerm::ranges() const {
  std::vector<const StencilRanges*> all;
  for (const FanStencils& fans : fans_) all.push_back(&fans);
  return all;
}

VecX DihedralTerm::spring_strains(const VecX& x) const {
  VecX all(static_cast<Eigen::Index>(turns_.size()));
  double* angles = all.data();
  for (const FanStencils& fans : fans_) {
    fans.angles(x, angles);
    angles += fans.edge_count();
  }
  return all;
}

VecX DihedralTerm::rest_strains() const {
  VecX all(static_cast<Eigen::Index>(turns_.size()));
  double* angles = all.data();
  for (const FanStencils& fans : fans_) {
    fans.rest_angles(angles);
    angles += fans.edge_count();
  }
  return all;
}

void DihedralTerm::set_rest_strains(const VecX& rest) {
  const double* angles = rest.data();
  for (FanStencils& fans : fans_) {
    fans.set_rest_angles(angles);
    angles += fans.edge_count();
  }
}

double DihedralTerm::energy_of(const VecX& strains) const {
  double sum = 0;
  const double* angles = strains.data();
  for (const FanStencils& fans : fans_) {
    sum += fans.energy_of(angles);
    angles += fans.edge_count();
  }
  return sum;
}

void DihedralTerm::derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const {
  for (const FanStencils& fans : fans_) {
    const StencilBatch batch = fans.batch();
    const size_t width = 3 * static_cast<size_t>(batch.arity), slots = 9 * static_cast<size_t>(hessian_blocks(batch.arity));
    for_each_chunk(batch.count, [&](int, int first, int last) {
      fans.range_derivatives(x, projection, first, last, gradient + width * static_cast<size_t>(first),
                             hessian ? hessian + slots * static_cast<size_t>(first) : nullptr);
    });
    gradient += width * static_cast<size_t>(batch.count);
    if (hessian) hessian += slots * static_cast<size_t>(batch.count);
  }
}

}  // namespace tack
