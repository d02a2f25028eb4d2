#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "terrain/ground/detail_outline.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem.hpp"
#include "terrain/raster/dem_places.hpp"

namespace diurna {

/// A raster whose posts become vertices of a mesh over the coarse raster's (column, row): the
/// coarse raster itself, or a detail of it.
struct MeshLattice {
    const Dem* raster;
    const DemDetail* detail;              // null: the coarse one
    Eigen::Vector2d spacing;              // [m]
    std::vector<std::uint8_t> is_vertex;  // (post)

    Eigen::Vector2d to_own(const Eigen::Vector2d& coarse) const {
        return detail != nullptr ? detail->to_own(coarse) : coarse;
    }
    Eigen::Vector2d to_coarse(const Eigen::Vector2d& own) const {
        return detail != nullptr ? detail->to_coarse(own) : own;
    }
    std::size_t index(int column, int row) const {
        return std::size_t(row) * std::size_t(raster->columns) + std::size_t(column);
    }
};

/// The coarse raster's lattice, then those of its details, without vertices.
inline std::vector<MeshLattice> mesh_lattices(const Dem& dem) {
    std::vector<MeshLattice> all{{&dem, nullptr, post_spacing(dem), {}}};
    for (const DemDetail& detail : dem.detail) {
        all.push_back({&detail.raster, &detail, post_spacing(detail.raster), {}});
    }
    for (MeshLattice& one : all) one.is_vertex.assign(one.raster->height.size(), 0);
    return all;
}

/// Index of the lattice at a place.
inline std::size_t lattice_at(const Dem& dem, const Eigen::Vector2d& place) {
    return dem.detail.empty() ? 0 : std::size_t(detail_at(dem, place) + 1);
}

/// Index for a whole ring; the coarse one if the ring is on several.
inline std::size_t lattice_under(const Dem& dem, const Ring& ring) {
    const std::size_t first = lattice_at(dem, ring.front());
    for (const Eigen::Vector2d& p : ring) {
        if (lattice_at(dem, p) != first) return 0;
    }
    return first;
}

/// Whether the vertices at a place are posts of that lattice: no other lattice covers it, and no
/// outline is near.
inline bool takes_vertex(const Dem& dem, const Eigen::Vector2d& place, std::size_t lattice) {
    return lattice_at(dem, place) == lattice && !beside_outline(dem, place);
}

/// A place converted from a detail, moved onto the coarse raster's edge if rounding put it off.
inline Eigen::Vector2d on_edge(const Dem& dem, Eigen::Vector2d place) {
    constexpr double rounding = 1e-6;  // [posts]
    const Eigen::Vector2d last(dem.columns - 1.0, dem.rows - 1.0);
    for (int axis = 0; axis < 2; ++axis) {
        if (place[axis] < rounding) place[axis] = 0.0;
        if (place[axis] > last[axis] - rounding) place[axis] = last[axis];
    }
    return place;
}

}  // namespace diurna
