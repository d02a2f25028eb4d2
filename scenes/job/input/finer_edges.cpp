#include "scenes/job/input/finer_edges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <vector>

namespace diurna {

namespace {

constexpr double own_edges = 100.0;  // [m] Placing::largest_edge of a model by its detail

/// Exceeded by a twentieth of a mesh's edges, in its own unit.
double long_edge(const MeshFile& mesh) {
    std::vector<double> edge;
    for (const auto& corner : mesh.triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            edge.push_back((mesh.vertex[corner[k]] - mesh.vertex[corner[(k + 1) % 3]]).norm());
        }
    }
    if (edge.empty()) return own_edges;
    const auto place = edge.begin() + static_cast<std::ptrdiff_t>(edge.size() * 19 / 20);
    std::nth_element(edge.begin(), place, edge.end());
    return *place;
}

}  // namespace

void divide_tolerances(double finer, ElevationInput& elevation) {
    elevation.tolerance /= finer * finer;
    for (DetailInput& detail : elevation.details) detail.tolerance /= finer * finer;
}

void divide_edges(double finer, TerrainInput& terrain) {
    if (finer == 1.0) return;
    terrain.coarsest /= finer * finer;
    for (GroundPolygon& polygon : terrain.polygons) polygon.largest_edge /= finer;
    for (Building& building : terrain.buildings) {
        building.largest_edge /= finer;
        building.foot_edge /= finer;
    }
    for (ShapesInput& shapes : terrain.shapes) shapes.largest_edge /= finer;
    std::map<const MeshFile*, double> long_edge_of;  // copies share a mesh
    for (ObjectInput& object : terrain.objects) {
        object.finer_edges = finer;
        double& edge = object.placing.largest_edge;
        if (edge >= own_edges) {
            const auto [found, added] = long_edge_of.try_emplace(object.mesh.get(), 0.0);
            if (added) found->second = long_edge(*object.mesh);
            edge = std::min(edge, found->second * object.placing.metres);
        }
        edge /= finer;
    }
}

}  // namespace diurna
