#include "materials/atmosphere/mie.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

namespace diurna {

namespace {

/// The series; adds |S1|² + |S2|² at each cosine to `intensity`, times `weight`.
MieEfficiency series(std::complex<double> index, double x, std::span<const double> cosine,
                     std::span<double> intensity, double weight) {
    using Complex = std::complex<double>;
    const Complex m = std::conj(Complex(index.real(), -std::abs(index.imag())));
    const int terms = static_cast<int>(x + 4.05 * std::cbrt(x) + 3.0);
    const Complex y = m * x;
    const int start = std::max(terms, static_cast<int>(std::abs(y))) + 16;
    std::vector<Complex> d(static_cast<std::size_t>(start) + 1);
    for (int n = start; n > 0; --n) {
        const Complex ratio = double(n) / y;
        d[static_cast<std::size_t>(n) - 1] = ratio - 1.0 / (d[static_cast<std::size_t>(n)] + ratio);
    }
    double psi0 = std::cos(x), psi1 = std::sin(x), chi0 = -std::sin(x), chi1 = std::cos(x);
    double extinction = 0.0, scattering = 0.0, asymmetry = 0.0;
    Complex a_before, b_before;
    std::vector<Complex> s1(cosine.size()), s2(cosine.size());
    std::vector<double> pi(cosine.size(), 1.0), pi_before(cosine.size(), 0.0);
    for (int n = 1; n <= terms; ++n) {
        const double psi = (2.0 * n - 1.0) / x * psi1 - psi0;
        const double chi = (2.0 * n - 1.0) / x * chi1 - chi0;
        const Complex xi(psi, -chi), xi_before(psi1, -chi1);
        const Complex derivative = d[static_cast<std::size_t>(n)];
        const Complex to_a = derivative / m + n / x, to_b = derivative * m + n / x;
        const Complex a = (to_a * psi - psi1) / (to_a * xi - xi_before);
        const Complex b = (to_b * psi - psi1) / (to_b * xi - xi_before);
        extinction += (2.0 * n + 1.0) * (a + b).real();
        scattering += (2.0 * n + 1.0) * (std::norm(a) + std::norm(b));
        asymmetry += (2.0 * n + 1.0) / (n * (n + 1.0)) * (a * std::conj(b)).real();
        if (n > 1) {
            asymmetry +=
                (n * n - 1.0) / n * (a_before * std::conj(a) + b_before * std::conj(b)).real();
        }
        const double order = (2.0 * n + 1.0) / (n * (n + 1.0));
        for (std::size_t k = 0; k < cosine.size(); ++k) {
            const double tau = n * cosine[k] * pi[k] - (n + 1.0) * pi_before[k];
            s1[k] += order * (a * pi[k] + b * tau);
            s2[k] += order * (a * tau + b * pi[k]);
            const double next =
                ((2.0 * n + 1.0) * cosine[k] * pi[k] - (n + 1.0) * pi_before[k]) / n;
            pi_before[k] = pi[k];
            pi[k] = next;
        }
        psi0 = psi1, psi1 = psi, chi0 = chi1, chi1 = chi;
        a_before = a, b_before = b;
    }
    for (std::size_t k = 0; k < cosine.size(); ++k) {
        intensity[k] += weight * (std::norm(s1[k]) + std::norm(s2[k]));
    }
    const double scale = 2.0 / (x * x);
    return {scale * extinction, scale * scattering, 2.0 * asymmetry / scattering};
}

MieMean mean_of(std::span<const SizeMode> modes, std::span<const std::complex<double>> index,
                double wavelength_um, std::span<const double> cosine, std::span<double> intensity);

}  // namespace

MieEfficiency mie(std::complex<double> index, double x) { return series(index, x, {}, {}, 0.0); }

MieMean mie_mean(std::span<const SizeMode> modes, std::span<const std::complex<double>> index,
                 double wavelength_um) {
    return mean_of(modes, index, wavelength_um, {}, {});
}

std::vector<double> mie_phase(std::span<const SizeMode> modes,
                              std::span<const std::complex<double>> index, double wavelength_um,
                              std::span<const double> cosine) {
    std::vector<double> phase(cosine.size(), 0.0);
    const MieMean mean = mean_of(modes, index, wavelength_um, cosine, phase);
    // 4π dσ/dΩ / σ = 4π (|S1|² + |S2|²) / (2 k² σ).
    const double k = 2.0 * std::numbers::pi / wavelength_um;
    for (double& value : phase) value *= 2.0 * std::numbers::pi / (k * k * mean.scattering);
    return phase;
}

namespace {

MieMean mean_of(std::span<const SizeMode> modes, std::span<const std::complex<double>> index,
                double wavelength_um, std::span<const double> cosine, std::span<double> intensity) {
    assert(modes.size() == index.size());
    constexpr int steps = 160;
    MieMean mean;
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const SizeMode& mode = modes[k];
        const bool gamma = mode.gamma > 0.0;
        const double spread = mode.sigma_log10 * std::numbers::ln10;
        // Cross sections weigh large particles: the middle of r² dN lies at 2 spread² above.
        const double centre = std::log(mode.radius_um) + (gamma ? 0.0 : 2.0 * spread * spread);
        const double half = gamma ? std::log(20.0) : 5.0 * spread;
        // The gamma distribution's sum of numbers is known only at the end.
        double total = 0.0;
        MieMean sum;
        std::vector<double> lobes(cosine.size(), 0.0);
        for (int i = 0; i < steps; ++i) {
            const double ln_r = centre + half * (2.0 * (i + 0.5) / steps - 1.0);
            const double r = std::exp(ln_r), away = ln_r - std::log(mode.radius_um);
            const double number =
                gamma ? std::exp((mode.alpha + 1.0) * away -
                                 mode.alpha / mode.gamma * std::pow(r / mode.radius_um, mode.gamma))
                      : std::exp(-0.5 * away * away / (spread * spread)) /
                            (std::sqrt(2.0 * std::numbers::pi) * spread);
            total += number;
            const double x = 2.0 * std::numbers::pi * r / wavelength_um;
            if (x < 1e-3 || number < 1e-30) continue;
            const MieEfficiency q = series(index[k], std::min(x, 5000.0), cosine, lobes, number);
            const double area = number * std::numbers::pi * r * r;
            sum.extinction += area * q.extinction;
            sum.scattering += area * q.scattering;
            sum.asymmetry += area * q.scattering * q.asymmetry;
        }
        const double weight = mode.number * (gamma ? 1.0 / total : 2.0 * half / steps);
        mean.extinction += weight * sum.extinction;
        mean.scattering += weight * sum.scattering;
        mean.asymmetry += weight * sum.asymmetry;
        for (std::size_t c = 0; c < lobes.size(); ++c) intensity[c] += weight * lobes[c];
    }
    mean.asymmetry /= mean.scattering;
    return mean;
}

}  // namespace

}  // namespace diurna
