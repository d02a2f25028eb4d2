#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// The terms of a facet's heat balance [W m⁻²], each positive the way its name says.
enum class HeatTerm : std::size_t {
    absorbed_sunlight,
    absorbed_longwave,  // of sky and other facets
    internal,           // released at the surface
    emitted_longwave,
    sensible,   // to the air
    latent,     // carried away by vapour
    melting,    // taken by frost that melts on the surface; negative: given by water that freezes
    conducted,  // into what lies below, what its surface stores included: from the conduction's own
                // solution, not what the other terms leave over
};
inline constexpr std::size_t heat_terms = 8;
/// The first of them, which bring heat; the others take it.
inline constexpr std::size_t heat_sources = 3;

/// (term) [W m⁻²]
using HeatTerms = std::array<float, heat_terms>;

/// The heat balance of every facet at every kept instant. What the sources bring the others take
/// away, to the rounding of floats and the solver's tolerance.
struct HeatFluxField {
    std::vector<Instant> instant;  // ascending
    std::size_t facets = 0;
    std::array<std::vector<float>, heat_terms> watts{};  // (term) (instant, facet) [W m⁻²]

    const std::vector<float>& of(HeatTerm term) const {
        return watts[static_cast<std::size_t>(term)];
    }
    bool empty() const { return instant.empty(); }
    /// Adds an instant between two of another field's, straight between them.
    void add_between(const HeatFluxField& other, Instant when);
};

}  // namespace diurna
