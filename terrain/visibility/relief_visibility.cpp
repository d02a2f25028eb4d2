#include "terrain/visibility/relief_visibility.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/base/random.hpp"
#include "materials/base/units.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

namespace {

constexpr double points_per_cell = 6.0;
constexpr int most_points = 64;
constexpr float coarse_cells = 2.0f;
constexpr int sky_azimuths = 32;
constexpr float sky_reach = 1e-3f;  // objects that hide less sky are left to the exchange's rays
constexpr std::size_t facets_per_block = 1024;
const double sun_radius = sun_angular_radius;

/// Share of the disc above a straight edge x radii below its centre.
class DiscTable {
 public:
    DiscTable() {
        for (int i = 0; i <= cells; ++i) {
            const double x = 2.0 * i / cells - 1.0;
            share_[std::size_t(i)] = static_cast<float>(
                1.0 - (std::acos(x) - x * std::sqrt(1.0 - x * x)) / std::numbers::pi);
        }
        share_[cells + 1] = 1.0f;
    }
    float operator()(float x) const {
        const float at = std::clamp(0.5f * (x + 1.0f), 0.0f, 1.0f) * cells;
        const auto i = static_cast<std::size_t>(at);
        return share_[i] + (at - static_cast<float>(i)) * (share_[i + 1] - share_[i]);
    }

 private:
    static constexpr int cells = 256;
    std::array<float, cells + 2> share_{};
};

/// π/2 − atan(t) − t/(1 + t²), t ≥ 0: the part of a slope's sky that the Lambert cosine adds. Its
/// derivative is −2/(1 + t²)², so a table over t/(1 + t) is smooth.
class SlopeTable {
 public:
    SlopeTable() {
        for (int i = 0; i <= cells; ++i) {
            const double s = double(i) / cells, t = s < 1.0 ? s / (1.0 - s) : 1e12;
            value_[std::size_t(i)] = static_cast<float>(std::atan2(1.0, t) - t / (1.0 + t * t));
        }
        value_[cells + 1] = 0.0f;
    }
    float operator()(float t) const {
        const float at = t / (1.0f + t) * cells;
        const auto i = static_cast<std::size_t>(at);
        return value_[i] + (at - static_cast<float>(i)) * (value_[i + 1] - value_[i]);
    }

 private:
    static constexpr int cells = 1024;
    std::array<float, cells + 2> value_{};
};

/// One azimuth's share of the sky, times π: above the horizon and the own plane.
float sky_slice(const SlopeTable& slope, const Eigen::Vector3f& normal, const Eigen::Vector2f& way,
                float tangent) {
    const float along = normal.head<2>().dot(way);
    if (normal.z() <= 1e-4f) {  // a wall's own plane ends at the zenith
        return along > 0.0f ? along * slope(tangent) : 0.0f;
    }
    const float t = std::max(tangent, -along / normal.z());
    return normal.z() / (1.0f + t * t) + along * slope(t);
}

}  // namespace

ReliefVisibility::ReliefVisibility(const FacetSet& facets, const RayScene& rays,
                                   const HeightField& relief, std::size_t ground_facets)
    : facets_(facets), rays_(rays), relief_(relief), ground_facets_(ground_facets) {
    assert(ground_facets <= facets.size());
    always_.assign(facets.size(), 0);
    std::fill(always_.begin() + static_cast<std::ptrdiff_t>(ground_facets), always_.end(), 1);
    coarse_.assign(ground_facets, 0);
    first_point_.reserve(ground_facets + 1);
    std::vector<Eigen::Vector2d> place(facets.vertex.size());
    for_each_index(place.size(), [&](std::size_t v) {
        place[v] = relief.post(facets.vertex[v].head<2>().cast<double>());
    });
    for (std::size_t f = 0; f < ground_facets; ++f) {
        const auto& [a, b, c] = facets.corner[f];
        add_points(f, {place[a], place[b], place[c]});
    }
    first_point_.push_back(static_cast<std::uint32_t>(point_.size()));
    raise_objects();
}

