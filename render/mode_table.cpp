#include "render/mode_table.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

double norm2(const std::vector<double>& v) {
    double sum = 0.0;
    for (const double x : v) sum += x * x;
    return sum;
}

void evaluate_cubic(const float* cell, std::size_t padded, float t, float* out) {
    const float *a0 = cell, *a1 = a0 + padded, *a2 = a1 + padded, *a3 = a2 + padded;
#pragma omp simd
    for (std::size_t c = 0; c < padded; ++c) {
        out[c] = a0[c] + t * (a1[c] + t * (a2[c] + t * a3[c]));
    }
}

}  // namespace

ModeBasis::ModeBasis(std::span<const std::vector<float>> generators, std::size_t channels,
                     double tolerance)
    : channels_(channels) {
    std::vector<std::vector<double>> rest;
    for (const auto& generator : generators) {
        rest.emplace_back(generator.begin(), generator.begin() + std::ptrdiff_t(channels));
    }
    std::size_t worst = 0;
    double left = norm2(rest[0]);
    while (mode_.size() < channels && left > 0.0) {
        std::vector<double> mode = rest[worst];
        // Once more against the earlier modes: rounding grows where little is left.
        for (const auto& earlier : mode_) {
            double along = 0.0;
            for (std::size_t c = 0; c < channels; ++c) along += earlier[c] * mode[c];
            for (std::size_t c = 0; c < channels; ++c) mode[c] -= along * earlier[c];
        }
        const double length = std::sqrt(norm2(mode));
        for (double& x : mode) x /= length;
        for (auto& r : rest) {
            double along = 0.0;
            for (std::size_t c = 0; c < channels; ++c) along += mode[c] * r[c];
            for (std::size_t c = 0; c < channels; ++c) r[c] -= along * mode[c];
        }
        mode_.push_back(std::move(mode));
        left = 0.0;
        for (std::size_t g = 0; g < rest.size(); ++g) {
            const double n = norm2(rest[g]);
            if (n > left) left = n, worst = g;
        }
        error_ = std::sqrt(left);
        if (error_ <= tolerance) return;
        if (5 * mode_.size() >= 3 * channels) break;
    }
    mode_.assign(channels, std::vector<double>(channels, 0.0));
    for (std::size_t c = 0; c < channels; ++c) mode_[c][c] = 1.0;
    plain_ = true;
    error_ = 0.0;
}

void ModeBasis::project(const float* per_channel, float* out) const {
    std::fill_n(out, padded(), 0.0f);
    if (plain_) {
        std::copy_n(per_channel, channels_, out);
        return;
    }
    for (std::size_t k = 0; k < mode_.size(); ++k) {
        double sum = 0.0;
        for (std::size_t c = 0; c < channels_; ++c) sum += mode_[k][c] * double{per_channel[c]};
        out[k] = static_cast<float>(sum);
    }
}

std::vector<float> ModeBasis::product(std::span<const float> factor) const {
    if (plain_) {
        std::vector<float> diagonal(padded(), 0.0f);
        std::copy_n(factor.begin(), channels_, diagonal.begin());
        return diagonal;
    }
    std::vector<float> matrix(padded() * padded(), 0.0f);
    for (std::size_t in = 0; in < mode_.size(); ++in) {
        for (std::size_t out = 0; out <= in; ++out) {
            double sum = 0.0;
            for (std::size_t c = 0; c < channels_; ++c) {
                sum += mode_[in][c] * double{factor[c]} * mode_[out][c];
            }
            matrix[in * padded() + out] = matrix[out * padded() + in] = static_cast<float>(sum);
        }
    }
    return matrix;
}

void add_product(const std::vector<float>& product, const float* in, std::size_t padded,
                 float* out) {
    if (product.size() == padded) {
        const float* factor = product.data();
#pragma omp simd
        for (std::size_t c = 0; c < padded; ++c) out[c] += factor[c] * in[c];
        return;
    }
    using Lane = Eigen::Array<float, 8, 1>;
    for (std::size_t c = 0; c < padded; c += 8) {
        Lane sum = Eigen::Map<const Lane>(out + c);
        for (std::size_t k = 0; k < padded; ++k) {
            sum += in[k] * Eigen::Map<const Lane>(&product[k * padded + c]);
        }
        Eigen::Map<Lane>(out + c) = sum;
    }
}

ModeTable::ModeTable(const SurfaceTable& table, const ModeBasis& basis, std::size_t materials,
                     const std::vector<bool>& used, float temperature)
    : grid_(table.grid()), padded_(basis.padded()), optics_(materials) {
    const std::size_t n = table.padded(), rows = grid_.cells * 4;
    const auto in_modes = [&](std::span<const float> cubics) {
        std::vector<float> projected(rows * padded_);
        for (std::size_t r = 0; r < rows; ++r) {
            basis.project(&cubics[r * n], &projected[r * padded_]);
        }
        return projected;
    };
    black_ = in_modes(table.black_cubics());
    std::vector<float> emitted(n), reflectance(n);
    for (std::size_t m = 0; m < materials; ++m) {
        if (!used[m]) continue;
        const MaterialId id{static_cast<std::uint16_t>(m)};
        Optics& optics = optics_[m];
        optics.emitted = in_modes(table.emitted_cubics(id));
        table.surface(id, temperature, emitted.data(), reflectance.data());
        optics.reflection = basis.product(reflectance);
        optics.reflected.assign(black_.size(), 0.0f);
        for (std::size_t r = 0; r < rows; ++r) {
            add_product(optics.reflection, &black_[r * padded_], padded_,
                        &optics.reflected[r * padded_]);
        }
        optics.transparent = table.transparent(id);
        if (const float* room = table.room(id)) {
            optics.room.resize(padded_);
            basis.project(room, optics.room.data());
        }
    }
}

void ModeTable::black(float temperature, float* out) const {
    float t = 0.0f;
    const std::size_t cell = grid_.cell(temperature, t);
    evaluate_cubic(&black_[cell * 4 * padded_], padded_, t, out);
}

void ModeTable::emitted(MaterialId material, float temperature, float* out) const {
    float t = 0.0f;
    const std::size_t cell = grid_.cell(temperature, t);
    evaluate_cubic(&optics_[static_cast<std::size_t>(material)].emitted[cell * 4 * padded_],
                   padded_, t, out);
}

ModeTable::Cell ModeTable::cell(MaterialId material, float temperature) const {
    Cell cell{};
    const std::size_t at = grid_.cell(temperature, cell.t) * 4 * padded_;
    const Optics& optics = optics_[static_cast<std::size_t>(material)];
    cell.emitted = &optics.emitted[at];
    cell.reflected = &optics.reflected[at];
    cell.black = &black_[at];
    return cell;
}

const float* ModeTable::room(MaterialId material) const {
    const Optics& optics = optics_[static_cast<std::size_t>(material)];
    return optics.room.empty() ? nullptr : optics.room.data();
}

}  // namespace diurna
