#include "terrain/relief/smooth_normals.hpp"

#include <Eigen/Geometry>
#include <array>
#include <unordered_map>

namespace diurna {

namespace {

constexpr float crease = 0.9f;  // cosine

/// Of a place in its triangle: (corner) weight.
std::array<float, 3> barycentric(const FacetSet& facets, const PlaceOnFacet& at) {
    const auto& corner = facets.corner[at.facet];
    const Eigen::Vector3f& normal = facets.normal[at.facet];
    std::array<float, 3> weight{};
    for (std::size_t c = 0; c < 3; ++c) {
        const Eigen::Vector3f& b = facets.vertex[corner[(c + 1) % 3]];
        const Eigen::Vector3f& d = facets.vertex[corner[(c + 2) % 3]];
        weight[c] = (b - at.place).cross(d - at.place).dot(normal) / (2.0f * facets.area[at.facet]);
    }
    return weight;
}

}  // namespace

std::vector<Eigen::Vector3f> smooth_normals(const FacetSet& facets, std::size_t ground,
                                            std::span<const PlaceOnFacet> places) {
    std::unordered_map<std::uint32_t, std::vector<std::uint32_t>> around;  // vertex: facets
    for (const PlaceOnFacet& at : places) {
        for (const std::uint32_t v : facets.corner[at.facet]) around[v];
    }
    for (std::uint32_t f = 0; f < ground; ++f) {
        for (const std::uint32_t v : facets.corner[f]) {
            if (const auto found = around.find(v); found != around.end())
                found->second.push_back(f);
        }
    }
    std::vector<Eigen::Vector3f> normals;
    for (const PlaceOnFacet& at : places) {
        const Eigen::Vector3f own = facets.normal[at.facet];
        const std::array<float, 3> weight = barycentric(facets, at);
        Eigen::Vector3f sum = Eigen::Vector3f::Zero();
        for (std::size_t c = 0; c < 3; ++c) {
            Eigen::Vector3f mean = Eigen::Vector3f::Zero();
            for (const std::uint32_t f : around.at(facets.corner[at.facet][c])) {
                if (facets.normal[f].dot(own) > crease) mean += facets.area[f] * facets.normal[f];
            }
            sum += weight[c] * mean.normalized();
        }
        normals.push_back(sum.normalized());
    }
    return normals;
}

}  // namespace diurna
