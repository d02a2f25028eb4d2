#include "terrain/visibility.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/units.hpp"
#include "terrain/parallel.hpp"
#include "terrain/sun.hpp"

namespace diurna {

namespace {

constexpr std::size_t facets_per_block = 128;

/// Bits that look random, a function of their argument alone (splitmix64).
std::uint64_t mixed(std::uint64_t x) {
    x += 0x9E3779B97F4A7C15ull;
    x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
    x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
    return x ^ (x >> 31);
}

/// A stream of uniform numbers in [0, 1) of one facet.
class Uniform {
 public:
    Uniform(std::uint64_t seed, std::size_t facet) : state_(mixed(seed ^ mixed(facet))) {}
    double operator()() {
        state_ = mixed(state_);
        return static_cast<double>(state_ >> 11) * 0x1p-53;
    }

 private:
    std::uint64_t state_;
};

/// The unit square to the unit disc, equal areas to equal areas, neighbours to neighbours
/// (Shirley & Chiu 1997).
Eigen::Vector2d to_disc(double u, double v) {
    const double a = 2.0 * u - 1.0, b = 2.0 * v - 1.0;
    if (a == 0.0 && b == 0.0) return {0.0, 0.0};
    constexpr double quarter = std::numbers::pi / 4.0;
    const bool flat = std::abs(a) > std::abs(b);
    const double radius = flat ? a : b;
    const double angle = flat ? quarter * (b / a) : 2.0 * quarter - quarter * (a / b);
    return {radius * std::cos(angle), radius * std::sin(angle)};
}

/// Two unit vectors at right angles to `normal` and to each other (Duff et al. 2017).
std::pair<Eigen::Vector3d, Eigen::Vector3d> tangents(const Eigen::Vector3d& n) {
    const double sign = std::copysign(1.0, n.z());
    const double a = -1.0 / (sign + n.z()), b = n.x() * n.y() * a;
    return {{1.0 + sign * n.x() * n.x() * a, sign * b, -sign * n.x()},
            {b, sign + n.y() * n.y() * a, -n.y()}};
}

/// Points spread over a facet, lifted off it by a few units in the last place of its coordinates,
/// so that no ray meets the facet it starts from.
class FacetPoints {
 public:
    FacetPoints(const FacetSet& facets, std::size_t facet)
        : normal_(facets.normal[facet].cast<double>()) {
        const auto& corner = facets.corner[facet];
        a_ = facets.vertex[corner[0]].cast<double>();
        to_b_ = facets.vertex[corner[1]].cast<double>() - a_;
        to_c_ = facets.vertex[corner[2]].cast<double>() - a_;
        const double coarse =
            a_.cwiseAbs().maxCoeff() + to_b_.cwiseAbs().maxCoeff() + to_c_.cwiseAbs().maxCoeff();
        a_ += normal_ * (coarse * 4e-7);
    }
    const Eigen::Vector3d& normal() const { return normal_; }

    /// u, v uniform in the unit square give points uniform on the triangle.
    Eigen::Vector3f at(double u, double v) const {
        const double root = std::sqrt(u);
        return (a_ + (1.0 - root) * to_b_ + root * v * to_c_).cast<float>();
    }

 private:
    Eigen::Vector3d normal_, a_, to_b_, to_c_;
};

/// The k-th of a sequence that fills the unit square evenly (Roberts' R2), from a random start.
Eigen::Vector2d evenly(int k, const Eigen::Vector2d& start) {
    const double x = start.x() + 0.7548776662466927 * k, y = start.y() + 0.5698402909980532 * k;
    return {x - std::floor(x), y - std::floor(y)};
}

/// Splits n into columns × rows as square as it goes, n = columns · rows.
std::pair<int, int> nearly_square(int n) {
    int rows = static_cast<int>(std::sqrt(static_cast<double>(n)));
    while (n % rows != 0) --rows;
    return {n / rows, rows};
}

/// Cell numbers of a columns × rows grid in an order where 16 successive cells lie close together,
/// so that a packet's rays go roughly the same way.
std::vector<std::pair<int, int>> cells_in_blocks(int columns, int rows) {
    std::vector<std::pair<int, int>> cells;
    for (int y0 = 0; y0 < rows; y0 += 4) {
        for (int x0 = 0; x0 < columns; x0 += 4) {
            for (int y = y0; y < std::min(rows, y0 + 4); ++y) {
                for (int x = x0; x < std::min(columns, x0 + 4); ++x) cells.emplace_back(x, y);
            }
        }
    }
    return cells;
}

/// One block's rows of the exchange matrix.
struct ExchangeRows {
    std::vector<std::uint32_t> length;  // (facet of the block)
    std::vector<FacetId> facet;
    std::vector<float> factor;

