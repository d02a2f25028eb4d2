#include "render/light/narrow_sky.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "materials/base/quadrature.hpp"

namespace diurna {

namespace {

constexpr auto half = Eigen::Index(sky_directions), whole = 2 * half,
               functions = Eigen::Index(sky_functions);
using Columns = Eigen::Matrix<float, whole, functions>;
using Weights = Eigen::Matrix<float, whole, 1>;
using Numbers = Eigen::Matrix<float, functions, 1>;

/// Whether a function changes its sign on the other side of the plane of the sun.
bool is_odd(Eigen::Index function) {
    return std::find(even_sky_function.begin(), even_sky_function.end(), std::size_t(function)) ==
           even_sky_function.end();
}

/// Products of two functions each at the directions of one half: of their sums, or differences,
/// over both halves.
struct Products {
    Eigen::Matrix<float, Eigen::Dynamic, half> at;
    std::vector<std::array<Eigen::Index, 2>> of;  // (row) lower triangle
};

/// Directions of both halves, and the functions there.
struct WholeSky {
    Eigen::Matrix<float, whole, 3> direction;
    Weights size;  // dω / π
    Columns at;
    std::array<Products, 2> products;  // even, odd

    WholeSky() {
        const HalfSky& sky = half_sky();
        for (Eigen::Index i = 0; i < whole; ++i) {
            const std::size_t k = std::size_t(i) % sky_directions;
            const double side = std::size_t(i) < sky_directions ? 1.0 : -1.0;
            const double across = std::sqrt(1.0 - sky.up[k] * sky.up[k]);
            const Eigen::Vector3d way(across * std::cos(sky.azimuth[k]),
                                      side * across * std::sin(sky.azimuth[k]), sky.up[k]);
            direction.row(i) = way.cast<float>().transpose();
            size[i] = static_cast<float>(sky.ring_weight[k] / sky_sectors);
            const SkyVector values = sky_functions_at(way.cast<float>());
            at.row(i) = Eigen::Map<const Numbers>(values.data()).transpose();
        }
        for (Eigen::Index k = 0; k < functions; ++k) {
            for (Eigen::Index j = 0; j <= k; ++j) {
                products[is_odd(k) != is_odd(j)].of.push_back({k, j});
            }
        }
        for (Products& some : products) {
            some.at.resize(Eigen::Index(some.of.size()), half);
            for (std::size_t p = 0; p < some.of.size(); ++p) {
                const auto [k, j] = some.of[p];
                some.at.row(Eigen::Index(p)) =
                    at.col(k).head<half>().cwiseProduct(at.col(j).head<half>()).transpose();
            }
        }
    }
};

}  // namespace

const HalfSky& half_sky() {
    static const HalfSky directions = [] {
        HalfSky half;
        const Quadrature rings = gauss_legendre(int(sky_rings), 0.0, 1.0);
        for (std::size_t i = 0; i < sky_rings; ++i) {
            for (std::size_t j = 0; j < sky_sectors; ++j) {
                const std::size_t k = i * sky_sectors + j;
                half.up[k] = rings.node[i];
                half.azimuth[k] = std::numbers::pi * (double(j) + 0.5) / sky_sectors;
                half.ring_weight[k] = rings.weight[i];
            }
        }
        return half;
    }();
    return directions;
}

float narrowness(float sky_view) {
    constexpr float least = 1e-4f;  // of the sky: by chance of the rays
    if (sky_view < least) return 0.0f;
    const float t = std::clamp((0.9f - sky_view) * 10.0f, 0.0f, 1.0f);
    return t * t * (3.0f - 2.0f * t);
}

namespace {

constexpr Eigen::Index lanes = 8;
using Lanes [[gnu::vector_size(8 * lanes)]] = double;
/// (direction, function, or pair of functions; facet), so that facets lie side by side.
using OfFacets = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Solves the equations of eight facets by L D Lᵀ: `gram` has the lower triangle by rows, and
/// is lost. Where nothing is left of a facet that faces down, the solution is 0.
void solve(Lanes* gram, Lanes* value) {
    const auto at = [gram](Eigen::Index k, Eigen::Index j) -> Lanes& {
        return gram[k * (k + 1) / 2 + j];
    };
    constexpr double nothing = 1e-30;
    Lanes inverse[functions];
    for (Eigen::Index k = 0; k < functions; ++k) {
        Lanes own = at(k, k);
        for (Eigen::Index j = 0; j < k; ++j) {
            Lanes left = at(k, j);  // l_kj d_j
            for (Eigen::Index m = 0; m < j; ++m) left -= at(k, m) * at(j, m);
            at(k, j) = left;
        }
        for (Eigen::Index j = 0; j < k; ++j) {
            const Lanes scaled = at(k, j) * inverse[j];
            own -= at(k, j) * scaled;
            at(k, j) = scaled;
        }
        for (Eigen::Index l = 0; l < lanes; ++l) {
            inverse[k][l] = own[l] > nothing ? 1.0 / own[l] : 0.0;
        }
    }
    for (Eigen::Index k = 0; k < functions; ++k) {
        for (Eigen::Index j = 0; j < k; ++j) value[k] -= at(k, j) * value[j];
    }
    for (Eigen::Index k = functions; k-- > 0;) {
        value[k] *= inverse[k];
        for (Eigen::Index j = k + 1; j < functions; ++j) value[k] -= at(j, k) * value[j];
    }
}

}  // namespace

void narrow_views(std::span<const SkyVector> sky, std::span<const Eigen::Vector3f> normal,
                  std::span<NarrowView> view) {
    static const WholeSky directions;
    // Shares come of rays and are not exact; and nowhere is it sure that nothing is seen.
    constexpr double slack = 1e-4;
    constexpr float least = 0.01f;
    const auto count = Eigen::Index(sky.size()), n = (count + lanes - 1) / lanes * lanes;
    OfFacets normals = OfFacets::Zero(3, n), shares = OfFacets::Zero(functions, n);
    for (Eigen::Index f = 0; f < count; ++f) {
        normals.col(f) = normal[std::size_t(f)];
        shares.col(f) = Eigen::Map<const Numbers>(sky[std::size_t(f)].data());
    }
    const OfFacets cosine =
        directions.size.asDiagonal() * (directions.direction * normals).cwiseMax(0.0f);
    OfFacets before = cosine, found = OfFacets::Zero(whole, n), factors(functions, n);
    std::vector<Lanes> gram(std::size_t(functions * (functions + 1) / 2));
    for (int step = 0; step < 2; ++step) {
        if (step > 0) before = found.cwiseMin(cosine).cwiseMax(least * cosine);
        const OfFacets sums[]{
            directions.products[0].at * (before.topRows<half>() + before.bottomRows<half>()),
            directions.products[1].at * (before.topRows<half>() - before.bottomRows<half>())};
        for (Eigen::Index f = 0; f < n; f += lanes) {
            Lanes value[functions];
            for (const bool odd : {false, true}) {
                const auto& of = directions.products[odd].of;
                for (std::size_t p = 0; p < of.size(); ++p) {
                    const auto [k, j] = of[p];
                    Lanes& to = gram[std::size_t(k * (k + 1) / 2 + j)];
                    const double more = k == j ? 1.0 + slack : 1.0;
                    for (Eigen::Index l = 0; l < lanes; ++l) {
                        to[l] = more * double{sums[odd](Eigen::Index(p), f + l)};
                    }
                }
            }
            for (Eigen::Index k = 0; k < functions; ++k) {
                for (Eigen::Index l = 0; l < lanes; ++l) value[k][l] = double{shares(k, f + l)};
            }
            solve(gram.data(), value);
            for (Eigen::Index k = 0; k < functions; ++k) {
                for (Eigen::Index l = 0; l < lanes; ++l) factors(k, f + l) = float(value[k][l]);
            }
        }
        found.noalias() = directions.at * factors;
        found.array() *= before.array();
    }
    for (Eigen::Index f = 0; f < count; ++f) {
        const float counts = narrowness(sky[std::size_t(f)][0]);
        NarrowView& of = view[std::size_t(f)];
        for (std::size_t k = 0; k < sky_directions; ++k) {
            of[k] =
                counts * (found(Eigen::Index(k), f) + found(Eigen::Index(k + sky_directions), f));
        }
    }
}

NarrowView narrow_view(const SkyVector& sky, const Eigen::Vector3f& normal) {
    NarrowView view;
    narrow_views({&sky, 1}, {&normal, 1}, {&view, 1});
    return view;
}

}  // namespace diurna
