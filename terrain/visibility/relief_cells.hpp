#pragma once

#include <Eigen/Core>
#include <vector>

#include "terrain/facets.hpp"
#include "terrain/raster/grid.hpp"
#include "terrain/visibility/copies.hpp"
#include "terrain/visibility/octants.hpp"

namespace diurna {

/// Cells [first, last] of a square lattice over the plan.
struct CellBox {
    int first_column, last_column, first_row, last_row;
};

/// Data for SkyBound, on a lattice of square cells with about four facets each: the steepness of
/// the relief in a cell, and the highest point in it.
///
/// A cell is relief if every facet that touches it faces up, has corners that are completely
/// surrounded by their facets, and is the only one over the cell's middle. Cells with folds, walls,
/// roofs above or the mesh's edge are not relief.
struct ReliefCells {
    Eigen::Vector2f corner = Eigen::Vector2f::Zero();  // south-west [m]
    float side = 1.0f;                                 // of a cell [m]
    std::vector<Grid> top;           // highest vertex [m]; cells of `side`, then of twice that, ...
    std::vector<ByOctant> steepest;  // (row, column) tangents; infinite outside the relief

    /// Time and memory are linear in the facets; without facets, or with
    /// many long slivers, no bound is stored. Copies count as their
    /// boxes.
    explicit ReliefCells(const FacetSet& facets, const Copies& copies = {});
    bool known() const { return !steepest.empty(); }

    CellBox cells_of(const Eigen::Vector2f& low, const Eigen::Vector2f& high) const;

 private:
    bool fill(const FacetSet& facets);
    void raise_by(const FacetSet& facets, const Copies& copies);
    void stack_tops();
};

}  // namespace diurna
