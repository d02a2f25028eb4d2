#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/ground/tin_check.hpp"
#include "terrain/relief/height_field.hpp"
#include "terrain/texture/texture_levels.hpp"
#include "terrain/visibility/copies.hpp"

namespace diurna {

/// An object whose facets form a thermal network (scenes/job/world/targets.hpp), and its
/// parts.
struct TargetFacets {
    std::size_t object;                                      // of the scene's
    ObjectId id;                                             // of its facets
    std::map<MaterialId, std::size_t> part{};                // materials of its parts, each its own
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // from the object's frame
};

/// An object that moves along a trajectory.
struct Mover {
    std::size_t object;       // of the scene's
    ObjectId id;              // of its facets
    Eigen::Isometry3d start;  // from the object's frame, at the start of its trajectory
};

/// A ground facet at the raster's outline, and the length of its side there.
struct BorderFacet {
    std::uint32_t facet;
    float length;  // [m]
};

/// The geometry of a scene: every triangle with its material, in the frame of its site. Rays, sun
/// and sky use `facets`; heat and pictures use `surfaces()`, which are more if there are textures.
struct World {
    Site site;
    double sea_level_height = 0.0;  // of the frame's origin above the sea [m]
    FacetSet facets;
    std::vector<std::string> objects;     // (ObjectId)
    std::size_t posts = 0;                // of the elevation raster and its details
    std::size_t ground_facets = 0;        // the first ones; objects follow
    std::optional<HeightField> relief;    // the raster, for sun and sky on the ground
    std::vector<std::uint8_t> on_detail;  // (ground facet) 1: finer than `relief`; empty: none
    std::vector<BorderFacet> border;      // of the ground
    TinCheck ground_check;                // how far the mesh is from the raster's posts
    std::size_t filled_facets = 0;        // ground facets on posts void in the file
    std::vector<std::uint8_t> filled;     // (facet) 1 there; empty without filled ones
    TextureLevels texture_levels;         // facets after splitting by textures
    std::vector<TargetFacets> targets;    // objects with conduction between their facets
    std::vector<Mover> movers;            // moving objects, at the start of their trajectories
    Copies copies{};                      // objects that share the facets of another
    std::vector<std::string> notes;       // parts of files that were skipped

    const FacetSet& surfaces() const {
        return texture_levels.empty() ? facets : texture_levels.facets;
    }
    /// Whether a surface belongs to the ground, not to an object.
    bool on_ground(SurfaceId surface) const {
        return index(texture_levels.facet_of(surface)) < ground_facets;
    }
};

}  // namespace diurna
