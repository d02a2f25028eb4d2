#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace diurna {

/// Correlation of a clutter at two places a distance r apart: exp(−r/l), the first-order Markov law
/// that was found for thermal pictures of natural ground, with nearly normal distribution of grey
/// levels (Itakura, Tsutsumi, Takagi 1974, Infrared Physics 14; Ben-Yosef et al. 1985, Applied
/// Optics 24), or exp(−r²/l²), without detail finer than l.
enum class Covariance { exponential, gaussian };

struct ClutterSpec {
    double length = 10.0;  // l [m]: correlation 1/e at this distance
    Covariance covariance = Covariance::exponential;
    std::uint64_t seed = 1;
};

/// One lattice of a clutter, with covariance variance · exp(−r²/length²) at a distance r.
struct ClutterOctave {
    double length;    // [m]
    double variance;  // the variances of all octaves add up to 1
};
std::vector<ClutterOctave> clutter_octaves(const ClutterSpec& spec);

/// A Gaussian random field over the plane, mean 0, standard deviation 1, isotropic: a function of
/// (seed, place) only, the same for every mesh and picture.
///
/// Normal deviates on square lattices (a hash of seed, octave, column and row), smoothed with a
/// Gaussian. One lattice gives exp(−r²/l²) to 1e-3; exp(−r/l) is a sum of seven of them in octaves
/// from 4 l to l/16, e^(−r/l) = ∫ t^(−3/2) e^(−1/4t) e^(−t r²/l²) dt / 2√π by the trapezoidal rule
/// in ln t: within 0.015 of the law from l/8 on; smooth at shorter distances, where the law has a
/// cusp. Measured: tests/terrain/clutter_test.cpp.
class Clutter {
 public:
    explicit Clutter(const ClutterSpec& spec);

    /// x, y     [m] within 1e6 lengths of the origin
    /// spacing  [m] to the next place requested: finer detail is averaged as over a square of that
    ///              side
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