    /// Appends a row from the facets that were hit, one entry each, by rising number.
    void append(std::vector<FacetId>& seen, double weight) {
        std::sort(seen.begin(), seen.end());
        const std::size_t before = facet.size();
        for (std::size_t i = 0; i < seen.size();) {
            std::size_t j = i;
            while (j < seen.size() && seen[j] == seen[i]) ++j;
            facet.push_back(seen[i]);
            factor.push_back(static_cast<float>(weight * static_cast<double>(j - i)));
            i = j;
        }
        length.push_back(static_cast<std::uint32_t>(facet.size() - before));
    }
};

Exchange joined(const std::vector<ExchangeRows>& blocks, std::size_t facets) {
    Exchange exchange;
    std::size_t entries = 0;
    for (const ExchangeRows& block : blocks) entries += block.facet.size();
    exchange.row.reserve(facets + 1);
    exchange.facet.reserve(entries);
    exchange.factor.reserve(entries);
    exchange.row.push_back(0);
    for (const ExchangeRows& block : blocks) {
        for (const std::uint32_t length : block.length) {
            exchange.row.push_back(exchange.row.back() + length);
        }
        exchange.facet.insert(exchange.facet.end(), block.facet.begin(), block.facet.end());
        exchange.factor.insert(exchange.factor.end(), block.factor.begin(), block.factor.end());
    }
    return exchange;
}

}  // namespace

SkyView sky_view(const FacetSet& facets, const RayScene& scene, const SkyViewOptions& options) {
    assert(options.rays > 0);
    const std::size_t rays_per_facet = static_cast<std::size_t>(options.rays);
    const auto [columns, rows] = nearly_square(options.rays);
    const auto cells = cells_in_blocks(columns, rows);
    const double weight = 1.0 / options.rays;

    SkyView view;
    view.sky_view.resize(facets.size());
    view.below.resize(facets.size());
    std::vector<ExchangeRows> blocks((facets.size() + facets_per_block - 1) / facets_per_block);

    for_each_block(facets.size(), facets_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Ray> rays(rays_per_facet);
        std::vector<Hit> hits(rays_per_facet);
        std::vector<FacetId> seen;
        ExchangeRows& block = blocks[begin / facets_per_block];
        for (std::size_t f = begin; f < end; ++f) {
            Uniform random(options.seed, f);
            const FacetPoints points(facets, f);
            const auto [along, across] = tangents(points.normal());
            const Eigen::Vector2d start(random(), random());
            for (std::size_t k = 0; k < rays_per_facet; ++k) {
                const Eigen::Vector2d disc = to_disc((cells[k].first + random()) / columns,
                                                     (cells[k].second + random()) / rows);
                const Eigen::Vector2d place = evenly(static_cast<int>(k), start);
                rays[k].origin = points.at(place.x(), place.y());
                rays[k].direction =
                    (disc.x() * along + disc.y() * across +
                     std::sqrt(std::max(0.0, 1.0 - disc.squaredNorm())) * points.normal())
                        .cast<float>();
            }
            scene.closest(rays, hits, Coherence::incoherent);

            int sky = 0, below = 0;
            seen.clear();
            for (std::size_t k = 0; k < rays_per_facet; ++k) {
                if (hits[k].facet != no_facet) {
                    seen.push_back(hits[k].facet);
                } else {
                    ++(rays[k].direction.z() >= 0.0f ? sky : below);
                }
            }
            view.sky_view[f] = static_cast<float>(weight * sky);
            view.below[f] = static_cast<float>(weight * below);
            block.append(seen, weight);
        }
    });
    view.exchange = joined(blocks, facets.size());
    return view;
}

void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<float> fraction, const SunFractionOptions& options) {
    const std::vector<std::uint8_t> all(facets.size(), 1);
    sun_fraction(facets, scene, direction, all, fraction, options);
}

void sun_fraction(const FacetSet& facets, const RayScene& scene, const Eigen::Vector3d& direction,
                  std::span<const std::uint8_t> chosen, std::span<float> fraction,
                  const SunFractionOptions& options) {
    assert(fraction.size() == facets.size() && chosen.size() == facets.size());
    assert(options.samples > 0);
    for (std::size_t f = 0; f < facets.size(); ++f) {
        if (chosen[f]) fraction[f] = 0.0f;
    }
    if (direction.z() <= 0.0) return;

    const auto [east, north] = tangents(direction);
    const double disc_radius = std::tan(radians(sun_angular_radius_deg));
    const auto samples = static_cast<std::size_t>(options.samples);
    const auto [columns, rows] = nearly_square(options.samples);

    for_each_block(facets.size(), facets_per_block, [&](std::size_t begin, std::size_t end) {
        std::vector<Ray> rays;
        std::vector<std::uint32_t> owner;
        rays.reserve(samples * (end - begin));
        owner.reserve(samples * (end - begin));
        for (std::size_t f = begin; f < end; ++f) {
            if (!chosen[f]) continue;
            const FacetPoints points(facets, f);
            if (points.normal().dot(direction) <= 0.0) continue;
            Uniform random(options.seed, f);
            const Eigen::Vector2d start(random(), random());
            for (std::size_t k = 0; k < samples; ++k) {
                const Eigen::Vector2d disc =
                    disc_radius * to_disc((static_cast<int>(k) % columns + random()) / columns,
                                          (static_cast<int>(k) / columns + random()) / rows);
                const Eigen::Vector3d towards =
                    (direction + disc.x() * east + disc.y() * north).normalized();
                // The part of the disc under the facet's own plane does not shine on it.
                if (points.normal().dot(towards) <= 0.0) continue;
                const Eigen::Vector2d place = evenly(static_cast<int>(k), start);
                rays.push_back({.origin = points.at(place.x(), place.y()),
                                .direction = towards.cast<float>()});
                owner.push_back(static_cast<std::uint32_t>(f));
            }
        }
        std::vector<std::uint8_t> blocked(rays.size());
        scene.occluded(rays, blocked, Coherence::coherent);
        for (std::size_t i = 0; i < rays.size(); ++i) fraction[owner[i]] += blocked[i] ? 0 : 1;
        for (std::size_t f = begin; f < end; ++f) {
            if (chosen[f]) fraction[f] /= static_cast<float>(samples);
        }
    });
}

}  // namespace diurna
