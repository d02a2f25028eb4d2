#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "render/rays/secondary_tables.hpp"

namespace diurna {

/// Lobe integrals of rough mirrors (rough metal, gloss, water under wind) over their surroundings,
/// in lanes:
///
///     L = R(θ) Σ a F(χ) L(ω) / Σ a F(χ)
///
/// summed over microfacets, a their weight, F their reflectance at the angle of incidence χ. L(ω)
/// is the background (sky, far plain) or, below the horizon of a facet that sees others, the mean
/// of the light from those. Rays into the lobe then only add the difference of their hits from
/// that: a mirror on open ground has no noise.
///
/// Facets of one material and one normal share a table over the direction to the eye if it has
/// fewer nodes than there are secondary rays; else each secondary ray is integrated separately.
/// Exact for isothermal surroundings.
class RoughMirrors {
 public:
    explicit RoughMirrors(const SecondaryTables& tables);

    /// Whether a secondary ray is a rough mirror.
    bool has(const SecondaryRay& secondary) const;
    /// Normal of a secondary ray's facet towards the eye; that of water is vertical.
    Eigen::Vector3d normal(const SecondaryRay& secondary) const;
    /// Whether the mean of the surrounding facets is used in a direction, not the background.
    bool around_towards(const SecondaryRay& mirror, const Eigen::Vector3d& direction) const;

    /// Rows of lanes of a secondary ray, weights of 0 to 1 times radiance.
    enum Row : std::size_t {
        reflected,  // Σ a F over the number of microfacets
        sky,        // Σ a F L of the background, without air in front of it
        around,     // Σ a F where the mean of the surrounding facets replaces L
        row_count
    };
    /// - out: (row, lane)
    void look(const SecondaryRay& secondary, float* out) const;

 private:
    /// Facets of one material and normal, and a table over the direction from them to the eye: in
    /// the plane (θ cosφ, θ sinφ), θ from the normal, φ about it.
    struct Group {
        MaterialId material{};
        bool sees_facets = false;  // below the horizon, each of them
        Eigen::Vector3d normal;    // towards the eye
        Eigen::Vector3d x, y;      // tangential; x towards the mean eye direction
        double distance = 0.0;     // [m] of the eye from the facets' planes, mean
        std::array<double, 2> low{}, step{};
        std::array<std::size_t, 2> nodes{};  // 0: no table
        std::vector<float> value;            // (node, node, row, lane)
    };
    using Point = std::array<double, 2>;
    void find_groups();
    void lay_out(Group& group, std::span<const std::uint32_t> secondary_rays) const;
    void fill(Group& group) const;
    void sum(const Group& group, const Eigen::Vector3d& to_eye, float range, float* out) const;
    /// Index of a secondary ray among all.
    std::size_t place(const SecondaryRay& secondary) const;

    const SecondaryTables& tables_;
    std::vector<Group> group_;
    std::vector<std::int32_t> group_of_;  // (facet of SecondaryTables, side) −1: no rough mirror
};

}  // namespace diurna
