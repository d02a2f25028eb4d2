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

/// An object whose facets are one body of heat (scenes/world/targets.hpp): what of it is which
/// part.
struct TargetFacets {
    std::size_t object;                                      // of the scene's
    ObjectId id;                                             // of its facets
    std::map<MaterialId, std::size_t> part{};                // materials of its parts, each its own
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();  // from the object's frame
};

/// An object that goes along a trajectory.
struct Mover {
    std::size_t object;       // of the scene's
    ObjectId id;              // of its facets
    Eigen::Isometry3d start;  // from the object's frame, at its way's begin
};

/// A ground facet at the raster's outline, and how much of the outline is its side.
struct BorderFacet {
    std::uint32_t facet;
    float length;  // [m]
};

/// The scene in space: every triangle with its material, in the frame of its site. Rays, sun and
/// sky know `facets`; heat and pictures have `surfaces()`, which are more where there are textures.
struct World {
    Site site;
    double sea_level_height = 0.0;  // of the frame's origin above the sea [m]
    FacetSet facets;
    std::vector<std::string> objects;     // (ObjectId)
    std::size_t posts = 0;                // of the elevation raster and its details
    std::size_t ground_facets = 0;        // the first ones; objects follow
    std::optional<HeightField> relief;    // the raster, for sun and sky on the ground
    std::vector<std::uint8_t> on_detail;  // (ground facet) 1: finer than `relief`; empty: none is
    std::vector<BorderFacet> border;      // of the ground
    TinCheck ground_check;                // how far the mesh is from the raster's posts
    std::size_t filled_facets = 0;        // ground facets on posts void in the file
    std::vector<std::uint8_t> filled;     // (facet) 1 there; empty where there is none
    TextureLevels texture_levels;         // what textures make of the facets
    std::vector<TargetFacets> targets;    // objects whose facets conduct from one to the next
    std::vector<Mover> movers;            // objects that go, where their ways begin
    Copies copies{};                      // objects that share the facets of another
    std::vector<std::string> notes;       // what of the files was skipped

    const FacetSet& surfaces() const {
        return texture_levels.empty() ? facets : texture_levels.facets;
    }
};

}  // namespace diurna
