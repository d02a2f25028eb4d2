#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "scenes/job/input/scene.hpp"
#include "scenes/job/world/world.hpp"
#include "terrain/ground/ground_mesh.hpp"
#include "terrain/ground/ring_index.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem.hpp"

/// Lines along which the ground of a scene is triangulated.
namespace diurna {

/// A building with walls on the ground.
struct WalledPlan {
    Ring ring;                 // counterclockwise; east, north [m]
    double height = 5.0;       // over the ground [m]
    double foot_edge = 0.5;    // of triangles on the ground at its walls, about [m]
    std::vector<Ring> hole{};  // courtyards, which are ground; clockwise
};

/// Cuts of the ground, lowest first: shapes from files, polygons of the scene, the plans of
/// buildings, and last the refinements around objects and walls, without material or object.
struct Cuts {
    static constexpr int nothing = -1;    // no ground
    static constexpr int courtyard = -2;  // the ground under the building, unchanged

    std::size_t first_building = 0;     // footprint; those before are ground
    std::vector<std::int32_t> of_plan;  // (plan) its footprint

    std::vector<Footprint> footprint;
    std::vector<std::string> material;  // (footprint) "": by land cover and rules
    std::vector<int> object;            // (footprint) 0 the ground, polygon i is i + 1

    void add(Footprint cut, std::string of_material, int of_object) {
        footprint.push_back(std::move(cut));
        material.push_back(std::move(of_material));
        object.push_back(of_object);
    }
    /// Rings of cuts that are not refinements.
    std::vector<Ring> owned() const;
    /// Those of them that are ground, even under buildings.
    std::vector<Ring> ground() const;
    bool is_patch(std::int32_t f) const { return f >= static_cast<std::int32_t>(object.size()); }
};

Cuts cuts_of(const Scene& scene, const Dem& dem, const World& world,
             std::span<const WalledPlan> buildings);

/// The cut of a triangle, −1 for none. A refinement around an object belongs to the ground below
/// it, a courtyard to the ground below the building.
///
/// - owners: of cuts.owned()
/// - ground: of cuts.ground()
std::int32_t cut_under(const Cuts& cuts, const RingIndex& owners, const RingIndex& ground,
                       const GroundMesh& mesh, std::size_t triangle);

/// The vertices around the triangles of one cut: outside counterclockwise, around its holes
/// clockwise; none unless they are simple lines.
std::vector<std::vector<std::uint32_t>> borders_of(const GroundMesh& mesh,
                                                   std::span<const std::int32_t> cut_of,
                                                   std::int32_t cut);

}  // namespace diurna
