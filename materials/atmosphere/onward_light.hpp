#pragma once

#include <optional>
#include <span>
#include <vector>

#include "materials/air/sight_line.hpp"
#include "materials/atmosphere/atmosphere.hpp"
#include "materials/atmosphere/medium.hpp"
#include "materials/atmosphere/path_spectrum.hpp"

namespace diurna {

/// Light that has reached a place through air, and the share of it that passes a further path from
/// there to an observer.
///
/// The band model treats both paths as one, τ = exp(−(C·W)^a) of the sum of their amounts. Lines
/// that are saturated on the first path absorb little on the second, so that more arrives than the
/// product of the transmittances gives: 3 to 7 % of sunlight in 0.7-1.0 and 1.5-1.8 µm, a tenth of
/// the sky's thermal radiance (tests/materials/onward_light_test.cpp). A table of paths, which has
/// no amounts, and a vacuum use the product.
///
/// Built once for a height, then evaluated for many paths; safe to share between threads. Exact for
/// the sun. The sky's thermal radiance comes from four zenith angles, within 1 % of
/// mean_sky_at_nodes() along both paths over 20 km; scattered sunlight is attenuated as the beam
/// is: all sunlight on level ground is within 1.5 % of the sum along lines.
class OnwardLight {
 public:
    /// - atmosphere: to outlive it
    /// - sky: whether Way::sky_heat is wanted, most of the work; else it is that of the place's own
    ///   heat, the path's transmittance
    OnwardLight(const Atmosphere& atmosphere, double height_km, double sun_zenith_deg,
                std::span<const double> node_um, bool sky = true);

    /// A path from an observer to the place, and the shares of the sunlight and of the sky's
    /// thermal radiance there that arrive at the observer, (node).
    struct Way {
        PathSpectrum path;
        std::vector<double> sunlight, sky_heat;
    };
    /// - from_eye: from an observer to the place
    Way way(const SightLine& from_eye) const;

    /// The same in two parts: without the sky's heat, which is most of the work and changes less
    /// from path to path, and that.
    struct Direct {
        PathSpectrum path;
        std::vector<double> sunlight;
        Amounts met;  // on the path; nothing without the band model
    };
    Direct direct(const SightLine& from_eye) const;
    /// - met: of direct() of that path
    /// - transmittance: of the path, which the share is for a place without a sky
    std::vector<double> sky_heat(const SightLine& from_eye, const Amounts& met,
                                 const std::vector<double>& transmittance) const;
    /// Gives a place that was made without it its sky.
    void add_sky(double height_km);

 private:
    /// A line to the sky, with the amounts and black-body radiance at the end of each
    /// segment.
    struct SkyLine {
        double weight = 0.0;
        std::vector<Amounts> met;                 // (edge)
        std::vector<std::vector<double>> black;   // (edge)(bin)
        std::size_t cloud = 0;                    // edge at the cloud's base; 0: no cloud on it
        std::vector<double> behind, cloud_black;  // (bin)
    };
    SkyLine sky_line(double height_km, double zenith_deg, double weight) const;
    /// Adds what arrives of a line's light behind the amounts `more`; null: no further path.
    void add_heat(const SkyLine& line, const Amounts* more, std::vector<double>& sum) const;
    std::vector<double> per_node(const std::vector<double>& per_bin) const;
    /// Of what starts at a path's end and meets clouds on it, (node).
    std::vector<double> behind_cloud(const SightLine& from_eye,
                                     const std::vector<double>& per_bin) const;

    const Atmosphere& atmosphere_;
    std::vector<double> node_um_;
    std::vector<std::size_t> node_bin_;  // counted from the first of the range
    std::optional<Medium> medium_;       // of the band model
    Amounts to_sun_;
    std::vector<double> sun_depth_;  // (bin); empty: the sun does not reach the place
    std::vector<SkyLine> sky_;
    std::vector<double> heat_;  // (bin) of all lines, without a further path
};

}  // namespace diurna
