#include "render/light/narrow_sky.hpp"

#include <Eigen/Cholesky>
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

NarrowView narrow_view(const SkyVector& sky, const Eigen::Vector3f& normal) {
    static const WholeSky directions;
    // Shares come of rays and are not exact; and nowhere is it sure that nothing is seen.
    constexpr double slack = 1e-4;
    constexpr float least = 0.01f;
    const Weights cosine =
        (directions.direction * normal).cwiseMax(0.0f).cwiseProduct(directions.size);
    const Numbers shares = Eigen::Map<const Numbers>(sky.data());
    Weights before = cosine, found = Weights::Zero();
    for (int step = 0; step < 2; ++step) {
        if (step > 0) before = found.cwiseMin(cosine).cwiseMax(least * cosine);
        Eigen::Matrix<double, functions, functions> gram;
        for (const bool odd : {false, true}) {
            const Products& some = directions.products[odd];
            const Eigen::Matrix<float, half, 1> both =
                before.head<half>() + (odd ? -1.0f : 1.0f) * before.tail<half>();
            const Eigen::VectorXf sums = some.at * both;
            for (std::size_t p = 0; p < some.of.size(); ++p) {
                gram(some.of[p][0], some.of[p][1]) = double{sums[Eigen::Index(p)]};
            }
        }
        gram.diagonal() *= 1.0 + slack;
        // LDLT, as nothing is left of a facet that faces down: a matrix of zeros.
        const Numbers factors = gram.ldlt().solve(shares.cast<double>()).cast<float>();
        found = before.cwiseProduct(directions.at * factors);
    }
    const float counts = narrowness(sky[0]);
    NarrowView view;
    for (std::size_t k = 0; k < sky_directions; ++k) {
        view[k] = counts * (found[Eigen::Index(k)] + found[Eigen::Index(k + sky_directions)]);
    }
    return view;
}

}  // namespace diurna
