#pragma once

#include <limits>
#include <vector>

#include "materials/air/profile.hpp"

namespace diurna {

inline constexpr double earth_radius_km = 6371.23;
inline constexpr double atmosphere_top_km = 100.0;
/// Boundary-layer aerosol begins to fade here; no segment crosses this height.
inline constexpr double aerosol_top_km = 2.0;

/// A sight line over a spherical earth, sampled outward from the observer.
struct SightLine {
    std::vector<double> height_km;     // (segment) of its middle, above the sea
    std::vector<double> length_km;     // (segment)
    std::vector<double> edge_km = {};  // (segment + 1) heights of the ends; empty: not known

    std::size_t size() const { return length_km.size(); }
    double range_km() const;
    /// Height at the fraction `share` of a segment: from the parabola through its ends and middle,
    /// or linear between the middles if the ends are not known.
    double height_within(std::size_t segment, double share) const;
    /// Only the segments before `end`.
    SightLine first(std::size_t end) const;
};

/// How finely a sight line is cut. A segment's change of height is at most `growth` times the sum
/// of the height changes before it, but at least `first_km` and at most `ceiling_km` (1 + (height /
/// thinning_km)²): short where opaque air hides all that is behind it, long where the air is thin,
/// and one segment for a level line.
struct Segmentation {
    double first_km = 0.015;
    double growth = 0.35;
    double ceiling_km = 0.25;
    double thinning_km = 8.0;
};
/// Half as many segments, for transmittance only, to 0.05 %.
inline constexpr Segmentation beam_segmentation{
    .first_km = 0.03, .growth = 0.5, .ceiling_km = 0.5, .thinning_km = 6.0};

/// Segments of a line that starts at `height_km` under `zenith_deg` (0 up, 90 level, 180 down) and
/// runs `range_km`, or to the ground (sea level, or the start if that is lower) or the top of the
/// air if it is infinite. A finite range ends 0.5 km below the sea at the latest. A start above the
/// air is moved to where the line enters it; a line that never does has no segments.
///
/// With the default segmentation path radiance is converged to 0.2 % in every band
/// (tests/materials/atmosphere_test.cpp). Straight; refracted_line() bends.
/// Throws InputError for a zenith outside 0 to 180, a negative range, or a height that is not
/// within -0.5 to 1e6 km.
SightLine sight_line(double height_km, double zenith_deg,
                     double range_km = std::numeric_limits<double>::infinity(),
                     const Segmentation& segmentation = {});

/// A line from one height to another over a range, in segments that grow from the observer: heights
/// on the straight chord over a spherical earth. Defined and smooth for any two heights, unlike
/// sight_line(), which needs an angle.
///
/// segments  0: the number of chord_segments(), converged to 2 mK in every band
///           (tests/render/radiance_test.cpp)
SightLine chord(double from_height_km, double to_height_km, double range_km, int segments = 0);
int chord_segments(double height_change_km);

/// Joins two paths into one, `far` beginning where `near` ends: light that follows both meets the
/// air of both. Either may be empty; ends are known only if both paths have them.
SightLine joined(const SightLine& near, const SightLine& far);

/// Whether a line of infinite range ends on the ground.
bool meets_ground(double height_km, double zenith_deg);

/// Refractivity of dry air, (n − 1) = 77.6e-6 P/T [hPa, K]: that of infrared light, 2 % low in the
/// visible; water vapour skipped (Edlén; Hill's term for vapour is below 1 % beyond 1 µm).
double refractivity(const Profile& profile, double height_km);

/// The same lines bent by the profile's refraction: n r sin(zenith) is the same at all ends of
/// segments (Bouguer). Zenith angles are those seen at the start. Light from outside the air is
/// bent as in Bennett (1982) to 2 %, 3 % at the horizon (tests/materials/sight_line_test.cpp).
SightLine refracted_line(const Profile& profile, double height_km, double zenith_deg,
                         double range_km = std::numeric_limits<double>::infinity(),
                         const Segmentation& segmentation = {});
bool meets_ground(const Profile& profile, double height_km, double zenith_deg);

}  // namespace diurna