/// `corner`: in (column, row).
void ReliefVisibility::add_points(std::size_t facet, const std::array<Eigen::Vector2d, 3>& corner) {
    first_point_.push_back(static_cast<std::uint32_t>(point_.size()));
    const Eigen::Vector2d b = corner[1] - corner[0], c = corner[2] - corner[0];
    const double cells = 0.5 * std::abs(b.x() * c.y() - b.y() * c.x());
    coarse_[facet] = cells > coarse_cells;
    const int points =
        static_cast<int>(std::clamp(std::round(points_per_cell * cells), 1.0, double(most_points)));
    for (int k = 0; k < points; ++k) {
        // Roberts' sequence, evenly over the triangle; a single point in its middle.
        double u = 4.0 / 9.0, v = 0.5;
        if (points > 1) {
            u = std::fmod(0.5 + even_step_x * k, 1.0);
            v = std::fmod(0.5 + even_step_y * k, 1.0);
        }
        const double root = std::sqrt(u);
        const Eigen::Vector2d p = corner[0] + (1.0 - root) * b + root * v * c;
        const double x = std::clamp(p.x(), 0.0, relief_.columns() - 1.0);
        const double y = std::clamp(p.y(), 0.0, relief_.rows() - 1.0);
        const int column = std::min(static_cast<int>(x), relief_.columns() - 2);
        const int row = std::min(static_cast<int>(y), relief_.rows() - 2);
        point_.push_back({static_cast<std::uint32_t>(row * relief_.columns() + column),
                          static_cast<float>(x - column), static_cast<float>(y - row)});
        if ((p - Eigen::Vector2d(x, y)).norm() > 0.5) always_[facet] = 1;
        for (int i = 0; i < 4; ++i) {
            if (relief_.up(row + i / 2, column + i % 2) == no_ground) always_[facet] = 1;
        }
    }
}

/// Every post round a cell that an object's box touches, and one more, goes up to the object's top:
/// whatever the object may shade, this does too.
void ReliefVisibility::raise_objects() {
    if (ground_facets_ == facets_.size()) return;
    struct Extent {
        Eigen::Vector2d low = Eigen::Vector2d::Constant(1e30);
        Eigen::Vector2d high = Eigen::Vector2d::Constant(-1e30);
        float top = -1e30f;
    };
    std::map<ObjectId, Extent> objects;
    for (std::size_t f = ground_facets_; f < facets_.size(); ++f) {
        Extent& extent = objects[facets_.object[f]];
        for (const std::uint32_t corner : facets_.corner[f]) {
            const Eigen::Vector3f& v = facets_.vertex[corner];
            const Eigen::Vector2d p = relief_.post(v.head<2>().cast<double>());
            extent.low = extent.low.cwiseMin(p);
            extent.high = extent.high.cwiseMax(p);
            extent.top = std::max(extent.top, v.z());
        }
    }
    const int columns = relief_.columns(), rows = relief_.rows();
    std::vector<float> up(relief_.size());
    std::vector<std::uint8_t> touched(relief_.size(), 0);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const float h = relief_.up(row, column);
            up[std::size_t(row) * columns + column] = h == no_ground ? std::nanf("") : h;
        }
    }
    for (const auto& [id, extent] : objects) {
        const auto first = [](double x) { return std::max(0, int(std::floor(x)) - 1); };
        const int last_column = std::min(columns - 1, int(std::ceil(extent.high.x())) + 1);
        const int last_row = std::min(rows - 1, int(std::ceil(extent.high.y())) + 1);
        for (int row = first(extent.low.y()); row <= last_row; ++row) {
            for (int column = first(extent.low.x()); column <= last_column; ++column) {
                float& h = up[std::size_t(row) * columns + column];
                if (!(h >= extent.top)) h = extent.top;
                touched[std::size_t(row) * columns + column] = 1;
            }
        }
    }
    for (std::size_t f = 0; f < ground_facets_; ++f) {
        for (std::size_t k = first_point_[f]; k < first_point_[f + 1]; ++k) {
            const std::size_t post = point_[k].post;
            if (touched[post] || touched[post + 1] || touched[post + columns] ||
                touched[post + columns + 1]) {
                always_[f] = 1;
            }
        }
    }
    raised_.emplace(relief_.with_heights(up));
}

