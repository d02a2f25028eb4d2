#pragma once

#include <array>
#include <span>
#include <vector>

#include "materials/atmosphere/medium.hpp"

namespace diurna {

/// Optical depth of scaled aerosol (scaled_aerosol.hpp) along a line, and what the scaling took
/// from it, gathered by weights of humidity, so that bins are gone through once a line and not once
/// a segment. To 2e-7 of the sum of scaled_aerosol() over its segments, whose mixtures (two zones
/// of the haze at one height, rain) are summed as they are.
class BeamAerosol {
 public:
    /// - medium: to outlive it
    explicit BeamAerosol(const Medium& medium);

    /// A segment by the height of its middle.
    void add(double height_km, double length_km);
    /// Adds both depths of all segments, (bin).
    void put(std::span<double> scaled, std::span<double> peak) const;

 private:
    using Aerosol = BandModelTables::Aerosol;
    struct Part {
        const Aerosol* aerosol = nullptr;
        std::vector<double> node, level;  // weights: of extinction's nodes, of absorption's levels
    };
    void add_part(Part& part, double dryness, double depth) const;

    const Medium& medium_;
    std::array<Part, 2> part_;           // of the boundary layer, of the troposphere
    std::vector<double> scaled_, peak_;  // (bin) of mixtures
};

}  // namespace diurna
