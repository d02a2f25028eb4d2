#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace diurna {

/// How alike two places of a clutter are at a distance r: exp(−r/l), the first-order Markov law
/// that thermal pictures of natural ground were found to follow, with grey levels near the normal
/// distribution (Itakura, Tsutsumi, Takagi 1974, Infrared Physics 14; Ben-Yosef et al. 1985,
/// Applied Optics 24), or exp(−r²/l²), without detail finer than l.
enum class Covariance { exponential, gaussian };

struct ClutterSpec {
    double length = 10.0;  // l [m]: the correlation there is 1/e
    Covariance covariance = Covariance::exponential;
    std::uint64_t seed = 1;
};

/// One lattice of a clutter: variance · exp(−r²/length²) of its covariance at a distance r.
struct ClutterOctave {
    double length;    // [m]
    double variance;  // of all octaves they add up to 1
};
std::vector<ClutterOctave> clutter_octaves(const ClutterSpec& spec);

/// A Gaussian random field over the plane, mean 0, standard deviation 1, the same from every
/// direction: a function of (seed, place) alone, whatever mesh or picture asks for it.
///
/// Normal deviates on square lattices (a hash of seed, octave, column and row), smoothed with a
/// Gaussian. One lattice makes exp(−r²/l²) to 1e-3; exp(−r/l) is the mixture of seven of them in
/// octaves from 4 l to l/16, e^(−r/l) = ∫ t^(−3/2) e^(−1/4t) e^(−t r²/l²) dt / 2√π by the
/// trapezoidal rule in ln t: within 0.015 of the law from l/8 on; nearer, where the law has a cusp,
/// smooth. Measured: tests/terrain/clutter_test.cpp.
class Clutter {
 public:
    explicit Clutter(const ClutterSpec& spec);

    /// x, y     [m] within 1e6 lengths of the origin
    /// spacing  [m] between this place and the next one asked for: what is finer is averaged away
    ///          as over a square of that side
    double at(double x, double y, double spacing = 0.0) const;
    double length() const { return length_; }

 private:
    struct Octave {
        double length;     // [m]
        double amplitude;  // squares add up to 1
        std::uint64_t seed;
    };
    std::vector<Octave> octave_;
    double length_;
};

}  // namespace diurna
