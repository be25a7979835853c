// SPDX-License-Identifier: LGPL-3.0-or-later
#pragma once

#include "hexact/exact/eigenvalues.hpp"

#include <cstddef>
#include <string>

namespace hexact {

/// What is wrong with the statement that a list holds all n eigenvalues of a mode of valence k, with multiplicities,
/// but for `remaining` ones of modulus below `remaining_bound`; empty if nothing is.
///
/// Rational eigenvalues are divided out of the factors. Of the rest, an interval holds a root where a factor without
/// multiple roots changes sign; as many changes as the degree are all roots, and simple. Otherwise the factor must have
/// as many roots in the disc, counted by the test of Schur and Cohn, as its degree leaves over after the listed ones
/// outside: these are then simple roots of their square-free factor, and what is not listed is in the disc.
/// Exact where cos(2π angle/k) is rational or does not matter, else with it in an interval.
[[nodiscard]] std::string eigenvalue_fault(const ModeSpectrum& listed, const std::vector<CharacteristicFactor>& factors, int k, std::size_t n);

/// The same eigenvalues as `eigenvalue_fault` can take them: intervals that meet another eigenvalue of the list, from
/// another factor, are no longer listed but only bounded.
[[nodiscard]] ModeSpectrum disjoint_eigenvalues(const ModeSpectrum& mode);

}  // namespace hexact
