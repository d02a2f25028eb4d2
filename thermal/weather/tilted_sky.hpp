#pragma once

#include <vector>

namespace diurna {

/// What a facet tilted by `slope` [rad] receives from the part of the sky it sees, beyond its sky
/// view times the horizontal's flux, per σT⁴ of the air. The clear sky's emissivity grows towards
/// the horizon as ε(z) = ε + b (ln sec z − ½), b = 0.09 (Unsworth & Monteith 1975, Q. J. R.
/// Meteorol. Soc. 101, 13). Where terrain hides more than the facet's own tilt, it hides the
/// horizon first: a ring of one height all around. Zero for a level facet under the whole sky,
/// ½ b (1 − V) ln(1 − V) for one that sees V, ½ b ln 2 = 0.031 for a wall (12 W/m²).
double tilted_sky_excess(double slope, double sky_view = 1.0);

/// The same for many facets, from a table: within 1e-4 of it.
class TiltedSky {
 public:
    TiltedSky();
    double excess(double up_cosine, double sky_view) const;

 private:
    struct Tilt {
        std::vector<double> view, excess;  // (ring) up to there from the zenith
    };
    static Tilt tilt_of(double slope);
    static double at(const Tilt& tilt, double share);
    friend double tilted_sky_excess(double slope, double sky_view);
    std::vector<Tilt> tilt_;  // every two degrees from 0 to 180
};

}  // namespace diurna
