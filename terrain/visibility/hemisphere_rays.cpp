#include "terrain/visibility/hemisphere_rays.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "materials/base/random.hpp"
#include "terrain/visibility/lifted_facet.hpp"

namespace diurna {

namespace {

constexpr std::size_t width = 16;

}  // namespace

HemisphereRays::HemisphereRays(int rays, std::uint64_t seed)
    : rays_(static_cast<std::size_t>(rays)), seed_(seed) {
    std::tie(columns_, rows_) = nearly_square(rays);
    // In blocks of 4 × 4 cells, so that a packet's rays go roughly the same way.
    for (int y0 = 0; y0 < rows_; y0 += 4) {
        for (int x0 = 0; x0 < columns_; x0 += 4) {
            for (int y = y0; y < std::min(rows_, y0 + 4); ++y) {
                for (int x = x0; x < std::min(columns_, x0 + 4); ++x) {
                    column_.push_back(static_cast<float>(x));
                    row_.push_back(static_cast<float>(y));
                }
            }
        }
    }
    column_.resize(width * packets(), 0.0f);
    row_.resize(width * packets(), 0.0f);
}

void HemisphereRays::fill(const FacetSet& facets, std::size_t facet, std::size_t packet,
                          RayPacket& rays) const {
    const LiftedFacet from(facets, facet);
    const auto [along_d, across_d] = tangents(from.normal);
    const Eigen::Vector3f along = along_d.cast<float>(), across = across_d.cast<float>(),
                          normal = facets.normal[facet];
    const std::uint64_t key = hashed(seed_ ^ hashed(facet)), start = hashed(key);
    const auto jitter = static_cast<std::uint32_t>(key);
    const auto start_x = static_cast<std::uint32_t>(start);
    const auto start_y = static_cast<std::uint32_t>(start >> 32);
    const Eigen::Vector3f corner = from.corner.cast<float>(), to_b = from.to_b.cast<float>(),
                          to_c = from.to_c.cast<float>();
    const float* column = &column_[width * packet];
    const float* row = &row_[width * packet];
    const float across_cell = 2.0f / static_cast<float>(columns_);
    const float down_cell = 2.0f / static_cast<float>(rows_);
    const auto first = static_cast<std::uint32_t>(width * packet);
    constexpr float quarter = std::numbers::pi_v<float> / 4.0f;

#pragma omp simd
    for (std::uint32_t i = 0; i < width; ++i) {
        const std::uint32_t k = first + i;
        // A point of the facet: the square's far half folds back onto the triangle.
        const float p =
            static_cast<float>(static_cast<int>((start_x + even_step32_x * k) >> 8)) * 0x1p-24f;
        const float q =
            static_cast<float>(static_cast<int>((start_y + even_step32_y * k) >> 8)) * 0x1p-24f;
        const float to_p = p + q > 1.0f ? 1.0f - p : p, to_q = p + q > 1.0f ? 1.0f - q : q;
        rays.origin_x[i] = corner.x() + to_p * to_b.x() + to_q * to_c.x();
        rays.origin_y[i] = corner.y() + to_p * to_b.y() + to_q * to_c.y();
        rays.origin_z[i] = corner.z() + to_p * to_b.z() + to_q * to_c.z();
        const std::uint32_t random = spread_bits(jitter + golden_step32 * k);
        // In the middle of 2^-16 of a cell, so never on its edge.
        const float u = (static_cast<float>(static_cast<int>(random & 0xFFFFu)) + 0.5f) * 0x1p-16f;
        const float v = (static_cast<float>(static_cast<int>(random >> 16)) + 0.5f) * 0x1p-16f;
        const float a = (column[i] + u) * across_cell - 1.0f;
        const float b = (row[i] + v) * down_cell - 1.0f;
        // The square to the disc, equal areas to equal areas (Shirley & Chiu 1997). The angle from
        // the nearer axis is at most 45°, where four terms of sine and cosine are good to 3e-7.
        const bool flat = std::abs(a) > std::abs(b);
        const float radius = flat ? a : b, less = flat ? b : a;
        const float t = quarter * (less / (radius == 0.0f ? 1.0f : radius)), s = t * t;
        const float sine = t * (1.0f - s * (1.0f / 6 - s * (1.0f / 120 - s * (1.0f / 5040))));
        const float cosine =
            1.0f - s * (0.5f - s * (1.0f / 24 - s * (1.0f / 720 - s * (1.0f / 40320))));
        const float x = radius * (flat ? cosine : sine), y = radius * (flat ? sine : cosine);
        const float z = std::sqrt(1.0f - radius * radius);
        rays.direction_x[i] = x * along.x() + y * across.x() + z * normal.x();
        rays.direction_y[i] = x * along.y() + y * across.y() + z * normal.y();
        rays.direction_z[i] = x * along.z() + y * across.z() + z * normal.z();
    }
}

}  // namespace diurna
