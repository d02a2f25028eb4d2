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
#include "render/rays/hops.hpp"
#include "render/rays/plume.hpp"

namespace diurna {

/// All that the hops of a view need at an instant before any pixel is looked at, in the channels of
/// all bands side by side (lanes): so that a hop's place in a table is found once for all of them.
struct HopTables {
    HopTables(const Hops& hops, std::span<const Plume> plumes, std::span<const Band> bands,
              const RadianceInput& input, int bounces, double tolerance);
    HopTables(const HopTables&) = delete;  // its tables refer to each other

    const Hops& hops;
    const RadianceInput& input;
    std::vector<FacetId> facet;         // met by the hops
    std::vector<std::uint32_t> target;  // (hop) index of its facet above
    LitFacets lit;
    SceneLight light;
    const std::vector<BandLight>& band;
    ChannelLanes lanes;
    FacetLanes facet_lanes;
    AirLanes air;
    std::vector<AngleTable> angle;               // (material), where needed
    std::vector<std::vector<float>> room;        // (material)(lane) τ B of the room behind
    std::vector<std::vector<float>> absorption;  // (plume)(lane) [m⁻¹]
    std::vector<std::vector<float>> glow;        // (plume)(lane) B(T)
    std::array<std::vector<float>, 3> sun;       // (height of LitFacets)(lane) irradiance
    std::vector<BackgroundChannels> from_eye, from_mirror;  // (band), where some hop sees it
    /// (band) sunlight scattered before places on the line of sight
    std::vector<std::optional<ScatteredPath>> scattered_path;

    /// Radiance of the background in a direction, (lane): seen straight, or in a mirror.
    void background_towards(const Eigen::Vector3d& direction, bool straight,
                            std::span<float> out) const;
    const Material& material(const Hop& hop) const {
        return input.materials[input.facets.material[hop.what]];
    }

 private:
    void fill_materials();
    void fill_plumes(std::span<const Plume> plumes);
    void fill_backgrounds();
    void fill_scattered_paths(const PathExtent& extent);
};

}  // namespace diurna
