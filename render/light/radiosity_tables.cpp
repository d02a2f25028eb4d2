#include "render/light/radiosity_tables.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <functional>

#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/hermite.hpp"
#include "render/light/lanes.hpp"
#include "render/light/node_spectra.hpp"

namespace diurna {

namespace {

/// Cubics in temperature of black bodies in the modes of a band: (power × cells + cell)(mode).
Eigen::MatrixXd black_cubics(const Band& band, const SpectralBasis& basis,
                             const TemperatureGrid& grid) {
    const std::size_t nodes = band.node_um.size(), levels = grid.cells + 1;
    Eigen::MatrixXd value(levels, basis.size()), slope(levels, basis.size());
    for_each_index(
        levels,
        [&](std::size_t k) {
            const double temperature = grid.low + grid.step * double(k);
            std::vector<double> db(nodes);
            for (std::size_t n = 0; n < nodes; ++n) {
                db[n] = planck_derivative(band.node_um[n], temperature) * grid.step;
            }
            const std::vector<double> b = black_body(band, temperature);
            value.row(static_cast<Eigen::Index>(k)) = project(basis, from_surface(b)).transpose();
            slope.row(static_cast<Eigen::Index>(k)) = project(basis, from_surface(db)).transpose();
        },
        4);
    const auto unused = static_cast<Eigen::Index>(basis.size() - basis.thermal);
    value.rightCols(unused).setZero();
    slope.rightCols(unused).setZero();
    const auto cells = static_cast<Eigen::Index>(grid.cells);
    const auto powers =
        hermite_cubic<Eigen::MatrixXd>(value.topRows(cells), slope.topRows(cells),
                                       value.bottomRows(cells), slope.bottomRows(cells));
    Eigen::MatrixXd cubics(4 * cells, value.cols());
    for (std::size_t p = 0; p < powers.size(); ++p) {
        cubics.middleRows(Eigen::Index(p) * cells, cells) = powers[p];
    }
    return cubics;
}

/// Into lanes from `first` of (cell, power, lane).
void lay_out(const Eigen::MatrixXd& cubics, std::size_t first, std::size_t lanes,
             std::vector<float>& out) {
    const Eigen::Index cells = cubics.rows() / 4;
    for (Eigen::Index power = 0; power < 4; ++power) {
        for (Eigen::Index cell = 0; cell < cells; ++cell) {
            float* row = &out[std::size_t(4 * cell + power) * lanes + first];
            for (Eigen::Index k = 0; k < cubics.cols(); ++k) {
                row[k] = static_cast<float>(cubics(power * cells + cell, k));
            }
        }
    }
}

void lay_out(const Eigen::VectorXd& modes, std::size_t first, std::vector<float>& out) {
    std::transform(modes.begin(), modes.end(), out.begin() + std::ptrdiff_t(first),
                   [](double x) { return static_cast<float>(x); });
}

/// Room for everything, zeros so far.
RadiosityTables empty_tables(std::span<const BandLight> bands, const TemperatureGrid& grid) {
    RadiosityTables tables;
    tables.grid = grid;
    tables.first.push_back(0);
    for (const BandLight& band : bands) {
        tables.size.push_back(band.basis.size());
        tables.first.push_back(tables.first.back() + rounded_up(band.basis.size(), 4));
    }
    tables.lanes = rounded_up(tables.first.back());
    const std::size_t values = grid.cells * 4 * tables.lanes;
    tables.black.assign(values, 0.0f);
    tables.material.resize(bands[0].optics.size());
    for (std::size_t m = 0; m < tables.material.size(); ++m) {
        if (bands[0].optics[m].reflectance.empty()) continue;
        auto& material = tables.material[m];
        material.emitted.assign(values, 0.0f);
        material.reflected.assign(values, 0.0f);
        for (auto& height : material.sun) height.assign(tables.lanes, 0.0f);
        material.sky.resize(bands.size());
        material.reflection.resize(bands.size());
    }
    return tables;
}

/// What a material does in the band numbered `b`.
///
/// - black: black_cubics() of that band
void fill(const BandLight& band, const NodeOptics& optics, const Eigen::MatrixXd& black,
          std::size_t b, RadiosityTables& tables, RadiosityTables::OfMaterial& material) {
    const SpectralBasis& basis = band.basis;
    const std::size_t first = tables.first[b], width = tables.first[b + 1] - first;
    // What is sent on without being reflected, seen from outside.
    std::vector<double> own = optics.emissivity;
    if (optics.transparent && optics.room.empty()) {
        std::transform(own.begin(), own.end(), optics.transmittance.begin(), own.begin(),
                       std::plus<>());
    }
    // Others see so much less of a net, by what goes on behind it, and that bright.
    std::vector<double> reflectance = optics.reflectance;
    if (optics.passed > 0.0 && optics.passed < 1.0) {
        for (double& x : own) x = std::max(0.0, x - optics.passed) / (1.0 - optics.passed);
        for (double& x : reflectance) x /= 1.0 - optics.passed;
    }
    const Eigen::MatrixXd reflect = product(basis, reflectance);
    Eigen::MatrixXd emitted = black * product(basis, own).transpose();
    if (!optics.room.empty()) {
        emitted.topRows(emitted.rows() / 4).rowwise() +=
            project(basis, from_surface(optics.room)).transpose();
    }
    lay_out(emitted, first, tables.lanes, material.emitted);
    lay_out(black * reflect.transpose(), first, tables.lanes, material.reflected);
    for (std::size_t h = 0; h < 3; ++h) {
        const LightByOrigin sun = times(reflectance, band.incident[h].sun_by_origin());
        lay_out(project(basis, sun), first, material.sun[h]);
    }
    material.sky[b].assign(band.sky.size() * width, 0.0f);
    for (std::size_t k = 0; k < band.sky.size(); ++k) {
        lay_out(project(basis, times(reflectance, band.sky.spectrum[k])), k * width,
                material.sky[b]);
    }
    material.reflection[b].assign(basis.size() * width, 0.0f);
    for (std::size_t in = 0; in < basis.size(); ++in) {
        for (std::size_t out = 0; out < basis.size(); ++out) {
            material.reflection[b][in * width + out] = static_cast<float>(
                reflect(static_cast<Eigen::Index>(out), static_cast<Eigen::Index>(in)));
        }
    }
}

}  // namespace

TemperatureGrid temperature_grid(double low, double high) {
    assert(low > 0.0 && high >= low);
    TemperatureGrid grid;
    grid.cells = static_cast<std::size_t>(std::max(1.0, std::ceil((high - low) / 2.0)));
    grid.low = low;
    grid.step = std::max(1e-3, (high - low) / double(grid.cells));
    return grid;
}

RadiosityTables radiosity_tables(std::span<const BandLight> bands, const TemperatureGrid& grid) {
    RadiosityTables tables = empty_tables(bands, grid);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const BandLight& band = bands[b];
        const Eigen::MatrixXd black = black_cubics(band.band, band.basis, grid);
        lay_out(black, tables.first[b], tables.lanes, tables.black);
        for_each_index(
            tables.material.size(),
            [&](std::size_t m) {
                if (band.optics[m].reflectance.empty()) return;
                fill(band, band.optics[m], black, b, tables, tables.material[m]);
            },
            1);
    }
    return tables;
}

void black_modes(const RadiosityTables& tables, float temperature, float* out) {
    const std::size_t n = tables.lanes;
    float t = 0.0f;
    const float* cell = &tables.black[tables.grid.cell(temperature, t) * 4 * n];
    for (std::size_t k = 0; k < n; k += lane_count) {
        Eigen::Map<Lane>(out + k) = cubic(cell + k, n, t);
    }
}

}  // namespace diurna
