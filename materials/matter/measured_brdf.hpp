#pragma once

#include <Eigen/Core>
#include <vector>

#include "materials/matter/finish.hpp"

namespace diurna {

/// The BRDF f of an isotropic surface as a table [sr⁻¹], the same at all wavelengths: a material's
/// spectrum gives the reflectance at 10°, the table its angular distribution. Linear between the
/// nodes, constant outside.
struct MeasuredBrdf {
    /// Meaning of the axes [deg].
    enum class Axes {
        directions,  // of light and eye from the normal, and between their azimuths:
                     // 0 on the same side, 180 mirrored
        half_vector  // Rusinkiewicz 1998: of the half vector from the normal, of the light from the
                     // half vector, and about it, 0 to 180
    };
    Axes axes = Axes::directions;
    std::vector<double> first, second, third;  // ascending
    std::vector<float> value;                  // (first, second, third)
    double at_ten = 0.0;                       // directional-hemispherical reflectance at 10°
    double mean = 0.0;                         // over the hemisphere, ∫ R(θ) 2 cosθ d cosθ
};

/// f [sr⁻¹] between two unit vectors above a surface whose normal is z.
double brdf(const MeasuredBrdf& table, const Eigen::Vector3d& eye, const Eigen::Vector3d& light);

/// ∫ f cosθ dω over the lights for an eye at a cosine, by midpoints over half vectors, denser near
/// the normal: lobes of 0.5° and more within 0.5 %, smooth surfaces within 0.1 %.
double directional_hemispherical(const MeasuredBrdf& table, double cosine);

/// The finish of a table: its directional-hemispherical reflectances over that at 10°, with the
/// table. Sets at_ten and mean.
ByAngle finish_of(MeasuredBrdf table);

/// Ratio of f to the value from the factors alone, ρ g(eye) g(light) / π ḡ: 1 without a measured
/// table.
double measured_lobe(const Finish& finish, const Eigen::Vector3d& normal,
                     const Eigen::Vector3d& eye, const Eigen::Vector3d& light);

}  // namespace diurna
