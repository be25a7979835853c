// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/plane_body.hpp"
#include "hexact/exact/verdict.hpp"
#include "hexact/kernel/progress.hpp"

#include <string>
#include <vector>

namespace hexact {

/// Puts body, claims and the bodies that claims refer to together and searches the evidence of `inside` and
/// `tangent`: for every half-space of the reference that is not a facet half-space of the body, the vertex farthest
/// along its normal (walking uphill by exact signs). Claims are not decided: see `verify`.
/// Throws InvalidInput (UnknownClaim, MissingBody) for a claim that does not exist or refers to no given body.
/// Cost: linear, and for each such half-space the length of a walk over the body.
[[nodiscard]] Certificate make_certificate(PlaneBody body, std::vector<Claim> claims,
                                           std::vector<NamedBody> references, std::vector<std::string> provenance,
                                           const ProgressPart& progress = {});

/// Decides every claim with exact integers, in the order of the certificate, from its evidence alone.
///
/// closed: one connected oriented manifold surface without boundary. planar: every vertex is the one point of its
/// three defining planes and lies on all its facets. trivalent: three facets at every vertex. convex: closed,
/// planar, χ = 2, every edge and corner strictly convex, facets and vertex stars turn once (van Heijenoort 1952).
/// embedded: oriented manifold, simple facets that meet in common vertices and edges only, normals outward.
/// inside, tangent, corner-cut-of: as in the documentation of certificates; corner-cut-of replays the levels.
/// smooth-limit: see smooth_limit; proved or undecided.
/// A claim whose proof is missing from the certificate is refuted, the missing part being the witness.
/// Witnesses name the smallest element. Cost: O(H log H) and about 2 det3 and 3 det4 per facet; in parallel.
[[nodiscard]] std::vector<ClaimVerdict> verify(const Certificate& certificate, const ProgressPart& progress = {});

/// refuted if any claim is, else undecided if any is or there is none, else proved.
[[nodiscard]] Verdict overall(const std::vector<ClaimVerdict>& verdicts) noexcept;

/// "convex" or "inside=base".
[[nodiscard]] std::string claim_text(const Claim& claim);

}  // namespace hexact
