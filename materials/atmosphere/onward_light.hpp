#pragma once

#include <optional>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/atmosphere/path_spectrum.hpp"

namespace diurna {

/// Light that has come to a place through air of its own, and how much of it gets through more of
/// it: from there on to an eye.
///
/// Both ways are one path to the band model, τ = exp(−(C·W)^a) of the sum of their amounts. Lines
/// that are dark after the first way take little on the second, so that more arrives than the
/// product of their transmittances says: 3 to 7 % of sunlight in 0.7-1.0 and 1.5-1.8 µm, a tenth of
/// the sky's heat (tests/materials/onward_light_test.cpp). In a table of paths, which has no
/// amounts, and in a vacuum it is the product.
///
/// Made once for a height, then asked for many ways; safe to share between threads. Exact for the
/// sun. The sky's heat comes under four zenith angles, within 1 % of mean_sky_at_nodes() along
/// both ways over 20 km; to the sunlight it scatters the air has done what it did to the beam: all
/// sunlight on level ground is within 1.5 % of the sum along lines.
class OnwardLight {
 public:
    /// - atmosphere: to outlive it
    /// - sky: whether Way::sky_heat is wanted, most of the work; else it is that of the place's own
    ///   heat, the path's transmittance
    OnwardLight(const Atmosphere& atmosphere, double height_km, double sun_zenith_deg,
                std::span<const double> node_um, bool sky = true);

    /// A way to the place, and which share of the sunlight and of the sky's heat there gets to its
    /// beginning, (node).
    struct Way {
        PathSpectrum path;
        std::vector<double> sunlight, sky_heat;
    };
    /// - from_eye: from an eye to the place
    Way way(const SightLine& from_eye) const;

 private:
    /// A line to the sky, with what it has met at the end of each segment, and how warm it is
    /// there.
    struct SkyLine {
        double weight = 0.0;
        std::vector<Amounts> met;                 // (edge)
        std::vector<std::vector<double>> black;   // (edge)(bin)
        std::size_t cloud = 0;                    // edge at the cloud's base; 0: it meets none
        std::vector<double> behind, cloud_black;  // (bin)
    };
    SkyLine sky_line(double height_km, double zenith_deg, double weight) const;
    /// Adds what arrives of a line's light behind the amounts `more`; null: of the line alone.
    void add_heat(const SkyLine& line, const Amounts* more, std::vector<double>& sum) const;
    std::vector<double> per_node(const std::vector<double>& per_bin) const;

    const Atmosphere& atmosphere_;
    std::vector<double> node_um_;
    std::vector<std::size_t> node_bin_;  // counted from the first of the range
    std::optional<Medium> medium_;       // of the band model
    Amounts to_sun_;
    std::vector<double> sun_depth_;  // (bin); empty: the sun does not reach the place
    std::vector<SkyLine> sky_;
    std::vector<double> heat_;  // (bin) of all lines, with no more air
};

}  // namespace diurna