float ReliefVisibility::at(const Point& p, const std::vector<float>& tangent) const {
    const float* first = tangent.data() + p.post;
    const float* second = first + relief_.columns();
    const float upper = first[0] + p.u * (first[1] - first[0]);
    const float lower = second[0] + p.u * (second[1] - second[0]);
    return upper + p.v * (lower - upper);
}

Eigen::Vector3f ReliefVisibility::grid_normal(const Point& p) const {
    const int row = static_cast<int>(p.post) / relief_.columns();
    const int column = static_cast<int>(p.post) % relief_.columns();
    const float a = relief_.up(row, column), d = relief_.up(row + 1, column + 1);
    const float b = relief_.up(row, column + 1), c = relief_.up(row + 1, column);
    const Eigen::Vector2d slope =
        p.u >= p.v ? Eigen::Vector2d(b - a, d - b) : Eigen::Vector2d(d - c, c - a);
    const Eigen::Vector2d gradient =
        relief_.jacobian({column + 0.5, row + 0.5}).transpose().inverse() * slope;
    return Eigen::Vector3d(-gradient.x(), -gradient.y(), 1.0).normalized().cast<float>();
}

/// The horizons at all posts round a facet's points.
ReliefVisibility::Span ReliefVisibility::around(std::size_t facet,
                                                const std::vector<float>& tangent) const {
    Span span{1e30f, -1e30f};
    const auto columns = std::size_t(relief_.columns());
    for (std::size_t k = first_point_[facet]; k < first_point_[facet + 1]; ++k) {
        const float* first = tangent.data() + point_[k].post;
        for (const float t : {first[0], first[1], first[columns], first[columns + 1]}) {
            span.low = std::min(span.low, t);
            span.high = std::max(span.high, t);
        }
    }
    return span;
}

bool ReliefVisibility::objects_matter(std::size_t facet, const Tangents& tangents) const {
    if (!raised_) return false;
    const auto columns = std::size_t(relief_.columns());
    for (std::size_t k = first_point_[facet]; k < first_point_[facet + 1]; ++k) {
        for (const std::size_t post : {std::size_t{point_[k].post}, point_[k].post + std::size_t{1},
                                       point_[k].post + columns, point_[k].post + columns + 1}) {
            if (tangents.raised[post] > tangents.relief[post]) return true;
        }
    }
    return false;
}

ReliefVisibility::Tangents ReliefVisibility::tangents_near(const Eigen::Vector3d& direction) const {
    Tangents tangents;
    tangents.relief.resize(relief_.size());
    horizon_near(relief_, direction, sun_radius, tangents.relief);
    if (raised_) {
        tangents.raised.resize(relief_.size());
        horizon_near(*raised_, direction, sun_radius, tangents.raised);
    }
    return tangents;
}

