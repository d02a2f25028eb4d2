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

/// What SkyBound has to know of the facets, on a lattice of square cells with about four facets
/// each: how steep the relief is in a cell, and how high anything stands there.
///
/// A cell is relief if every facet that touches it looks up, has corners that are closed round
/// about by their facets, and alone covers the cell's middle. Folds, walls, roofs above and the
/// mesh's edge are none.
struct ReliefCells {
    Eigen::Vector2f corner = Eigen::Vector2f::Zero();  // south-west [m]
    float side = 1.0f;                                 // of a cell [m]
    std::vector<Grid> top;           // highest vertex [m]; cells of `side`, then twice as wide, ...
    std::vector<ByOctant> steepest;  // (row, column) tangents; infinite where there is no relief

    /// Work and memory are linear in the facets; without facets, or with long slivers all over the
    /// place, nothing is known.
    /// Copies count as what their boxes are.
    explicit ReliefCells(const FacetSet& facets, const Copies& copies = {});
    bool known() const { return !steepest.empty(); }

    CellBox cells_of(const Eigen::Vector2f& low, const Eigen::Vector2f& high) const;

 private:
    bool fill(const FacetSet& facets);
    void raise_by(const FacetSet& facets, const Copies& copies);
    void stack_tops();
};

}  // namespace diurna
