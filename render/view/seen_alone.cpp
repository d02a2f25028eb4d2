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

struct Counts {
    std::int64_t inside = 0, outside = 0;
};

}  // namespace

SeenAlone seen_alone(const Observer& observer, const RayScene& alone, const PictureBox& box) {
    const PixelRays eye = pixel_rays(observer);
    const auto first = [](double edge) {
        return static_cast<std::int64_t>(std::floor(std::clamp(edge, -furthest, furthest)));
    };
    const std::int64_t left = first(box.left), right = first(box.right) + 1;
    const std::int64_t top = first(box.top), bottom = first(box.bottom) + 1;
    const double pixels = double(right - left) * double(bottom - top);
    const auto stride =
        static_cast<std::int64_t>(std::ceil(std::sqrt(std::max(1.0, pixels / most_pixels))));
    const auto rows = static_cast<std::size_t>((bottom - top + stride - 1) / stride);
    std::vector<Counts> of_row(rows);
    for_each_index(
        rows,
        [&](std::size_t r) {
            const std::int64_t row = top + std::int64_t(r) * stride + stride / 2;
            std::vector<Ray> rays;
            std::vector<std::int64_t> column;
            for (std::int64_t c = left + stride / 2; c < right; c += stride) {
                const double x = double(c) + 0.5, y = double(row) + 0.5;
                const Eigen::Vector3d from = observer.position + eye.start(x, y);
                rays.push_back(
                    {.origin = from.cast<float>(), .direction = eye.towards(x, y).cast<float>()});
                column.push_back(c);
            }
            std::vector<Hit> hits(rays.size());
            alone.closest(rays, hits);
            const bool on_rows = row >= 0 && row < observer.height;
            for (std::size_t i = 0; i < hits.size(); ++i) {
                if (hits[i].facet == no_facet) continue;
                const bool in = on_rows && column[i] >= 0 && column[i] < observer.width;
                ++(in ? of_row[r].inside : of_row[r].outside);
            }
        },
        4);
    SeenAlone seen;
    const double each = double(stride) * double(stride);
    for (const Counts& counts : of_row) {
        seen.inside += each * double(counts.inside);
        seen.outside += each * double(counts.outside);
    }
    return seen;
}

}  // namespace diurna
