#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "terrain/place/instant.hpp"

namespace diurna {

/// The terms of a facet's heat balance [W m⁻²], each positive in the direction of its name.
enum class HeatTerm : std::size_t {
    absorbed_sunlight,
    absorbed_longwave,  // from sky and other facets
    internal,           // released at the surface
    emitted_longwave,
    sensible,   // to the air
    latent,     // with vapour
    melting,    // by melting frost on the surface; negative: from freezing water
    conducted,  // into the column, with its surface's storage: from the conduction
                // solution, not as the remainder of the other terms
};
inline constexpr std::size_t heat_terms = 8;
/// The first ones are gains of heat; the others are losses.
inline constexpr std::size_t heat_sources = 3;

/// (term) [W m⁻²]
using HeatTerms = std::array<float, heat_terms>;

/// The heat balance of every facet at every stored instant. Gains equal losses to float rounding
/// and the solver's tolerance.
struct HeatFluxField {
    std::vector<Instant> instant;  // ascending
    std::size_t facets = 0;
    std::array<std::vector<float>, heat_terms> watts{};  // (term) (instant, facet) [W m⁻²]

    const std::vector<float>& of(HeatTerm term) const {
        return watts[static_cast<std::size_t>(term)];
    }
    bool empty() const { return instant.empty(); }
    /// Adds an instant between two of another field's, by linear interpolation.
    void add_between(const HeatFluxField& other, Instant when);
};

}  // namespace diurna
