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

/// The background as mirrors show it to the eye, over the transmittance of the air before them, at
/// a few ranges of theirs.
struct MirroredBackground {
    std::vector<std::vector<BackgroundChannels>> at;  // (range)(band): 0, 1, 3 or 5 ranges
    double root_low = 0.0, root_step = 1.0;           // of range^⅓ [m^⅓]
};

/// All that the secondary rays of a view need at an instant before any pixel is looked at, in the
/// channels of all bands side by side (lanes): so that a secondary ray's place in a table is found
/// once for all of them.
struct SecondaryTables {
    /// - light: of a scene whose lit facets were handed in with those of the secondary rays,
    /// facets_of(), from
    ///   the place `first` on
    SecondaryTables(const SecondaryRays& secondary_rays, std::span<const Plume> plumes,
                    const SceneLight& light, std::size_t first, const SecondaryOptions& options);
    SecondaryTables(const SecondaryTables&) = delete;  // its tables refer to each other

    const SecondaryRays& secondary_rays;
    const SceneLight& light;
    const LitFacets& lit;
    const RadianceInput& input;
    SecondaryOptions options;
    std::size_t first;
    std::vector<FacetId> facet;         // met by the secondary rays
    std::vector<std::uint32_t> target;  // (secondary ray) index of its facet above
    const std::vector<BandLight>& band;
    ChannelLanes lanes;
    FacetLanes facet_lanes;
    AirLanes air;
    std::vector<AngleTable> angle;               // (material), where needed
    std::vector<std::vector<float>> room;        // (material)(lane) τ B of the room behind
    std::vector<std::vector<float>> absorption;  // (plume)(lane) [m⁻¹]
    std::vector<std::vector<float>> glow;        // (plume)(lane) B(T)
    /// (height of LitFacets)(lane) irradiance of the sun, and with what is scattered next to it
    std::array<std::vector<float>, 3> sun, sun_and_aureole;
    std::vector<BackgroundChannels> from_eye;  // (band), where some secondary ray sees it
    MirroredBackground mirrored;
    /// (band) sunlight scattered before places on the line of sight
    std::vector<std::optional<ScatteredPath>> scattered_path;

    /// Radiance of the background in a direction, (lane), seen straight.
    void background_towards(const Eigen::Vector3d& direction, std::span<float> out) const;
    /// The same in a mirror at a range [m]: times the transmittance of the air before the mirror,
    /// what arrives at the eye, both ways being one path.
    void mirrored_background(const Eigen::Vector3d& direction, float range,
                             std::span<float> out) const;
    /// Index of a target among the facets lit.
    std::uint32_t lit_index(std::uint32_t of_target) const { return lit.target[first + of_target]; }
    const Material& material(const SecondaryRay& secondary) const {
        return input.materials[input.facets.material[secondary.what]];
    }
    /// Whether a secondary ray is a facet that mirrors into a lobe (rough_mirror.hpp).
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
