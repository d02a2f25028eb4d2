#pragma once

#include <array>
#include <cstddef>

namespace diurna {

/// The terms of the radiance at the eye (radiance.hpp); `behind` is transmitted through a surface,
/// `path` the air between surface and eye.
enum class Term { emitted, sun, sky, surroundings, behind, path };
inline constexpr std::size_t term_count = 6;
/// Names of the planes of a picture.
inline constexpr std::array<const char*, term_count> term_names = {
    "emitted", "reflected_sun", "reflected_sky", "reflected_surroundings", "transmitted", "path"};

/// Some of the terms.
using TermSet = std::array<bool, term_count>;
inline constexpr TermSet all_terms = {true, true, true, true, true, true};
inline bool has(const TermSet& terms, Term term) { return terms[static_cast<std::size_t>(term)]; }

}  // namespace diurna
