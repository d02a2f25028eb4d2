#include "terrain/ground/dem_detail.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "terrain/ground/rings.hpp"
#include "terrain/raster/crs.hpp"
#include "terrain/raster/dem_places.hpp"
#include "terrain/raster/dem_window.hpp"
#include "terrain/raster/geotransform.hpp"

namespace diurna {

namespace {

constexpr double reported_from = 1.0;  // [m] of a step between the two

/// From the lattice of one raster to that of another: on one map straight, else by PROJ.
LatticeMap between(const Dem& from, const Dem& to, const Eigen::Vector2d& low,
                   const Eigen::Vector2d& high) {
    using Places = std::span<const Eigen::Vector2d>;
    if (same_reference(from.crs_wkt, to.crs_wkt)) {
        return lattice_map(low, high, [&](Places places) {
            std::vector<Eigen::Vector2d> there;
            for (const Eigen::Vector2d& p : places) {
                const Eigen::Vector2d at =
                    map_place(from.transform, Eigen::Vector2d(p.array() + 0.5));
                there.emplace_back(pixel_at(to.transform, at.x(), at.y()).array() - 0.5);
            }
            return there;
        });
    }
    return lattice_map(low, high, [&](Places places) {
        const std::vector<float> height(places.size(), 0.0f);
        return raster_places(to, geodetic_places(from, places, height));
    });
}

Eigen::Vector2d last_post(const Dem& dem) { return {dem.columns - 1.0, dem.rows - 1.0}; }

/// The posts of the border, one after the other.
Ring border_posts(const Dem& dem) {
    const int right = dem.columns - 1, bottom = dem.rows - 1;
    Ring ring;
    for (int column = 0; column < right; ++column) ring.emplace_back(column, 0);
    for (int row = 0; row < bottom; ++row) ring.emplace_back(right, row);
    for (int column = right; column > 0; --column) ring.emplace_back(column, bottom);
    for (int row = bottom; row > 0; --row) ring.emplace_back(0, row);
    return ring;
}

/// The border of a detail on the coarse raster; no points if it lies wholly outside.
Ring outline_of(const Dem& fine, const Dem& dem) {
    const LatticeMap to_coarse = between(fine, dem, {0.0, 0.0}, last_post(fine));
    Ring ring = border_posts(fine);
    for (Eigen::Vector2d& p : ring) {
        p = to_coarse(p);
        if (!p.allFinite()) return {};
    }
    ring = clipped(std::move(ring), dem.columns, dem.rows);
    if (ring.size() < 3) return {};
    // Along the coarse raster's edge there are but the ends.
    const RingExtent extent(ring);
    const LatticeMap to_own = between(dem, fine, extent.low, extent.high);
    Ring dense;
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector2d from = ring[i], step = ring[(i + 1) % ring.size()] - from;
        const double apart = (to_own(from + step) - to_own(from)).norm();
        if (apart < 1e-6) continue;
        const int parts = std::max(1, int(std::ceil(apart - 1e-3)));
        for (int k = 0; k < parts; ++k) dense.push_back(from + step * (double(k) / parts));
    }
    return dense;
}

/// What of a raster lies on the coarse one, and a post more all round.
PostWindow window_on(const Dem& fine, const LatticeMap& to_own, const Ring& outline) {
    Ring own;
    for (const Eigen::Vector2d& p : outline) own.push_back(to_own(p));
    const RingExtent extent(own);
    const auto first = [](double x) { return std::max(0, int(std::floor(x + 1e-6)) - 1); };
    const auto last = [](double x, int count) {
        return std::min(count - 1, int(std::ceil(x - 1e-6)) + 1);
    };
    const int column = first(extent.low.x()), row = first(extent.low.y());
    return {column, row, last(extent.high.x(), fine.columns) - column + 1,
            last(extent.high.y(), fine.rows) - row + 1};
}

/// Blends the border into the raster below; the median of fine − coarse over the strip.
///
/// - to_border: of (column, row), distance [m] from the raster's border as it was in its file
template <class Distance>
double blend_border(DemDetail& detail, const Dem& below, double width, const Distance& to_border) {
    Dem& raster = detail.raster;
    std::vector<float> step;
    for (int row = 0; row < raster.rows; ++row) {
        for (int column = 0; column < raster.columns; ++column) {
            const double away = to_border(column, row);
            if (away > 0.0 && away >= width) continue;
            const double coarse = height_at(below, detail.to_coarse(Eigen::Vector2d(column, row)));
            if (std::isnan(coarse)) continue;  // beyond it, where nothing is to be joined
            float& height = raster.height[std::size_t(row) * raster.columns + column];
            const double t = away > 0.0 ? away / width : 0.0;
            const double share = t * t * (3.0 - 2.0 * t);
            step.push_back(static_cast<float>(height - coarse));
            height = static_cast<float>(share * height + (1.0 - share) * coarse);
        }
    }
    if (step.empty()) return 0.0;
    const auto middle = step.begin() + std::ptrdiff_t(step.size() / 2);
    std::nth_element(step.begin(), middle, step.end());
    return *middle;
}

/// Gives the coarse posts whose cells lie wholly on the last detail its heights.
void sample_detail(Dem& dem) {
    const int last = int(dem.detail.size()) - 1;
    const LatticeMap& map = dem.detail.back().to_own;
    const auto first_post = [](double x) { return std::max(0, int(std::floor(x))); };
    const int left = first_post(map.low.x()), top = first_post(map.low.y());
    const int right = std::min(dem.columns - 1, int(std::ceil(map.high.x())));
    const int bottom = std::min(dem.rows - 1, int(std::ceil(map.high.y())));
    const auto lies_on = [&](int column, int row) {
        return column < 0 || row < 0 || column >= dem.columns || row >= dem.rows ||
               detail_at(dem, Eigen::Vector2d(column, row)) == last;
    };
    std::vector<std::pair<std::size_t, float>> taken;
    for (int row = top; row <= bottom; ++row) {
        for (int column = left; column <= right; ++column) {
            bool whole = true;
            for (int k = 0; k < 9 && whole; ++k) {
                whole = lies_on(column + k % 3 - 1, row + k / 3 - 1);
            }
            if (!whole) continue;
            taken.emplace_back(std::size_t(row) * dem.columns + column,
                               height_at(dem, Eigen::Vector2d(column, row)));
        }
    }
    for (const auto& [post, height] : taken) dem.height[post] = height;
}

}  // namespace

