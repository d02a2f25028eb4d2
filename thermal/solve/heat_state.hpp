#pragma once

#include <cstddef>
#include <vector>

#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// The heat in all facets at an instant: what a solve leaves at the end of its span and another of
/// the same facets and materials goes on from.
struct HeatState {
    /// Of a facet that is solved by itself (thermal/solve/point_facets.hpp).
    struct Point {
        std::size_t facet;
        std::vector<double> u;  // (node), see NonlinearColumn
        Standing standing;
        double snow_albedo;
    };
    double reference = 0.0;                  // [K] that states of columns count from
    std::vector<float> kelvin;               // (facet) of surfaces
    std::vector<std::vector<double>> block;  // (block) [state][lane], see Block::start
    /// (block)(lane) whose they are: blocks are put together by how much wind and which air facets
    /// have, which changes where something moves. Not in files; empty: the solve's own blocks.
    std::vector<std::vector<std::size_t>> of_block{};
    std::vector<Point> point;
    std::vector<std::vector<double>> network{};  // (target) [K] its nodes, then its lumps
};

}  // namespace diurna
