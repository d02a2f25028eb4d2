#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "materials/radiation/spectrum.hpp"
#include "terrain/visibility/ray_scene.hpp"

namespace diurna {

/// Gas or smoke of one temperature and density inside a closed mesh. It emits and absorbs by
/// Beer-Lambert's law along the chord, τ = exp(−k(λ) s), without scattering; it neither shades nor
/// warms the scene.
struct Plume {
    std::string name;
    std::vector<Eigen::Vector3d> vertex;                 // east, north, up [m]
    std::vector<std::array<std::uint32_t, 3>> triangle;  // counterclockwise seen from outside
    Spectrum absorption;                                 // k [m⁻¹], constant outside its range
    double temperature = 300.0;                          // [K]

    double absorption_at(double wavelength_um) const;
};

/// A column of smoke: a frustum between two level circles of `sides` corners.
///
/// base        centre of the lower circle
/// lean        offset of the upper circle's centre from it, east and north [m]
std::vector<Eigen::Vector3d> frustum_vertices(const Eigen::Vector3d& base, double base_radius,
                                              double top_radius, double height,
                                              const Eigen::Vector2d& lean, int sides);
std::vector<std::array<std::uint32_t, 3>> frustum_triangles(int sides);

/// Part of a ray within a plume.
struct Chord {
    std::uint32_t plume;
    double from, to;  // [m] along the ray
};

/// All plumes of a scene, prepared for rays. Throws InputError for a mesh that is not closed.
class PlumeScene {
 public:
    explicit PlumeScene(std::span<const Plume> plumes);

    /// The chords of a ray up to `far`, by their start. A ray may start inside.
    std::vector<Chord> chords(const Eigen::Vector3d& origin, const Eigen::Vector3d& direction,
                              double far) const;
    /// A sphere around each plume: centre and radius.
    struct Sphere {
        Eigen::Vector3d middle;
        double radius;
    };
    std::span<const Sphere> spheres() const { return spheres_; }
    /// [m⁻¹] of a plume, maximum over all wavelengths
    double greatest_absorption(std::uint32_t plume) const { return greatest_[plume]; }

 private:
    std::vector<double> greatest_;
    FacetSet facets_;  // object: index of the plume
    std::unique_ptr<RayScene> rays_;
    std::vector<Sphere> spheres_;
};

}  // namespace diurna