void lay_detail(Dem& dem, Dem fine, const DetailOptions& options) {
    if (has_voids(fine)) {
        throw InputError(fine.source, "has posts without elevation, which a detail cannot have",
                         "set voids = \"fill\"");
    }
    const Eigen::Vector2d spacing = post_spacing(fine), coarse_spacing = post_spacing(dem);
    if (spacing.prod() > coarse_spacing.prod()) {
        throw InputError(
            fine.source,
            fmt::format("has posts {:.3g} m apart, {} {:.3g} m; a detail must be finer",
                        spacing.maxCoeff(), dem.source, coarse_spacing.maxCoeff()));
    }
    const Eigen::Vector2d size = last_post(fine).cwiseProduct(spacing);
    if (2.0 * options.blend > size.minCoeff()) {
        throw InputError(
            fine.source,
            fmt::format("is {:.3g} m wide, less than the two blending strips of {:g} m",
                        size.minCoeff(), options.blend),
            "reduce blend_m");
    }
    DemDetail detail{.raster = {}, .to_own = {}, .to_coarse = {}, .outline = outline_of(fine, dem)};
    if (detail.outline.size() < 3) {
        throw InputError(fine.source, "is entirely outside " + dem.source);
    }
    const RingExtent extent(detail.outline);
    const PostWindow window =
        window_on(fine, between(dem, fine, extent.low, extent.high), detail.outline);
    const Eigen::Vector2d first(window.column, window.row), last = last_post(fine);
    crop(fine, window);
    fine.voids = std::size_t(std::count(fine.is_void.begin(), fine.is_void.end(), 1));
    detail.to_own = between(dem, fine, extent.low, extent.high);
    detail.to_coarse = between(fine, dem, {0.0, 0.0}, last_post(fine));
    detail.raster = std::move(fine);
    detail.tolerance = options.tolerance;
    const double step = blend_border(detail, dem, options.blend, [&](int column, int row) {
        const Eigen::Vector2d at = first + Eigen::Vector2d(column, row);
        return std::min(at.cwiseProduct(spacing).minCoeff(),
                        (last - at).cwiseProduct(spacing).minCoeff());
    });
    if (std::abs(step) >= reported_from) {
        dem.notes.push_back(fmt::format(
            "{}: is {:.1f} m {} {} in the blending strip (median): check vertical_datum and "
            "height_unit of both",
            detail.raster.source, std::abs(step), step > 0.0 ? "above" : "below", dem.source));
    }
    for (const std::string& note : detail.raster.notes) dem.notes.push_back(note);
    for (const Mistake& one : detail.raster.warnings) dem.warnings.push_back(one);
    dem.detail.push_back(std::move(detail));
    sample_detail(dem);
}

}  // namespace diurna
