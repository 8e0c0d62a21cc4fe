#include "framework/assembly/assembler.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <iterator>

#include "framework/assembly/stencil_clamp.hpp"
#include "framework/core/concurrent_disjoint_sets.hpp"
#include "framework/core/term_times.hpp"
#include "geometry/parallel.hpp"
#include "geometry/parallel_loops.hpp"

namespace tack {

namespace {

bool needs_reduction(const Term& term, const DofMap& dofs) {
  if (dofs.plain()) return false;
  for (const StencilBatch& batch : term.batches())
    for (int s = 0; s < batch.count; ++s)
      if (tack::needs_reduction(batch, s, dofs)) return true;
  return false;
}

void fill_with_zeros(double* values, size_t n) {
  constexpr int chunk = 16384;
  for_each_chunk(static_cast<int>((n + chunk - 1) / chunk), [&](int c, int, int) {
    const size_t first = static_cast<size_t>(c) * chunk;
    std::fill(values + first, values + std::min(n, first + chunk), 0.0);
  }, 1);
}

// Returns the index of each key in a list that has all of them; both are sorted.
std::vector<int> indices_of(const std::vector<BlockKey>& keys, const std::vector<BlockKey>& list) {
  std::vector<int> indices(keys.size());
  for_each_chunk(static_cast<int>(keys.size()), [&](int, int first, int last) {
    auto at = std::lower_bound(list.begin(), list.end(), keys[first]);
    for (int k = first; k < last; ++k) {
      while (*at != keys[k]) ++at;
      indices[k] = static_cast<int>(at - list.begin());
    }
  }, 4096);
  return indices;
}

constexpr int vertices_per_chunk = 8192;  // of lists that are copied or compared

}  // namespace

// Returns whether the maps are those of the batches.
bool Assembler::Group::is_mapped() const {
  std::atomic<bool> same = true;
  ParallelLoops loops;
  size_t at = 0;
  for (const PlacedBatch& placed : batches) {
    const StencilBatch& b = placed.batch;
    const int entries = b.arity * b.count;
    if (at + 2 + entries > mapped.size() || mapped[at] != b.arity || mapped[at + 1] != b.count) return false;
    loops.add(entries, [&same, now = b.vertices, before = mapped.data() + at + 2](int, int first, int last) {
      if (!std::equal(now + first, now + last, before + first)) same.store(false, std::memory_order_relaxed);
    }, vertices_per_chunk);
    at += 2 + entries;
  }
  loops.run();
  return same && at == mapped.size();
}

// Stores the batches that the maps are for.
void Assembler::Group::set_mapped() {
  size_t size = 0;
  for (const PlacedBatch& placed : batches) size += 2 + static_cast<size_t>(placed.batch.arity) * placed.batch.count;
  mapped.resize(size);
  ParallelLoops loops;
  int* at = mapped.data();
  for (const PlacedBatch& placed : batches) {
    const StencilBatch& b = placed.batch;
    *at++ = b.arity;
    *at++ = b.count;
    loops.add(b.arity * b.count, [from = b.vertices, at](int, int first, int last) { std::copy(from + first, from + last, at + first); },
              vertices_per_chunk);
    at += b.arity * b.count;
  }
  loops.run();
}

void Assembler::Group::assign_slots(const DofMap& dofs, bool with_hessian) {
  batches.clear();
  batch_terms.clear();
  first_gradient.clear();
  first_hessian.clear();
  int gradient_slot = 0, hessian_slot = 0;
  for (const Term* term : terms) {
    first_gradient.push_back(gradient_slot);
    first_hessian.push_back(hessian_slot);
    for (const StencilBatch& batch : term->batches()) {
      batches.push_back({batch, gradient_slot, hessian_slot});
      batch_terms.push_back(term);
      gradient_slot += batch.arity * batch.count;
      hessian_slot += hessian_blocks(batch.arity) * batch.count;
    }
  }
  own_gradient_slots = 3 * static_cast<size_t>(gradient_slot);
  if (batches.empty() || !is_mapped()) {
    reduced.assign_slots(batches, dofs, gradient_slot, hessian_slot);
    gradient_map = tack::gradient_map(mapped_batches(), dofs);
    hessian_mapped = false;
    set_mapped();
  }
  gradient_slots.resize(3 * static_cast<size_t>(reduced.gradient_end()));
  if (with_hessian) hessian_slots.resize(9 * static_cast<size_t>(reduced.hessian_end()));
  if (!with_hessian || hessian_mapped) return;
  hessian_map = tack::hessian_map(mapped_batches(), dofs);
  hessian_mapped = true;
}

std::vector<PlacedBatch> Assembler::Group::mapped_batches() const {
  std::vector<PlacedBatch> all = batches;
  all.insert(all.end(), reduced.batches().begin(), reduced.batches().end());
  return all;
}

void Assembler::Group::evaluate(const VecX& x, Projection projection, bool with_hessian, TermTimes* times) {
  for (size_t t = 0; t < terms.size(); ++t) {
    double* hessian =
        with_hessian ? hessian_slots.data() + 9 * static_cast<size_t>(first_hessian[t]) : nullptr;
    const TermScope scope(times, terms[t], with_hessian ? Evaluation::hessian : Evaluation::gradient);
    terms[t]->derivatives(x, projection, gradient_slots.data() + 3 * static_cast<size_t>(first_gradient[t]),
                          hessian);
  }
}

void Assembler::Group::clamp_at(const std::vector<char>& block, const DofMap& dofs) {
  for (const PlacedBatch& placed : batches) {
    const StencilBatch& b = placed.batch;
    double* const slots = hessian_slots.data() + 9 * static_cast<size_t>(placed.hessian_slot);
    for_each_chunk(b.count, [&](int, int first, int last) {
      clamp_stencils(b, first, last, block, dofs, slots + 9 * static_cast<size_t>(hessian_blocks(b.arity)) * first);
    });
  }
}

void Assembler::Group::gather_gradient(double scale, VecX& gradient) const {
  const GatherMap& map = gradient_map;
  for_each(map.targets(), [&](int k) {
    Vec3 sum = Vec3::Zero();
    for (int e = map.start[k]; e < map.start[k + 1]; ++e)
      sum += Eigen::Map<const Vec3>(gradient_slots.data() + 3 * static_cast<size_t>(map.slot[e]));
    gradient.segment<3>(3 * static_cast<Eigen::Index>(map.target[k])) += scale * sum;
  });
}

void Assembler::Group::gather_hessian(double scale, const std::vector<int>& positions,
                                      BlockMatrix& matrix) const {
  const GatherMap& map = hessian_map;
  const int entries = static_cast<int>(map.slot.size());
  const auto block = [&](int e) { return hessian_slots.data() + 9 * static_cast<size_t>(map.slot[e] >> 1); };
  for_each(map.targets(), [&](int k) {
    Mat3 sum = Mat3::Zero();
    for (int e = map.start[k]; e < map.start[k + 1]; ++e) {
      // Slots are scattered in memory: the next ones are prefetched.
      constexpr int ahead = 24;
      const double* next = block(std::min(e + ahead, entries - 1));
      __builtin_prefetch(next);
      __builtin_prefetch(next + 8);
      if (map.slot[e] & 1) {
        sum += Eigen::Map<const Mat3>(block(e)).transpose();
      } else {
        sum += Eigen::Map<const Mat3>(block(e));
      }
    }
    matrix.block(positions[k]) += scale * sum;
  });
}

Assembler::Assembler(std::vector<const Term*> terms, const DofMap& dofs, PhaseClock& clock)
    : dofs_(dofs), clock_(clock), terms_(std::move(terms)) {
  std::vector<const StencilRanges*> ranges;
  for (const Term* term : terms_) {
    if (const auto* source = dynamic_cast<const GlobalModeSource*>(term)) mode_sources_.emplace_back(term, source);
    const std::vector<const StencilRanges*> own = term->ranges();
    const bool ranged = !term->dynamic() && !own.empty() && !needs_reduction(*term, dofs_);
    (ranged ? ranged_ : term->dynamic() ? dynamic_ : static_).terms.push_back(term);
    if (ranged) ranges.insert(ranges.end(), own.begin(), own.end());
  }
  ranged_.assign_slots(dofs_, false);
  ranged_sums_.build(ranges, ranged_.batches, dofs_);
  static_.assign_slots(dofs_, true);
  std::vector<BlockKey> keys;
  std::set_union(ranged_sums_.targets().begin(), ranged_sums_.targets().end(), static_.hessian_map.target.begin(),
                 static_.hessian_map.target.end(), std::back_inserter(keys));
  pattern_ = std::make_unique<BlockPattern>(dofs_.block_count(), keys);
  ranged_keys_ = indices_of(ranged_sums_.targets(), pattern_->static_keys());
  static_keys_ = indices_of(static_.hessian_map.target, pattern_->static_keys());
  number_components();
}

void Assembler::add_linear(const VecX& x, const TermScales& scales, VecX& gradient) const {
  VecX full = VecX::Zero(x.size());
  double scale = scales.body;  // of `full`
  for (const Term* term : terms_) {
    if (const double own = scales.of(*term); own != scale) {
      full *= scale / own;
      scale = own;
    }
    term->add_linear_gradient(full);
  }
  dofs_.move_to_independents(full);
  for_each(dofs_.block_count(), [&](int b) { gradient.segment<3>(3 * b) += scale * vertex(full, dofs_.vertex_of_block(b)); });
}

// Collects the modes as vectors W^T u of the unknowns.
void Assembler::gather_modes(const VecX& x, const TermScales& scales, const HessianRequest& request, GlobalModes& modes) const {
  modes.clear();
  for (const auto& [term, source] : mode_sources_) {
    const bool dynamic = term->dynamic();
    if (dynamic && request.without_dynamic) continue;
    const Projection asked = dynamic ? request.dynamic_projection.value_or(request.projection) : request.projection;
    const size_t first = modes.size();
    // Modes touch every block, flagged or not.
    source->add_global_modes(x, request.clamp_at ? Projection::clamp : asked, modes);
    for (size_t k = first; k < modes.size(); ++k) {
      modes[k].vector = dofs_.to_unknowns(modes[k].vector);
      modes[k].coefficient *= scales.of(*term);
    }
  }
}

void Assembler::add_gradient(const VecX& x, const TermScales& scales, VecX& gradient) {
  const PhaseScope scope(clock_, Phase::assembly);
  dynamic_.assign_slots(dofs_, false);
  for (Group* group : groups()) {
    if (group == &ranged_) evaluate_ranged(x, nullptr);
    else group->evaluate(x, Projection::none, false, clock_.term_times());
    group->reduced.reduce(group->gradient_slots.data(), nullptr);
    group->gather_gradient(group == &dynamic_ ? scales.contact : scales.body, gradient);
  }
  add_linear(x, scales, gradient);
  dofs_.project_out_fixed_directions(gradient);
}

// Replaces rows and columns of fixed directions by those of a multiple of the identity.
void Assembler::project_out_fixed_directions(BlockMatrix& matrix) const {
  if (dofs_.partly_fixed_blocks().empty()) return;
  std::vector<const Mat3*> fixed(dofs_.block_count(), nullptr);
  for (const DofMap::PartlyFixedBlock& h : dofs_.partly_fixed_blocks()) fixed[h.block] = &h.projection;
  for_each(matrix.columns(), [&](int c) {
    for (int k = matrix.column_start[c]; k < matrix.column_start[c + 1]; ++k) {
      const int r = matrix.row[k];
      if (fixed[r]) matrix.block(k) -= (*fixed[r] * matrix.block(k)).eval();
      if (fixed[c]) matrix.block(k) -= (matrix.block(k) * *fixed[c]).eval();
      if (r != c || !fixed[c]) continue;
      const double size = matrix.block(k).trace();
      matrix.block(k) += (size > 0 ? size : 1.0) * *fixed[c];
    }
  });
}

void Assembler::add_last_gradients(VecX& gradient) const {
  for (const Group* group : {&ranged_, &static_, &dynamic_}) {
    for (size_t i = 0; i < group->batches.size(); ++i) {
      if (!group->batch_terms[i]->stores()) continue;
      const PlacedBatch& placed = group->batches[i];
      const double* slot = group->gradient_slots.data() + 3 * static_cast<size_t>(placed.gradient_slot);
      for (int k = 0; k < placed.batch.arity * placed.batch.count; ++k, slot += 3)
        vertex(gradient, placed.batch.vertices[k]) += Eigen::Map<const Vec3>(slot);
    }
  }
}

double Assembler::Group::largest_force() const {
  return max_chunks(static_cast<int>(own_gradient_slots), 0.0, [&](int first, int last) {
    double largest = 0;
    for (int i = first; i < last; ++i) largest = std::max(largest, std::abs(gradient_slots[i]));
    return largest;
  }, 4096);
}

double Assembler::largest_stencil_force() const {
  return std::max({ranged_.largest_force(), static_.largest_force(), dynamic_.largest_force()});
}

// Numbers the components of unknown blocks. Stencils connect the blocks of a component.
void Assembler::number_components() {
  ConcurrentDisjointSets sets;
  sets.reset(dofs_.block_count());
  const std::vector<BlockKey>& keys = pattern_->static_keys();
  for_each(static_cast<int>(keys.size()), [&](int k) { sets.join(key_row(keys[k]), key_column(keys[k])); }, 4096);
  component_.resize(dofs_.block_count());
  int components = 0;
  for (int b = 0; b < dofs_.block_count(); ++b) component_[b] = sets.find(b) == b ? components++ : component_[sets.find(b)];
  // A scalar dof does not move with its component.
  for (const DofMap::PartlyFixedBlock& h : dofs_.partly_fixed_blocks())
    if (h.scalar) component_[h.block] = components++;
}

void Assembler::locate_static_blocks() {
  const auto locate = [&](const std::vector<int>& indices, std::vector<int>& positions) {
    positions.resize(indices.size());
    for_each(static_cast<int>(indices.size()), [&](int t) { positions[t] = pattern_->static_positions()[indices[t]]; }, 2048);
  };
  locate(ranged_keys_, ranged_positions_);
  locate(static_keys_, static_positions_);
}

// Evaluates the terms with ranges. hessian: null: gradients alone.
void Assembler::evaluate_ranged(const VecX& x, const HessianRequest* hessian) {
  double* const gradients = ranged_.gradient_slots.data();
  TermTimes* const times = clock_.term_times();
  std::vector<double> seconds;
  std::vector<double>* const timed = times ? &seconds : nullptr;
  if (hessian) ranged_sums_.evaluate(x, hessian->projection, hessian->clamp_at, gradients, timed);
  else ranged_sums_.evaluate_gradients(x, gradients, timed);
  if (!times) return;
  for (size_t b = 0, t = 0; t < ranged_.terms.size(); ++t) {
    double of_term = 0;
    while (b < seconds.size() && ranged_.batch_terms[b] == ranged_.terms[t]) of_term += seconds[b++];
    times->add(ranged_.terms[t], hessian ? Evaluation::hessian : Evaluation::gradient, of_term);
  }
}

void Assembler::assemble(const VecX& x, const TermScales& scales, const HessianRequest& request,
                         const VecX& block_mass, VecX& gradient, BlockMatrix& matrix) {
  const PhaseScope scope(clock_, Phase::assembly);
  dynamic_.assign_slots(dofs_, true);
  if (pattern_->cover(dynamic_.hessian_map.target, matrix, dynamic_positions_)) locate_static_blocks();
  if (matrix.component.size() != component_.size()) matrix.component = component_;
  dofs_.gather(x, matrix.positions);
  fill_with_zeros(matrix.values.data(), matrix.values.size());
  for_each(dofs_.block_count(), [&](int b) { matrix.block(matrix.column_start[b]).diagonal().setConstant(block_mass(b)); });

  for (Group* group : groups()) {
    const bool dynamic = group == &dynamic_;
    if (group == &ranged_) {
      evaluate_ranged(x, &request);
    } else {
      const Projection projection = dynamic ? request.dynamic_projection.value_or(request.projection) : request.projection;
      group->evaluate(x, projection, true, clock_.term_times());
    }
    if (request.clamp_at && group != &ranged_) {
      const PhaseScope projecting(clock_, Phase::projection);
      group->clamp_at(*request.clamp_at, dofs_);
    }
    group->reduced.reduce(group->gradient_slots.data(), group == &ranged_ ? nullptr : group->hessian_slots.data());
    group->gather_gradient(dynamic ? scales.contact : scales.body, gradient);
  }
  ranged_sums_.gather(scales.body, ranged_positions_, matrix);
  static_.gather_hessian(scales.body, static_positions_, matrix);
  if (!request.without_dynamic) dynamic_.gather_hessian(scales.contact, dynamic_positions_, matrix);
  add_linear(x, scales, gradient);
  dofs_.project_out_fixed_directions(gradient);
  project_out_fixed_directions(matrix);
  gather_modes(x, scales, request, matrix.modes);
}

}  // namespace tack
