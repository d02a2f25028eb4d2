#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/scene_light.hpp"
#include "render/path/background_table.hpp"
#include "render/path/scattered_path.hpp"
#include "render/rays/air_lanes.hpp"
#include "render/rays/angle_table.hpp"
#include "render/rays/channel_lanes.hpp"
#include "render/rays/facet_lanes.hpp"
#include "render/rays/plume.hpp"
#include "render/rays/secondary_options.hpp"
#include "render/rays/secondary_rays.hpp"

namespace diurna {

/// The background in mirrors as it arrives at the eye, divided by the transmittance of the air in
/// front of them, at a few ranges of the mirrors.
struct MirroredBackground {
    std::vector<std::vector<BackgroundChannels>> at;  // (range)(band): 0, 1, 3 or 5 ranges
    double root_low = 0.0, root_step = 1.0;           // of range^⅓ [m^⅓]
};

/// Tables for the secondary rays of a view at an instant that do not depend on the pixel, in the
/// channels of all bands side by side (lanes), so that a secondary ray's table position is computed
/// once for all of them.
struct SecondaryTables {
    /// - light: of a scene whose lit facets include those of the secondary rays, surfaces_of(),
    ///   from index `first` on
    SecondaryTables(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                    const SceneLight& light, std::size_t first, const SecondaryOptions& options);
    SecondaryTables(const SecondaryTables&) = delete;  // its tables refer to each other

    const SecondaryRays& secondary_rays;
    const SceneLight& light;
    const LitFacets& lit;
    const RadianceInput& input;
    SecondaryOptions options;
    std::size_t first;
    std::vector<SurfaceId> facet;       // met by the secondary rays
    std::vector<std::uint32_t> target;  // (secondary ray) index of its facet above
    const std::vector<BandLight>& band;
    ChannelLanes lanes;
    FacetLanes facet_lanes;
    AirLanes air;
    std::vector<AngleTable> angle;               // (material), where needed
    std::vector<std::vector<float>> room;        // (material)(lane) τ B of the room behind
    std::vector<std::vector<float>> absorption;  // (plume)(lane) [m⁻¹]
    std::vector<std::vector<float>> glow;        // (plume)(lane) B(T)
    /// (height of LitFacets)(lane) irradiance of the sun, without and with the circumsolar light
    std::array<std::vector<float>, 3> sun, sun_and_aureole;
    std::vector<BackgroundChannels> from_eye;  // (band), if some secondary ray sees it
    MirroredBackground mirrored;
    /// (band) sunlight scattered in front of points on the line of sight
    std::vector<std::optional<ScatteredPath>> scattered_path;

    /// Radiance of the background in a direction, (lane), seen directly.
    void background_towards(const Eigen::Vector3d& direction, std::span<float> out) const;
    /// The same in a mirror at a range [m]: what arrives at the eye, with both parts of the path
    /// joined, divided by the transmittance of the air in front of the mirror.
    void mirrored_background(const Eigen::Vector3d& direction, float range,
                             std::span<float> out) const;
    /// Index of a target among the lit facets.
    std::uint32_t lit_index(std::uint32_t of_target) const { return lit.target[first + of_target]; }
    const Material& material(const SecondaryRay& secondary) const {
        return input.materials[input.facets.material[secondary.what]];
    }
    /// Whether a secondary ray is a facet that reflects into a lobe (rough_mirror.hpp).
    bool is_rough_mirror(const SecondaryRay& secondary) const;

 private:
    void fill_materials();
    void fill_plumes(std::span<const Plume> plumes);
    void fill_backgrounds();
    void fill_mirrored(const BackgroundChannels::Extent& extent);
    void include_lobe(const SecondaryRay& secondary, BackgroundChannels::Extent& extent) const;
    bool shows_sky(const SecondaryRay& secondary) const;
    double mirror_height_km() const;
    std::array<double, 2> mirror_ranges() const;
    void fill_scattered_paths(const PathExtent& extent);
};

}  // namespace diurna
