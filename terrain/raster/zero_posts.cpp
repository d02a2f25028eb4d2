#include "terrain/raster/zero_posts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "materials/base/number_of.hpp"

namespace diurna {

namespace {

constexpr double least_jump = 100.0;  // [m]
constexpr double most_low = 0.05;     // share of an area's border with lower jumps
constexpr double over_usual = 4.0;    // times the usual steps

/// The step [m] between neighbouring posts that 95 % of them stay below, zeros not counted; from
/// about two million pairs.
double usual_step(const Dem& dem) {
    constexpr std::size_t enough = 1'000'000;
    const std::size_t posts = dem.height.size(), columns = std::size_t(dem.columns);
    const std::size_t stride = std::max<std::size_t>(1, posts / enough);
    std::vector<float> step;
    for (std::size_t i = 0; i + columns < posts; i += stride) {
        for (const std::size_t next : {i + 1, i + columns}) {
            const float here = dem.height[i], there = dem.height[next];
            const bool end_of_row = next == i + 1 && next % columns == 0;
            if (!end_of_row && here != 0.0f && there != 0.0f && std::isfinite(here - there)) {
                step.push_back(std::abs(here - there));
            }
        }
    }
    if (step.empty()) return 0.0;
    const auto at = step.begin() + std::ptrdiff_t(0.95 * double(step.size() - 1));
    std::nth_element(step.begin(), at, step.end());
    return double{*at};
}

/// A connected area of posts of exactly 0.
struct ZeroArea {
    std::size_t posts = 0;
    std::vector<float> jump;  // of the posts at its border [m]
};

/// Greatest distance [m] of a height within two posts from 0.
float jump_at(const Dem& dem, int row, int column) {
    float most = 0.0f;
    for (int r = std::max(0, row - 2); r <= std::min(dem.rows - 1, row + 2); ++r) {
        for (int c = std::max(0, column - 2); c <= std::min(dem.columns - 1, column + 2); ++c) {
            const float h = std::abs(dem.at(r, c));
            if (h > most) most = h;  // not for NaN
        }
    }
    return most;
}

/// The area around a post; marks its posts as seen.
ZeroArea area_from(const Dem& dem, std::size_t start, std::vector<std::uint8_t>& seen) {
    ZeroArea area;
    const auto columns = std::size_t(dem.columns);
    std::vector<std::size_t> front{start}, next;
    seen[start] = 1;
    while (!front.empty()) {
        next.clear();
        for (const std::size_t i : front) {
            ++area.posts;
            const int row = int(i / columns), column = int(i % columns);
            bool border = false;
            for (int r = std::max(0, row - 1); r <= std::min(dem.rows - 1, row + 1); ++r) {
                for (int c = std::max(0, column - 1); c <= std::min(dem.columns - 1, column + 1);
                     ++c) {
                    const std::size_t k = std::size_t(r) * columns + std::size_t(c);
                    const float h = dem.height[k];
                    border |= h != 0.0f && !std::isnan(h);
                    if (h == 0.0f && seen[k] == 0) {
                        seen[k] = 1;
                        next.push_back(k);
                    }
                }
            }
            if (border) area.jump.push_back(jump_at(dem, row, column));
        }
        front.swap(next);
    }
    return area;
}

/// Whether nearly all of its border has a jump of over `least` [m].
bool stands_apart(const ZeroArea& area, double least) {
    const auto low = std::count_if(area.jump.begin(), area.jump.end(),
                                   [&](float jump) { return !(double{jump} > least); });
    return !area.jump.empty() && double(low) <= most_low * double(area.jump.size());
}

}  // namespace

void warn_of_zero_posts(Dem& dem) {
    const auto zero = std::find(dem.height.begin(), dem.height.end(), 0.0f);
    if (zero == dem.height.end()) return;
    const double least = std::max(least_jump, over_usual * usual_step(dem));
    std::vector<std::uint8_t> seen(dem.height.size());
    std::size_t posts = 0;
    float lowest = 1e9f, highest = 0.0f;
    for (auto i = std::size_t(zero - dem.height.begin()); i < dem.height.size(); ++i) {
        if (dem.height[i] != 0.0f || seen[i] != 0) continue;
        const ZeroArea area = area_from(dem, i, seen);
        if (!stands_apart(area, least)) continue;
        posts += area.posts;
        for (const float jump : area.jump) {
            if (double{jump} > least) lowest = std::min(lowest, jump);
            highest = std::max(highest, jump);
        }
    }
    if (posts == 0) return;
    dem.warnings.push_back(
        {dem.source,
         fmt::format("{} ({:.2g} %) of exactly 0 m differ from the ground around them by {:.0f} to "
                     "{:.0f} m, expected heights or a declared no-data value",
                     number_of(posts, "post"), 100.0 * double(posts) / double(dem.height.size()),
                     lowest, highest),
         "if these are voids: gdal_translate -a_nodata 0 IN OUT.tif declares them, then voids = "
         "\"fill\" interpolates them; gdalwarp needs -dstnodata"});
}

}  // namespace diurna
