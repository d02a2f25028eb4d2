#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "materials/base/units.hpp"
#include "materials/matter/library.hpp"
#include "terrain/facets.hpp"
#include "terrain/visibility/view_factors.hpp"
#include "thermal/solve/packed_field.hpp"
#include "thermal/weather/sky_state.hpp"

namespace diurna {

/// Broadband optics of every facet.
struct FacetOptics {
    std::vector<float> albedo, emissivity;  // (facet)
};
FacetOptics facet_optics(const FacetSet& facets, const MaterialLibrary& materials);

/// The albedo of facets on which it changes, as snow falls and melts: replaces FacetOptics'.
struct ChangingAlbedo {
    std::vector<std::uint32_t> facet;  // ascending
    std::vector<float> albedo;         // (instant, place in `facet`)
};

/// Facets that exchange light, and their optics.
struct ExchangingFacets {
    const FacetSet& facets;
    const FacetViews& views;
    const FacetOptics& optics;
    std::size_t beside = 0;                    // the last ones, which others do not see
    bool exchange = true;                      // else each sees only sun and sky
    const ChangingAlbedo* changing = nullptr;  // null: no changes
    double bound = 1e-4;                       // of the global sun, skipped of a facet's light
};

/// The sky over facets at different heights: computed at a few heights, linear in between.
struct SkyOverFacets {
    std::span<const SkyState> sky;         // (instant, tier)
    std::size_t tiers = 1;                 // one: the same over all facets
    std::span<const std::uint16_t> low{};  // (facet) tier below it
    std::span<const float> share{};        // (facet) fraction of the way to the next tier

    std::size_t instants() const { return sky.size() / tiers; }
    /// Interpolates a value of the skies at a facet: (instant, tier) of them.
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

/// The instants at which sunlight is computed.
struct SunlitInstants {
    SkyOverFacets sky;
    std::span<const float> fraction;      // (instant, facet) share in the sun; empty: no shadows
    const PackedField* shares = nullptr;  // or of these instants of a field; null or empty: none
    std::size_t first = 0;                // of its instants
};

/// The largest share of emitted light that returns from other facets, over all facets, 0 to 0.99:
/// reflectance × view factor to others.
float greatest_sent_on(const FacetViews& views, std::span<const float> reflectance);

/// Sunlight on every facet [W m⁻²]: beam and sky (facet_sunlight) and reflections by other facets,
/// all interreflections to `bound` of the horizontal global sun (interreflection.hpp). Ground below
/// the scene's edge reflects the horizontal global sun with the facet's own reflectance.
///
/// incident  (instant, facet)
void incident_sunlight(const ExchangingFacets& scene, const SunlitInstants& sun,
                       std::span<float> incident);
/// The same for the sunlit instants, some multiple of PackedField::run of them at a time, fewer at
/// last, in their order; the light of the others is zero.
///
/// put  (instants, light): light is (facet, instant of these)
void incident_sunlight(
    const ExchangingFacets& scene, const SunlitInstants& sun,
    const std::function<void(std::span<const std::size_t>, std::span<const float>)>& put);
/// Instants with sunlight.
std::vector<std::size_t> sunlit(const SkyOverFacets& sky);

/// View factor of a facet to surroundings at its own temperature in longwave: beyond the scene's
/// edge, and the backs of sheets.
inline float seen_as_itself(const FacetViews& view, std::size_t facet) {
    return view.below[facet] + (view.hidden.empty() ? 0.0f : view.hidden[facet]);
}

/// Longwave from other facets minus that of the sky they hide, D = L_in − L_sky [W m⁻²]: neighbours
/// emit ε σ T⁴ and reflect the rest. Zero for any emissivities if ground and sky have the same
/// temperature. (T33) of docs/theory.md, in two parts: first the radiosity of a facet minus the
/// sky's radiance:
///
/// excess   previous D
/// returns  ε (σ T⁴ − L_sky) + (1 − ε) D
inline float leaving_longwave(float emissivity, double sky_longwave, float temperature,
                              float excess) {
    const double black = stefan_boltzmann * power4(double(temperature));
    return float(emissivity * (black - sky_longwave) + (1.0 - emissivity) * excess);
}
/// and the irradiance of a facet, at some instants at once: a row of the exchange is read once for
/// them, and its partners' values are contiguous.
///
/// leaving  (facet, instant)
/// excess   (instant) new D
void arriving_longwave(const FacetViews& view, std::span<const float> leaving, std::size_t facet,
                       std::span<float> excess);

}  // namespace diurna
