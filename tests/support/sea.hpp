#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>

namespace diurna {

/// Water in the wind by itself, from the papers, with nothing of the program's: slopes of Cox &
/// Munk (1954), Fresnel's formulas, Hale & Querry's (1973) indices in 8-12 µm, and what waves hide
/// of one another (Smith 1967; bistatic: Ross, Potvin & Dion 2005).
struct Sea {
    double wind_speed = 3.0;

    static std::complex<double> index(double um) {
        constexpr std::array<std::array<double, 3>, 10> table = {{{8.0, 1.291, 0.0343},
                                                                  {8.6, 1.275, 0.0372},
                                                                  {9.2, 1.255, 0.0415},
                                                                  {9.6, 1.239, 0.0454},
                                                                  {10.0, 1.218, 0.0508},
                                                                  {10.5, 1.185, 0.0662},
                                                                  {11.0, 1.153, 0.0968},
                                                                  {11.5, 1.126, 0.142},
                                                                  {12.0, 1.111, 0.199},
                                                                  {12.5, 1.123, 0.259}}};
        std::size_t i = 0;
        while (i + 2 < table.size() && um > table[i + 1][0]) ++i;
        const double t = (um - table[i][0]) / (table[i + 1][0] - table[i][0]);
        return {std::lerp(table[i][1], table[i + 1][1], t),
                std::lerp(table[i][2], table[i + 1][2], t)};
    }
    static double reflectance(double cosine, std::complex<double> m) {
        const std::complex<double> q = std::sqrt(m * m - 1.0 + cosine * cosine);
        return 0.5 * std::norm((cosine - q) / (cosine + q)) +
               0.5 * std::norm((m * m * cosine - q) / (m * m * cosine + q));
    }
    double variance() const { return 0.003 + 0.00512 * wind_speed; }
    double hidden(double cosine) const {
        const double x = cosine / std::sqrt((1.0 - cosine * cosine + 1e-18) * variance());
        return x > 6.0
                   ? 0.0
                   : 0.5 * (std::exp(-x * x) / (x * std::sqrt(std::numbers::pi)) - std::erfc(x));
    }
    /// body(share, cosine at the wave, direction of what it reflects to an eye), the eye in x at a
    /// cosine to the vertical, over even slopes; the shares of lossless water add up to 1 at most.
    /// - n: of slopes, from 0 to 4 of their spread
    void each_wave(double eye_cosine,
                   const std::function<void(double, double, const Eigen::Vector3d&)>& body,
                   int n = 48) const {
        const Eigen::Vector3d eye(std::sqrt(1.0 - eye_cosine * eye_cosine), 0.0, eye_cosine);
        const double reach = 4.0 * std::sqrt(variance()), step = reach / n;
        for (int i = -n; i < n; ++i) {
            for (int k = -n; k < n; ++k) {
                const double x = (i + 0.5) * step, y = (k + 0.5) * step;
                const double rise = 1.0 + x * x + y * y;
                const Eigen::Vector3d wave = Eigen::Vector3d(-x, -y, 1.0) / std::sqrt(rise);
                const double cosine = eye.dot(wave);
                const Eigen::Vector3d out = 2.0 * cosine * wave - eye;
                if (cosine <= 0.0 || out.z() <= 0.0) continue;
                const double slopes = std::exp(-(rise - 1.0) / variance()) /
                                      (std::numbers::pi * variance()) * step * step;
                body(slopes * cosine / (wave.z() * eye_cosine) /
                         (1.0 + hidden(eye_cosine) + hidden(out.z())),
                     cosine, out);
            }
        }
    }
    double emissivity(double eye_cosine, double um) const {
        double mirrored = 0.0;
        each_wave(eye_cosine, [&](double share, double cosine, const Eigen::Vector3d&) {
            mirrored += share * reflectance(cosine, index(um));
        });
        return 1.0 - mirrored;
    }
};

}  // namespace diurna
