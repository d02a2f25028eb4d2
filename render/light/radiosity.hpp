#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "render/light/bounces.hpp"
#include "render/light/lit_facets.hpp"
#include "render/light/radiosity_tables.hpp"
#include "render/light/reused_floats.hpp"

namespace diurna {

/// The radiosity (over π: as radiance) of every lit facet that illuminates others, in the modes of
/// all bands.
///
/// Emission, reflected sky and sun, and interreflections (terrain/visibility/interreflection.hpp)
/// until a bounce adds less than BounceOptions allow. Initially, and wherever they are
/// insignificant or absent, a facet's surroundings count as black at its own temperature: an
/// isothermal enclosure is exactly black.
/// exactly black.
class Radiosity {
 public:
    /// All of these must outlive it.
    ///
    /// - bounces: (band)
    Radiosity(const LitFacets& lit, const LitState& state, const RadiosityTables& tables,
              std::span<const BandLight> bands, std::span<const BounceOptions> bounces);

    /// Irradiance (as radiance) of a facet from those around it: Σ F_j J_j, over a hemisphere 1 −
    /// sky view.
    ///
    /// - black: (lane) black body at the facet's temperature
    void arriving(std::size_t lit, const float* black, float* out) const;
    /// Prefetches the memory that arriving() needs.
    void fetch(std::size_t lit) const {
        for (std::uint32_t e = lit_.row[lit]; e < lit_.row[lit + 1]; ++e) {
            __builtin_prefetch(&radiosity_[std::size_t{lit_.source[e]} * tables_.lanes]);
        }
    }
    std::size_t followed() const { return followed_; }  // facets with a second bounce
    int bounces() const { return bounces_; }            // followed, the first included

 private:
    void first_bounce(std::size_t lit, std::span<const BandLight> bands, float* out) const;
    /// Adds ρ times the incident light.
    void reflect(std::size_t lit, const float* light, float* out) const;
    /// Stores the part of a facet's reflection by which its surroundings differ from black ones.
    void second_bounce(std::size_t lit, float* unsent) const;
    void follow_bounces(std::span<const BandLight> bands, std::span<const BounceOptions> bounces);

    const LitFacets& lit_;
    const LitState& state_;
    const RadiosityTables& tables_;
    ReusedFloats radiosity_;  // (lit, lane)
    std::size_t followed_ = 0;
    int bounces_ = 1;
};

}  // namespace diurna
