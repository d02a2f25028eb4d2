#include "terrain/visibility/receiver_views.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "materials/base/parallel.hpp"
#include "terrain/visibility/block_rays.hpp"
#include "terrain/visibility/hemisphere_rays.hpp"
#include "terrain/visibility/lifted_facet.hpp"
#include "terrain/visibility/sky_basis.hpp"

namespace diurna {

namespace {

/// One receiver's row.
struct ReceiverRow {
    float sky = 0.0f, below = 0.0f, hidden = 0.0f;
    SkyShares shares{};
    std::map<std::uint32_t, double> factor{};  // by facet of the scene
};

ReceiverRow row_of(const FacetSet& receivers, std::size_t r, const HemisphereRays& rays,
                   const FacetSet& facets, const RayScene& scene,
                   const ReceiverViewOptions& options) {
    BlockRays found(scene, facets, options.ground_facets, true, options.sunlight);
    RayPacket packet;
    for (std::size_t p = 0; p < rays.packets(); ++p) {
        rays.fill(receivers, r, p, packet);
        found.trace(packet, rays.lanes(p), 0, SkyBound::unknown);
    }
    found.finish();
    const double weight = 1.0 / options.rays;
    ReceiverRow row{.sky = float(weight * found.sky[0]),
                    .below = float(weight * found.below[0]),
                    .hidden = float(weight * found.hidden[0])};
    for (const BlockRays::Seen& seen : found.seen) {
        row.factor[scene.copies().at(seen.met).facet] += weight * double{seen.share};
    }
    const SkyVector open = open_plane(receivers.normal[r]);
    for (std::size_t k = 1; k < sky_functions; ++k) {
        row.shares[k - 1] = float(double{open[k]} - weight * double{found.covered[0][k]});
    }
    row.shares =
        with_sky_view(row.shares, receivers.normal[r],
                      double{open[0]} - weight * double{found.covered[0][0]}, double{row.sky});
    return row;
}

}  // namespace

FacetSet receiver_facets(std::span<const Receiver> receivers) {
    constexpr double area = 1e-4;                                        // [m²]
    const double radius = std::sqrt(area * 4.0 / 3.0 / std::sqrt(3.0));  // of its three corners
    FacetSet facets;
    for (const Receiver& receiver : receivers) {
        const auto [u, v] = tangents(receiver.normal);
        const auto first = static_cast<std::uint32_t>(facets.vertex.size());
        for (int k = 0; k < 3; ++k) {
            const double angle = 2.0 * M_PI * k / 3.0;
            const Eigen::Vector3d corner =
                receiver.place + radius * (std::cos(angle) * u + std::sin(angle) * v);
            facets.vertex.push_back(corner.cast<float>());
        }
        const bool left = u.cross(v).dot(receiver.normal) > 0.0;
        facets.corner.push_back({first, first + (left ? 1u : 2u), first + (left ? 2u : 1u)});
        facets.centroid.push_back(receiver.place.cast<float>());
        facets.normal.push_back(receiver.normal.cast<float>());
        facets.area.push_back(float(area));
        facets.material.push_back(MaterialId{0});
        facets.object.push_back(ObjectId{0});
    }
    return facets;
}

FacetViews receiver_views(std::span<const Receiver> receivers, const FacetSet& facets,
                          const RayScene& scene, const ReceiverViewOptions& options) {
    const FacetSet own = receiver_facets(receivers);
    const HemisphereRays rays(options.rays, options.seed);
    std::vector<ReceiverRow> rows(receivers.size());
    for_each_index(
        receivers.size(),
        [&](std::size_t r) { rows[r] = row_of(own, r, rays, facets, scene, options); }, 1);
    FacetViews views;
    views.others.row.push_back(0);
    for (const ReceiverRow& row : rows) {
        views.sky.push_back(row.sky);
        views.below.push_back(row.below);
        views.hidden.push_back(row.hidden);
        views.shares.push_back(row.shares);
        for (const auto& [facet, factor] : row.factor) {
            views.others.facet.push_back(facet);
            views.others.factor.push_back(float(factor));
        }
        views.others.row.push_back(static_cast<std::uint32_t>(views.others.facet.size()));
    }
    return views;
}

}  // namespace diurna
