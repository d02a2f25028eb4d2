#pragma once

#include <Eigen/Core>

#include "terrain/ground/cut_network.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/raster/dem.hpp"

namespace diurna {

/// Where triangles are fine, and how their size grows away from there.
struct Grading {
    Ring ring;            // (column, row)
    double edge = 1.0;    // [m] of triangles on the ring
    double growth = 0.5;  // [m/m] of their edges with distance from it
    enum class Side { outside, inside };
    Side side = Side::outside;  // of the ring, that is graded
    bool filled = false;        // the other side has that edge length too
    std::uint32_t number = 1;   // from 1; another for each call
};

/// Inserts vertices until the triangles around a ring have edges of at most about `edge` + `growth`
/// × distance [m], as far as triangles are larger than that. Middles of neighbouring triangles with
/// edges s are 0.58 s apart, so that with a growth of 0.5 a triangle's size is at most 1.3 times
/// its neighbour's. An advancing front: a vertex makes a triangle of that size on the shortest edge
/// of one that is too large (Rebay 1993), or is the circumcentre of a sliver (Ruppert 1995). Lines
/// of the network are kept, and divided where a vertex would be too close to them.
///
/// Angles of new triangles are at least 20 degrees in (column, row), except where lines of the
/// network, posts or the borders of finer triangles meet at smaller ones.
///
/// - spacing: of columns and rows [m]; heights are the raster's; no vertex over voids
void grade_round(const Grading& grading, const Dem& dem, const Eigen::Vector2d& spacing,
                 cut::Constrained& network);

}  // namespace diurna
