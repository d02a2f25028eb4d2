#include "render/light/interreflection.hpp"

#include <algorithm>
#include <numbers>

#include "materials/base/error.hpp"
#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

constexpr std::size_t lane = 8, most_lanes = 1024, ahead = 12;
using Lane = Eigen::Array<float, lane, 1>;
Eigen::Map<const Lane> load(const float* from) { return Eigen::Map<const Lane>(from); }

/// A cubic whose coefficients lie n apart.
Lane cubic(const float* a, std::size_t n, float t) {
    return load(a) + t * (load(a + n) + t * (load(a + 2 * n) + t * load(a + 3 * n)));
}

std::size_t whole(std::size_t n, std::size_t group) { return (n + group - 1) / group * group; }

/// Cubics in temperature of black bodies in the modes of a band: (power × cells + cell)(mode).
Eigen::MatrixXd black_cubics(const Band& band, const SpectralBasis& basis,
                             const TemperatureGrid& grid) {
    const std::size_t nodes = band.node_um.size(), levels = grid.cells + 1;
    Eigen::MatrixXd value(levels, basis.size()), slope(levels, basis.size());
    for_each_index(
        levels,
        [&](std::size_t k) {
            const double temperature = grid.low + grid.step * double(k);
            std::vector<double> b(nodes), db(nodes);
            for (std::size_t n = 0; n < nodes; ++n) {
                b[n] = planck(band.node_um[n], temperature);
                db[n] = planck_derivative(band.node_um[n], temperature) * grid.step;
            }
            value.row(static_cast<Eigen::Index>(k)) = project(basis, b).transpose();
            slope.row(static_cast<Eigen::Index>(k)) = project(basis, db).transpose();
        },
        4);
    const auto unused = static_cast<Eigen::Index>(basis.size() - basis.thermal);
    value.rightCols(unused).setZero();
    slope.rightCols(unused).setZero();
    const auto cells = static_cast<Eigen::Index>(grid.cells);
    const auto v0 = value.topRows(cells), v1 = value.bottomRows(cells), s0 = slope.topRows(cells),
               s1 = slope.bottomRows(cells);
    Eigen::MatrixXd cubics(4 * cells, value.cols());
    cubics.topRows(cells) = v0;
    cubics.middleRows(cells, cells) = s0;
    cubics.middleRows(2 * cells, cells) = 3.0 * (v1 - v0) - 2.0 * s0 - s1;
    cubics.bottomRows(cells) = 2.0 * (v0 - v1) + s0 + s1;
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

std::vector<double> times(std::span<const double> a, std::span<const double> b) {
    std::vector<double> out(a.size());
    std::transform(a.begin(), a.end(), b.begin(), out.begin(), std::multiplies<>());
    return out;
}

}  // namespace

