// Search for the contacts of Offset Geometric Contact at one configuration.
//  * A vertex and the block of a face, an edge or a vertex in which it lies (feasible_cones.hpp),
//    each block once. A face has blocks on both sides; of a solid, on the outer one.
//  * Two edges whose closest points lie inside both, each outside of the other's body. As in the
//    authors' code, their cones are not tested.
// Stencils are those of all models (contact_set.hpp): distances to the plane, line or point, along
// whose normals forces act.
//
// Weights: a quarter of the tributary area at rest of the vertex, or of the root of the product of
// the edges' areas, as in gcp/gcp_search.hpp. The paper has a stiffness per contact instead.
// Source: Chen et al. 2025, Offset Geometric Contact, ACM TOG 44(4), contact detection.
// Differences: laws of pairs of objects, with the contact distance as the paper's radius;
// primitives close at rest as in rest_gaps.hpp; edges that are nearly parallel have the mollifier
// of Li et al. 2020.
#pragma once

#include "framework/contact/stencils/contact_set.hpp"
#include "framework/contact/surface/surface_rings.hpp"

namespace tack {

struct OgcSearchRequest {
  const ContactSurface& surface;
  const SurfaceRings& rings;
  const PairTable& pairs;
  const std::vector<char>& free;  // per global vertex; empty: every vertex is free
};

// Sets the contacts at x (3n) [m].
void find_ogc_contacts(const OgcSearchRequest& request, const Candidates& candidates, const VecX& x,
                       ContactSet& contacts);

}  // namespace tack
