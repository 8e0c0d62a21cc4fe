#include "framework/stepping/local_potential.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/assembly/listed_stencils.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/terms/contact_term.hpp"

namespace tack {
namespace {

// Returns the values of a vector over all vertices (3n) at the local ones.
VecX gathered(const VecX& full, const LocalVertices& vertices) {
  VecX own(3 * vertices.count());
  for (int i = 0; i < vertices.count(); ++i) vertex(own, i) = vertex(full, vertices.global(i));
  return own;
}

template <std::size_t K>
void renumber(std::array<int, K>& stencil, const LocalVertices& vertices) {
  for (int& v : stencil) v = vertices.find(v);
}

template <class Stencils>
void renumber_all(Stencils& stencils, const LocalVertices& vertices) {
  for (auto& s : stencils) renumber(s.vertices, vertices);
}

// Returns the number of a vertex among the dependent ones; -1: it depends on none.
int dependent_number(const DofMap& dofs, int v) {
  const std::vector<int>& all = dofs.dependents();
  const auto found = std::lower_bound(all.begin(), all.end(), v);
  return found == all.end() || *found != v ? -1 : static_cast<int>(found - all.begin());
}

}  // namespace

std::unique_ptr<Objective> StepPotential::restricted(std::span<const int> blocks) {
  return std::make_unique<LocalPotential>(*this, world_, clock_, blocks);
}

LocalPotential::LocalPotential(StepPotential& whole, World& world, PhaseClock& clock, std::span<const int> blocks, bool resumed)
    : whole_(whole), world_(world), clock_(clock), scratch_(whole.scratch()), blocks_(blocks.begin(), blocks.end()), resumed_(resumed) {
  if (scratch_.taken) throw std::logic_error("a potential has one local problem at a time");
  scratch_.taken = !resumed_;
  moved_ = whole_.stencil_maps().moved_by(blocks_);
  for (const int b : blocks_) owners_.push_back(whole_.dofs().vertex_of_block(b));
  read_start();
  positions_at_start_.resize(3 * static_cast<Eigen::Index>(moved_.size()));
  for (size_t i = 0; i < moved_.size(); ++i) vertex(positions_at_start_, static_cast<int>(i)) = vertex(scratch_.x, moved_[i]);
  local_ = has_local_form();
  build();
  inner_->move_to(start_);
}

LocalPotential::~LocalPotential() {
  if (resumed_) {
    scratch_.moves = -1;  // no longer at the point of the whole potential
    return;
  }
  for (size_t i = 0; i < moved_.size(); ++i) vertex(scratch_.x, moved_[i]) = vertex(positions_at_start_, static_cast<int>(i));
  scratch_.taken = false;
}

void LocalPotential::read_start() {
  start_.resize(size());
  for (size_t b = 0; b < owners_.size(); ++b) start_.segment<3>(3 * static_cast<Eigen::Index>(b)) = vertex(scratch_.x, owners_[b]);
}

const VecX& LocalPotential::resume() {
  whole_.scratch();  // at the point of the whole potential, if that has moved
  read_start();
  if (local_ && world_.contact && world_.contact->candidates_version() != candidates_version_) build();
  else begin_inner();
  inner_->move_to(start_);
  return start_;
}

// Returns whether all dynamic stencils are those of contact that has a local search, or lagged.
// Other dynamic terms, also of a contact model, may find theirs in move_to().
bool LocalPotential::has_local_form() const {
  if (world_.contact && !world_.contact->potential().local({})) return false;
  const auto known = [](const Term* term) { return !term->dynamic() || term->lagged_stencils() || dynamic_cast<const ContactTerm*>(term); };
  return std::all_of(whole_.terms().begin(), whole_.terms().end(), known);
}

void LocalPotential::build() {
  if (inner_) value_count_before_ += inner_->value_count();
  if (local_) build_local();
  else build_whole();
  begin_inner();
}

// Begins the step of the inner potential with the others where they are.
void LocalPotential::begin_inner() {
  const auto& settings = whole_.settings();
  const VecX x = local_ ? gathered(scratch_.x, vertices_) : scratch_.x, prediction = local_ ? gathered(settings.prediction, vertices_) : settings.prediction;
  inner_->begin_step(x, prediction, settings.scales, settings.inertia);
}

void LocalPotential::build_whole() {
  const DofMap& dofs = whole_.dofs();
  std::vector<char> movable(dofs.vertex_count(), 0);
  for (const int b : blocks_) movable[dofs.vertex_of_block(b)] = 1;
  std::vector<FixedDirections> fixed;
  for (const DofMap::PartlyFixedBlock& h : dofs.partly_fixed_blocks()) fixed.push_back({dofs.vertex_of_block(h.block), h.projection, h.scalar});
  dofs_ = DofMap(movable, dofs.dependences(), fixed);
  mass_ = whole_.settings().mass;
  inner_ = std::make_unique<IncrementalPotential>(std::vector<const Term*>(whole_.terms().begin(), whole_.terms().end()), dofs_, mass_, own_clock_, [this](const VecX& x) {
    scratch_.x = x;
    world_.participants.move_to(x);
  });
}

void LocalPotential::build_local() {
  const DofMap& dofs = whole_.dofs();
  vertices_ = {};
  for (const int b : blocks_) vertices_.add(dofs.vertex_of_block(b));  // in the order of the blocks
  for (const int v : moved_) vertices_.add(v);
  contact_.reset();
  if (world_.contact) {
    if (!world_.contact->covers(scratch_.x, moved_)) world_.contact->cover(scratch_.x, VecX());
    candidates_version_ = world_.contact->candidates_version();
    contact_ = world_.contact->potential().local(moved_);
    for (const int v : contact_->vertices()) vertices_.add(v);
  }
  parts_ = restricted_terms();  // numbers the vertices of their stencils
  Dependences dependences;
  for (const int v : moved_) {
    const int k = dependent_number(dofs, v);
    if (k < 0) continue;
    Dependence& d = dependences.emplace_back(Dependence{vertices_.find(v), {}});
    for (const DofMap::WeightedIndex& on : dofs.independents(k)) d.on.emplace_back(vertices_.add(on.index), on.weight);
  }
  std::vector<FixedDirections> fixed;
  for (const DofMap::PartlyFixedBlock& h : dofs.partly_fixed_blocks())
    if (std::binary_search(blocks_.begin(), blocks_.end(), h.block)) fixed.push_back({vertices_.find(dofs.vertex_of_block(h.block)), h.projection, h.scalar});
  std::vector<char> movable(vertices_.count(), 0);
  std::fill_n(movable.begin(), blocks_.size(), 1);
  dofs_ = DofMap(movable, dependences, fixed);
  mass_.resize(vertices_.count());
  for (int i = 0; i < vertices_.count(); ++i) mass_(i) = whole_.settings().mass(vertices_.global(i));
  std::vector<const Term*> terms;
  for (const auto& part : parts_) terms.push_back(part.get());
  inner_ = std::make_unique<IncrementalPotential>(std::move(terms), dofs_, mass_, own_clock_, [this](const VecX&) { find_contacts(); });
}

// Returns the parts of all terms that the moved vertices change, in the order of the terms.
std::vector<std::unique_ptr<Term>> LocalPotential::restricted_terms() {
  struct Choice {
    const Term* term;
    std::vector<std::vector<int>> stencils;
  };
  std::vector<Choice> choices;
  for (const Term* term : whole_.terms()) {
    if (dynamic_cast<const ContactTerm*>(term)) {
      choices.push_back({term, {}});
      continue;
    }
    std::vector<std::vector<int>> stencils = whole_.stencil_maps().touching(*term, moved_);
    const std::vector<StencilBatch> batches = term->batches();
    for (size_t b = 0; b < batches.size(); ++b)
      for (const int s : stencils[b])
        for (int k = 0; k < batches[b].arity; ++k) vertices_.add(batches[b].vertices[static_cast<size_t>(batches[b].arity) * s + k]);
    const bool none = std::all_of(stencils.begin(), stencils.end(), [](const auto& list) { return list.empty(); });
    if (none && !batches.empty() && !dynamic_cast<const GlobalModeSource*>(term)) continue;
    choices.push_back({term, std::move(stencils)});
  }
  for (const int v : moved_)
    if (const int k = dependent_number(whole_.dofs(), v); k >= 0)
      for (const DofMap::WeightedIndex& on : whole_.dofs().independents(k)) vertices_.add(on.index);
  std::vector<std::unique_ptr<Term>> all;
  for (const Choice& choice : choices) {
    if (dynamic_cast<const ContactTerm*>(choice.term)) {
      all.push_back(std::make_unique<ContactTerm>(*world_.contact, contacts_));
      continue;
    }
    const StencilChoice chosen{choice.stencils, vertices_};
    std::unique_ptr<Term> part = choice.term->restricted(chosen);
    all.push_back(part ? std::move(part) : listed_stencils(*choice.term, chosen, scratch_.x));
  }
  return all;
}

void LocalPotential::find_contacts() {
  if (!contact_) return;
  contact_->find(scratch_.x, contacts_);
  renumber_all(contacts_.point_point, vertices_);
  renumber_all(contacts_.point_edge, vertices_);
  renumber_all(contacts_.point_triangle, vertices_);
  renumber_all(contacts_.edge_edge, vertices_);
  renumber_all(contacts_.interior_point, vertices_);
  renumber_all(contacts_.interior_edge, vertices_);
  renumber_all(contacts_.interior_triangle, vertices_);
}

// Moves the vertices of the scratch configuration to unknowns q.
void LocalPotential::place(const VecX& q) {
  VecX x = inner_->configuration();
  dofs_.scatter(q, x);
  for (const int v : moved_) vertex(scratch_.x, v) = vertex(x, local_ ? vertices_.find(v) : v);
}

void LocalPotential::displace(const VecX& p) {
  VecX x = VecX::Zero(inner_->configuration().size());
  dofs_.scatter(p, x);
  for (const int v : moved_) vertex(scratch_.p, v) = vertex(x, local_ ? vertices_.find(v) : v);
}

void LocalPotential::move_to(const VecX& q) {
  clock_.deadline().check();
  if (!local_) return inner_->move_to(q);
  place(q);
  if (world_.contact) {
    if (!world_.contact->covers(scratch_.x, moved_)) world_.contact->cover(scratch_.x, VecX());
    if (world_.contact->candidates_version() != candidates_version_) build();
  }
  inner_->move_to(q);
}

}  // namespace tack
