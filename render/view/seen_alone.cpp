#include "render/view/seen_alone.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr double most_pixels = 4e6;
constexpr double furthest = 1e6;  // [pixels] from the picture's corner that anybody counts

}  // namespace

SeenAlone seen_alone(const Observer& observer, const RayScene& alone, const PictureBox& box) {
    const PixelRays eye = pixel_rays(observer);
    const auto first = [](double edge) {
        return static_cast<std::int64_t>(std::floor(std::clamp(edge, -furthest, furthest)));
    };
    const std::int64_t left = first(box.left), right = first(box.right) + 1;
    const std::int64_t top = first(box.top), bottom = first(box.bottom) + 1;
    const std::int64_t width = observer.width, height = observer.height;
    const double pixels = double(right - left) * double(bottom - top);
    const auto stride =
        static_cast<std::int64_t>(std::ceil(std::sqrt(std::max(1.0, pixels / most_pixels))));
    const auto rows = static_cast<std::size_t>((bottom - top + stride - 1) / stride);
    const auto ray_at = [&](std::int64_t column, std::int64_t row) {
        const double x = double(column) + 0.5, y = double(row) + 0.5;
        const Eigen::Vector3d from = observer.position + eye.start(x, y);
        return Ray{.origin = from.cast<float>(), .direction = eye.towards(x, y).cast<float>()};
    };
    // The box of a pinhole at rest is exact, and may end where the object does not.
    const bool exact = eye.flat && eye.row_way.isZero() && eye.row_turn.isZero();
    const auto beyond = [&](std::int64_t column, std::int64_t row) {
        const double x = double(column) + 0.5, y = double(row) + 0.5;
        return exact && (x < box.left || x > box.right || y < box.top || y > box.bottom);
    };
    const auto met = [&](const std::vector<Ray>& rays) {
        std::vector<Hit> hits(rays.size());
        alone.closest(rays, hits);
        return std::count_if(hits.begin(), hits.end(),
                             [](const Hit& hit) { return hit.facet != no_facet; });
    };
    std::vector<std::int64_t> outside(rows);
    for_each_index(
        rows,
        [&](std::size_t r) {
            const std::int64_t row = top + std::int64_t(r) * stride + stride / 2;
            std::vector<Ray> rays;
            const bool on_rows = row >= 0 && row < height;
            for (std::int64_t c = left + stride / 2; c < right; c += stride) {
                const bool in_picture = on_rows && c >= 0 && c < width;
                if (!in_picture && !beyond(c, row)) rays.push_back(ray_at(c, row));
            }
            outside[r] = met(rays);
        },
        4);
    // In the picture every pixel, as masks are counted.
    const std::int64_t from = std::max<std::int64_t>(0, top), to = std::min(height, bottom);
    std::vector<std::int64_t> inside(
        static_cast<std::size_t>(std::max<std::int64_t>(0, to - from)));
    for_each_index(
        inside.size(),
        [&](std::size_t r) {
            std::vector<Ray> rays;
            for (std::int64_t c = std::max<std::int64_t>(0, left); c < std::min(width, right);
                 ++c) {
                rays.push_back(ray_at(c, from + std::int64_t(r)));
            }
            inside[r] = met(rays);
        },
        4);
    const double each = double(stride) * double(stride);
    SeenAlone seen;
    for (const std::int64_t count : inside) seen.inside += double(count);
    for (const std::int64_t count : outside) seen.outside += each * double(count);
    return seen;
}

}  // namespace diurna