std::size_t ReliefVisibility::sun_fraction(const Eigen::Vector3d& direction,
                                           std::span<float> fraction,
                                           const SunFractionOptions& options) const {
    assert(fraction.size() == facets_.size());
    if (direction.z() <= 0.0) {
        std::fill(fraction.begin(), fraction.end(), 0.0f);
        return 0;
    }
    static const DiscTable disc;
    const Tangents tangents = tangents_near(direction);
    const Eigen::Vector3f sun = direction.cast<float>();
    const double elevation = std::asin(direction.z());
    const auto radius = static_cast<float>(sun_radius);
    const auto tan_sun =
        static_cast<float>(direction.z() / std::max(1e-6, direction.head<2>().norm()));
    const auto whole_disc = static_cast<float>(std::tan(elevation - sun_radius));
    const auto no_disc =
        static_cast<float>(std::tan(std::min(elevation + sun_radius, 0.5 * std::numbers::pi)));
    // The tangent of the angle between: as good as the angle within the disc.
    const auto radii = [&](float tangent) {
        return (tan_sun - tangent) / ((1.0f + tan_sun * tangent) * radius);
    };
    const auto mean_light = [&](std::size_t f) {
        float sum = 0.0f;
        for (std::size_t k = first_point_[f]; k < first_point_[f + 1]; ++k) {
            const float seen = disc(radii(at(point_[k], tangents.relief)));
            if (seen > 0.0f) sum += seen * std::max(0.0f, grid_normal(point_[k]).dot(sun));
        }
        return sum / static_cast<float>(first_point_[f + 1] - first_point_[f]);
    };

    std::vector<std::uint8_t> rays = always_;
    for_each_block(ground_facets_, facets_per_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            if (rays[f]) continue;
            fraction[f] = 0.0f;
            const float cosine = facets_.normal[f].dot(sun);
            if (cosine <= -radius) continue;
            if (coarse_[f] && !objects_matter(f, tangents)) {
                if (cosine > 0.0f) fraction[f] = mean_light(f) / cosine;
                continue;
            }
            const Span horizon = around(f, tangents.relief);
            if (horizon.low >= no_disc) continue;
            if (horizon.high <= whole_disc && !objects_matter(f, tangents)) {
                fraction[f] = disc(cosine / radius);
            } else {
                rays[f] = 1;
            }
        }
    });
    diurna::sun_fraction(facets_, rays_, direction, rays, fraction, options);
    return static_cast<std::size_t>(std::count(rays.begin(), rays.end(), std::uint8_t{1}));
}

FacetViews ReliefVisibility::facet_views(const FacetViewOptions& options) const {
    static const SlopeTable slope;
    FacetViews view = diurna::facet_views(facets_, rays_, options);
    std::vector<float> seen(ground_facets_, 0.0f), below_objects(ground_facets_, 0.0f);
    Tangents tangents;
    tangents.relief.resize(relief_.size());
    if (raised_) tangents.raised.resize(relief_.size());
    for (int i = 0; i < sky_azimuths; ++i) {
        const double azimuth_deg = 360.0 * (i + 0.5) / sky_azimuths;
        const Eigen::Vector2f way = direction(azimuth_deg, 0.0).head<2>().cast<float>();
        horizon(relief_, azimuth_deg, tangents.relief);
        if (raised_) horizon(*raised_, azimuth_deg, tangents.raised);
        for_each_block(ground_facets_, facets_per_block, [&](std::size_t begin, std::size_t end) {
            for (std::size_t f = begin; f < end; ++f) {
                if (always_[f]) continue;
                const float points = static_cast<float>(first_point_[f + 1] - first_point_[f]);
                for (std::size_t k = first_point_[f]; k < first_point_[f + 1]; ++k) {
                    const Eigen::Vector3f normal =
                        coarse_[f] ? grid_normal(point_[k]) : facets_.normal[f];
                    seen[f] +=
                        sky_slice(slope, normal, way, at(point_[k], tangents.relief)) / points;
                    if (!raised_) continue;
                    below_objects[f] +=
                        sky_slice(slope, normal, way, at(point_[k], tangents.raised)) / points;
                }
            }
        });
    }
    for_each_block(ground_facets_, facets_per_block, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
            if (always_[f]) continue;
            if (raised_ && seen[f] - below_objects[f] > sky_reach * sky_azimuths) continue;
            const float sky = std::clamp(seen[f] / sky_azimuths, 0.0f, 1.0f);
            const float rest = 1.0f - view.sky[f];
            view.sky[f] = sky;
            if (rest <= 0.0f) {
                view.below[f] = 1.0f - sky;
                continue;
            }
            const float scale = (1.0f - sky) / rest;
            view.below[f] *= scale;
            for (auto k = view.others.row[f]; k < view.others.row[f + 1]; ++k) {
                view.others.factor[k] *= scale;
            }
        }
    });
    return view;
}

}  // namespace diurna