LightTables light_tables(std::span<const Band> bands, std::span<const SpectralBasis> basis,
                         std::span<const std::vector<NodeOptics>> optics,
                         std::span<const std::array<Light, 3>> light, const TemperatureGrid& grid) {
    LightTables tables;
    tables.grid = grid;
    tables.first.push_back(0);
    for (std::size_t b = 0; b < bands.size(); ++b) {
        tables.size.push_back(basis[b].size());
        tables.first.push_back(tables.first.back() + whole(basis[b].size(), 4));
    }
    tables.lanes = whole(tables.first.back(), lane);
    const std::size_t lanes = tables.lanes, rows = grid.cells * 4;
    tables.black.assign(rows * lanes, 0.0f);
    tables.material.resize(optics[0].size());
    for (std::size_t m = 0; m < tables.material.size(); ++m) {
        if (optics[0][m].reflectance.empty()) continue;
        auto& material = tables.material[m];
        material.emitted.assign(rows * lanes, 0.0f);
        material.reflected.assign(rows * lanes, 0.0f);
        for (auto* part : {&material.sky, &material.sun}) {
            for (auto& height : *part) height.assign(lanes, 0.0f);
        }
        material.reflection.resize(bands.size());
    }
    for (std::size_t b = 0; b < bands.size(); ++b) {
        const std::size_t first = tables.first[b], width = tables.first[b + 1] - first;
        const Eigen::MatrixXd black = black_cubics(bands[b], basis[b], grid);
        lay_out(black, first, lanes, tables.black);
        for_each_index(
            tables.material.size(),
            [&](std::size_t m) {
                const NodeOptics& o = optics[b][m];
                if (o.reflectance.empty()) return;
                auto& material = tables.material[m];
                // What is sent on without being reflected, seen from outside.
                std::vector<double> own = o.emissivity;
                if (o.transparent && o.room.empty()) {
                    std::transform(own.begin(), own.end(), o.transmittance.begin(), own.begin(),
                                   std::plus<>());
                }
                const Eigen::MatrixXd reflect = product(basis[b], o.reflectance);
                Eigen::MatrixXd emitted = black * product(basis[b], own).transpose();
                if (!o.room.empty()) {
                    emitted.topRows(emitted.rows() / 4).rowwise() +=
                        project(basis[b], o.room).transpose();
                }
                lay_out(emitted, first, lanes, material.emitted);
                lay_out(black * reflect.transpose(), first, lanes, material.reflected);
                for (std::size_t h = 0; h < 3; ++h) {
                    lay_out(project(basis[b], times(o.reflectance, light[b][h].sky)), first,
                            material.sky[h]);
                    lay_out(project(basis[b], times(o.reflectance, light[b][h].sun)), first,
                            material.sun[h]);
                }
                material.reflection[b].assign(basis[b].size() * width, 0.0f);
                for (std::size_t in = 0; in < basis[b].size(); ++in) {
                    for (std::size_t out = 0; out < basis[b].size(); ++out) {
                        material.reflection[b][in * width + out] = static_cast<float>(
                            reflect(static_cast<Eigen::Index>(out), static_cast<Eigen::Index>(in)));
                    }
                }
            },
            1);
    }
    return tables;
}

void black_modes(const LightTables& tables, float temperature, float* out) {
    const std::size_t n = tables.lanes;
    float t = 0.0f;
    const float* cell = &tables.black[tables.grid.cell(temperature, t) * 4 * n];
    for (std::size_t k = 0; k < n; k += lane) {
        Eigen::Map<Lane>(out + k) = cubic(cell + k, n, t);
    }
}

SentLight::SentLight(const LitFacets& lit, const LitState& state, const LightTables& tables,
                     std::span<const BounceOptions> bounces)
    : lit_(lit), state_(state), tables_(tables), sent_(lit.facet.size() * tables.lanes) {
    const std::size_t n = lit.facet.size(), lanes = tables.lanes;
    if (lanes > most_lanes) throw InputError("render", "too many bands at a time");
    for_each_block(n, 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            if (lit.sends[i]) first(i, &sent_[i * lanes]);
        }
    });
    std::vector<std::pair<const float*, float>> least;  // (band followed) worth and what to follow
    for (std::size_t b = 0; b < bounces.size(); ++b) {
        if (bounces[b].bounces < 2) continue;
        least.emplace_back(lit.worth[b].twice.data(),
                           bounces[b].tolerance / bounces[b].most_change);
    }
    const auto follow = [&](std::size_t i) {
        return std::any_of(least.begin(), least.end(),
                           [&](const auto& band) { return band.first[i] > band.second; });
    };
    // All are worked out before any is replaced, so that none is followed twice.
    constexpr std::size_t grain = 4096;
    struct Block {
        std::vector<std::uint32_t> place;
        std::vector<float> sent;
    };
    std::vector<Block> blocks(least.empty() ? 0 : (n + grain - 1) / grain);
    if (blocks.empty()) return;
    for_each_block(n, grain, [&](std::size_t begin, std::size_t end) {
        Block& block = blocks[begin / grain];
        for (std::size_t i = begin; i < end; ++i) {
            if (follow(i)) block.place.push_back(static_cast<std::uint32_t>(i));
        }
        block.sent.resize(block.place.size() * lanes);
        for (std::size_t k = 0; k < block.place.size(); ++k) {
            if (k + ahead < block.place.size()) fetch(block.place[k + ahead]);
            second(block.place[k], &block.sent[k * lanes]);
        }
    });
    for_each_index(
        blocks.size(),
        [&](std::size_t k) {
            for (std::size_t j = 0; j < blocks[k].place.size(); ++j) {
                std::copy_n(&blocks[k].sent[j * lanes], lanes, &sent_[blocks[k].place[j] * lanes]);
            }
        },
        1);
    for (const Block& block : blocks) followed_ += block.place.size();
}

