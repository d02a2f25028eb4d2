#pragma once

#include <cstddef>
#include <vector>

#include "thermal/surface/standing_water.hpp"

namespace diurna {

/// The heat in all facets at an instant: the state at the end of a solve, from which another solve
/// of the same facets and materials can continue.
struct HeatState {
    /// Of a facet that is solved individually (thermal/solve/point_facets.hpp).
    struct Point {
        std::size_t facet;
        std::vector<double> u;  // (node), see NonlinearColumn
        Standing standing;
        double snow_albedo;
    };
    double reference = 0.0;                  // [K] zero of the columns' states
    std::vector<float> kelvin;               // (facet) of surfaces
    std::vector<std::vector<double>> block;  // (block) [state][lane], see Block::start
    /// (block)(lane) facet: blocks are formed by the wind and air of the facets, which changes if
    /// something moves. Not in files; empty: the solve's own blocks.
    std::vector<std::vector<std::size_t>> of_block{};
    std::vector<Point> point;
    std::vector<std::vector<double>> network{};  // (target) [K] its nodes, then its lumps
};

}  // namespace diurna
