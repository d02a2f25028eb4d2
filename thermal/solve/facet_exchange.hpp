#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/weather/sky_state.hpp"

namespace diurna {

/// Broadband optics of every facet.
struct FacetOptics {
    std::vector<float> albedo, emissivity;  // (facet)
};
FacetOptics facet_optics(const FacetSet& facets, const MaterialLibrary& materials);

/// The albedo of facets on which it changes, as snow falls and melts: in place of FacetOptics'.
struct ChangingAlbedo {
    std::vector<std::uint32_t> facet;  // ascending
    std::vector<float> albedo;         // (instant, place in `facet`)
};

/// Who exchanges light with whom.
struct ExchangingFacets {
    const FacetSet& facets;
    const FacetViews& views;
    const FacetOptics& optics;
    std::size_t beside = 0;                    // the last so many, which others do not see
    bool exchange = true;                      // else each sees sun and sky alone
    const ChangingAlbedo* changing = nullptr;  // null: none changes
};

/// The sky over facets at heights of their own: at a few heights, in between on the straight line.
struct SkyOverFacets {
    std::span<const SkyState> sky;         // (instant, tier)
    std::size_t tiers = 1;                 // one: the same over all facets
    std::span<const std::uint16_t> low{};  // (facet) tier below it
    std::span<const float> share{};        // (facet) of the way to the next

    std::size_t instants() const { return sky.size() / tiers; }
    /// A value of every sky's, at a facet: (instant, tier) of them.
    /// - value: of a T, a number
    template <class T, class Value>
    double at_facet(const std::vector<T>& of, std::size_t i, std::size_t f,
                    const Value& value) const {
        if (tiers == 1) return std::invoke(value, of[i]);
        const T* const below = &of[i * tiers + low[f]];
        const double here = std::invoke(value, below[0]);
        return here + double(share[f]) * (std::invoke(value, below[1]) - here);
    }
};

/// The instants that sunlight is wanted at.
struct SunlitInstants {
    SkyOverFacets sky;
    std::span<const float> fraction;  // (instant, facet) share in the sun; empty: no shadows
};

/// The greatest share of light sent out that comes back from any facet, 0 to 0.99: its
/// reflectance × what it sees of others.
float greatest_sent_on(const FacetViews& views, std::span<const float> reflectance);

/// Sunlight on every facet [W m⁻²]: beam and sky (facet_sunlight) and what other facets reflect,
/// all bounces of it within 1e-4 of the horizontal global sun (interreflection.hpp). Ground below
/// the scene's edge reflects the horizontal global sun as the facet itself would.
///
/// incident  (instant, facet)
void incident_sunlight(const ExchangingFacets& scene, const SunlitInstants& sun,
                       std::span<float> incident);

/// The share of its hemisphere where a facet sees its own like in longwave: beyond the scene's
/// edge, and the backs of sheets.
inline float seen_as_itself(const FacetViews& view, std::size_t facet) {
    return view.below[facet] + (view.hidden.empty() ? 0.0f : view.hidden[facet]);
}

/// Longwave from other facets beyond what the sky they hide would send, D = L_in − L_sky [W m⁻²]:
/// neighbours emit ε σ T⁴ and reflect the rest of what reaches them. Zero, whatever the
/// emissivities, where ground and sky are equally warm. In two halves: what leaves a
/// facet beyond the sky's radiance, (T33) of docs/theory.md,
///
/// excess   D as it was
/// returns  ε (σ T⁴ − L_sky) + (1 − ε) D
inline float leaving_longwave(float emissivity, double sky_longwave, float temperature,
                              float excess) {
    const double black = stefan_boltzmann * power4(double(temperature));
    return float(emissivity * (black - sky_longwave) + (1.0 - emissivity) * excess);
}
/// and what arrives at a facet, at all instants at once: a row of the exchange is read once, and
/// what its partners send lies together.
///
/// leaving  (facet, instant)
/// excess   (instant) D as it becomes
void arriving_longwave(const FacetViews& view, std::span<const float> leaving, std::size_t facet,
                       std::span<float> excess);

}  // namespace diurna