/// Eight lanes at a time stay in registers.
void SentLight::first(std::size_t i, float* out) const {
    const std::size_t n = tables_.lanes;
    const auto& material = tables_.material[index(lit_.material[i])];
    float t = 0.0f;
    const std::size_t cell = tables_.grid.cell(state_.temperature[i], t) * 4 * n;
    const float *emitted = &material.emitted[cell], *reflected = &material.reflected[cell];
    const std::array<float, 3> up = height_weights(lit_.height[i]);
    const float open = lit_.sky_view[i], sunlight = state_.sunlight[i];
    for (std::size_t k = 0; k < n; k += lane) {
        Lane all = cubic(emitted + k, n, t) + (1.0f - open) * cubic(reflected + k, n, t);
        all += open * (up[0] * load(&material.sky[0][k]) + up[1] * load(&material.sky[1][k]) +
                       up[2] * load(&material.sky[2][k]));
        if (sunlight > 0.0f) {
            all +=
                sunlight * (up[0] * load(&material.sun[0][k]) + up[1] * load(&material.sun[1][k]) +
                            up[2] * load(&material.sun[2][k]));
        }
        Eigen::Map<Lane>(out + k) = all;
    }
}

/// What was sent, plus ρ times the light of the surroundings less that of the black body they were
/// closed with.
void SentLight::second(std::size_t i, float* out) const {
    const std::size_t n = tables_.lanes;
    alignas(32) std::array<float, most_lanes> own, light;
    black_modes(tables_, state_.temperature[i], own.data());
    around(i, own.data(), light.data());
    const float rest = 1.0f - lit_.sky_view[i];
    for (std::size_t k = 0; k < n; ++k) light[k] -= rest * own[k];
    std::copy_n(&sent_[i * n], n, out);
    const auto& material = tables_.material[index(lit_.material[i])];
    for (std::size_t b = 0; b < tables_.size.size(); ++b) {
        const std::size_t first = tables_.first[b], width = tables_.first[b + 1] - first;
        const float* matrix = material.reflection[b].data();
        for (std::size_t in = 0; in < tables_.size[b]; ++in, matrix += width) {
            const float x = light[first + in];
            float* to = out + first;
#pragma omp simd
            for (std::size_t k = 0; k < width; ++k) to[k] += x * matrix[k];
        }
    }
}

void SentLight::around(std::size_t i, const float* black, float* out) const {
    const std::size_t n = tables_.lanes;
    const std::uint32_t begin = lit_.row[i], end = lit_.row[i + 1];
    for (std::size_t k = 0; k < n; k += lane) {
        Lane sum = Lane::Zero();
        if (begin == end) {
            sum = (1.0f - lit_.sky_view[i]) * load(black + k);
        }
        for (std::uint32_t e = begin; e < end; ++e) {
            sum += lit_.factor[e] * load(&sent_[std::size_t{lit_.source[e]} * n + k]);
        }
        Eigen::Map<Lane>(out + k) = sum;
    }
}

}  // namespace diurna
