#include "render/eye/eye_table.hpp"

#include <immintrin.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"

namespace diurna {

namespace {

using Lane = Eigen::Array<float, 8, 1>;
Eigen::Map<const Lane> load(const float* from) { return Eigen::Map<const Lane>(from); }

/// Of four registers at once, as a pairwise tree.
std::array<float, 4> sums(const Lane& a, const Lane& b, const Lane& c, const Lane& d) {
    std::array<float, 4> out;
    const __m256 pairs =
        _mm256_hadd_ps(_mm256_hadd_ps(_mm256_loadu_ps(a.data()), _mm256_loadu_ps(b.data())),
                       _mm256_hadd_ps(_mm256_loadu_ps(c.data()), _mm256_loadu_ps(d.data())));
    _mm_storeu_ps(out.data(),
                  _mm_add_ps(_mm256_castps256_ps128(pairs), _mm256_extractf128_ps(pairs, 1)));
    return out;
}

bool has(const TermSet& terms, Term term) { return terms[static_cast<std::size_t>(term)]; }

/// Sums over the nodes of each channel of weight × what a number of an EyeRow stands for: (channel,
/// number).
Eigen::MatrixXd channel_weights(const Band& band, const Channels& channels,
                                const SpectralBasis& basis, const NodeOptics& optics,
                                const std::array<Light, 3>& light, const TermSet& terms,
                                const EyeRow& layout) {
    Eigen::MatrixXd sums(channels.size(), layout.width());
    sums.setZero();
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const auto at = static_cast<Eigen::Index>(c);
        for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
            const auto node = static_cast<Eigen::Index>(n);
            const double w = band.weight[n], root = basis.root_weight[node];
            double own = has(terms, Term::emitted) ? optics.emissivity[n] : 0.0;
            if (has(terms, Term::behind) && optics.transparent) {
                if (optics.room.empty()) {
                    own += optics.transmittance[n];
                } else {
                    sums(at, static_cast<Eigen::Index>(layout.one())) += w * optics.room[n];
                }
            }
            const double reflectance = optics.reflectance[n];
            for (std::size_t k = 0; k < basis.thermal; ++k) {
                const auto mode = static_cast<Eigen::Index>(k);
                sums(at, mode) += root * own * basis.mode(node, mode);
            }
            if (has(terms, Term::surroundings)) {
                for (std::size_t k = 0; k < basis.size(); ++k) {
                    const auto mode = static_cast<Eigen::Index>(k);
                    sums(at, static_cast<Eigen::Index>(layout.thermal) + mode) +=
                        root * reflectance * basis.mode(node, mode);
                }
            }
            for (std::size_t h = 0; h < 3; ++h) {
                if (has(terms, Term::sky)) {
                    sums(at, static_cast<Eigen::Index>(layout.sky() + h)) +=
                        w * reflectance * light[h].sky[n];
                }
                if (has(terms, Term::sun)) {
                    sums(at, static_cast<Eigen::Index>(layout.sun() + h)) +=
                        w * reflectance * light[h].sun[n];
                }
            }
        }
    }
    return sums;
}

}  // namespace

namespace {

/// Matrix (fine node, coarse node) that interpolates on a uniform grid: cubic Lagrange, or
/// polynomials through all nodes where there are fewer than six.
Eigen::MatrixXd interpolation(std::size_t coarse, std::size_t fine) {
    const std::size_t taps = coarse < 6 ? coarse : 4;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(Eigen::Index(fine), Eigen::Index(coarse));
    for (std::size_t i = 0; i < fine; ++i) {
        const double x = double(i) * double(coarse - 1) / double(fine - 1);
        const double first =
            taps == coarse ? 0.0 : std::clamp(std::floor(x) - 1.0, 0.0, double(coarse - taps));
        for (std::size_t j = 0; j < taps; ++j) {
            double weight = 1.0;
            for (std::size_t k = 0; k < taps; ++k) {
                if (k != j) weight *= (x - first - double(k)) / (double(j) - double(k));
            }
            matrix(Eigen::Index(i), Eigen::Index(first) + Eigen::Index(j)) = weight;
        }
    }
    return matrix;
}

/// The greatest error of straight cells along the columns, in kelvins of the band.
double straight_error(const Band& band, const Eigen::MatrixXd& fine) {
    double worst = 0.0;
    for (Eigen::Index j = 0; j < fine.cols(); ++j) {
        const double least = fine.col(j).minCoeff();
        if (!(least > 0.0)) continue;
        double bend = 0.0;
        for (Eigen::Index i = 1; i + 1 < fine.rows(); ++i) {
            bend =
                std::max(bend, std::abs(fine(i - 1, j) - 2.0 * fine(i, j) + fine(i + 1, j)) / 8.0);
        }
        worst = std::max(
            worst, bend / band_radiance_derivative(band, brightness_temperature(band, least)));
    }
    return worst;
}

}  // namespace

EyeGrid eye_grid(const PathTable& path, double ground_height_km, std::span<const Band> bands,
                 std::span<const std::vector<Eigen::MatrixXd>> worth, double tolerance) {
    constexpr std::size_t most_ranges = 1025, most_heights = 129;
    EyeGrid grid{.ranges = 4 * (path.ranges() - 1) + 1, .heights = 4 * (path.heights() - 1) + 1};
    // Second differences fall to a quarter with each halving.
    const auto refine = [&](std::size_t coarse, std::size_t most, bool along_ranges,
                            std::size_t& fine) {
        double error = 0.0;
        const Eigen::MatrixXd matrix = interpolation(coarse, fine);
        for (std::size_t b = 0; b < bands.size(); ++b) {
            for (const Eigen::MatrixXd& w : worth[b]) {
                error = std::max(
                    error,
                    straight_error(bands[b], along_ranges ? (matrix * w).eval()
                                                          : (matrix * w.transpose()).eval()));
            }
        }
        while (error > tolerance && 2 * fine - 1 <= most) {
            fine = 2 * fine - 1;
            error /= 4.0;
        }
        return error;
    };
    grid.error = refine(path.ranges(), most_ranges, true, grid.ranges) +
                 refine(path.heights(), most_heights, false, grid.heights);
    // The table's grid is uniform in the cube root of kilometres: a tenth of that of metres.
    const double finer = double(grid.ranges - 1) / double(path.ranges() - 1);
    grid.per_root = static_cast<float>(0.1 * path.places_per_root() * finer);
    grid.root_low = static_cast<float>(-10.0 * path.place(0.0) / path.places_per_root());
    grid.per_height = static_cast<float>(1e-3 * path.places_per_height_km() *
                                         double(grid.heights - 1) / double(path.heights() - 1));
    grid.height_low = static_cast<float>(1e3 * (path.least_height_km() - ground_height_km));
    return grid;
}

void find_places(const EyeGrid& grid, std::span<const float> range,
                 std::span<const float> range_root, std::span<const float> height,
                 GridPlaces& out) {
    const std::size_t count = range.size();
    assert(count <= GridPlaces::most);
    const auto last_range = static_cast<float>(grid.ranges - 2),
               last_height = static_cast<float>(grid.heights - 2);
    const auto stride = static_cast<std::int32_t>(grid.heights);
    const auto cell = [](float x, float last) {
        const float c = x < 0.0f ? 0.0f : x;
        return static_cast<std::int32_t>(c > last ? last : c);
    };
    for (std::size_t k = 0; k < count; ++k) {
        const float x = (range_root[k] - grid.root_low) * grid.per_root;
        const float y = (height[k] - grid.height_low) * grid.per_height;
        const std::int32_t i = cell(x, last_range), j = cell(y, last_height);
        out.start[k] = static_cast<std::uint32_t>(i * stride + j);
        out.range[k] = x - static_cast<float>(i);
        out.height[k] = y - static_cast<float>(j);
        out.per_metre[k] = grid.per_root * range_root[k] / (3.0f * range[k]);
    }
}

std::vector<float> EyeRow::standing_for(const LightTables& tables, std::size_t band,
                                        float temperature, bool sunny) const {
    std::vector<float> black(tables.lanes), row(width(), 0.0f);
    black_modes(tables, temperature, black.data());
    std::vector<float> around = black;
    for (float& x : around) x *= 0.5f;
    fill(&black[tables.first[band]], &around[tables.first[band]], 0.5f,
         sunny ? 0.5f / std::numbers::pi_v<float> : 0.0f, {0.0f, 1.0f, 0.0f}, row.data());
    return row;
}

EyeTable::EyeTable(const PathTable& path, std::size_t band_index, const Band& band,
                   const Channels& channels, const SpectralBasis& basis,
                   std::span<const NodeOptics> optics, const std::array<Light, 3>& light,
                   const TermSet& terms)
    : ranges_(path.ranges()), heights_(path.heights()), table_(optics.size()) {
    const EyeRow layout(basis);
    width_ = layout.width();
    const std::size_t nodes = path.ranges() * heights_;
    Eigen::MatrixXd transmittance(nodes, channels.size());
    for (std::size_t k = 0; k < nodes; ++k) {
        const float* t = path.transmittance(band_index, k / heights_, k % heights_);
        for (std::size_t c = 0; c < channels.size(); ++c) {
            transmittance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = t[c];
        }
    }
    for_each_index(
        optics.size(),
        [&](std::size_t m) {
            if (optics[m].reflectance.empty()) return;
            Eigen::MatrixXd worth =
                transmittance *
                channel_weights(band, channels, basis, optics[m], light, terms, layout);
            if (has(terms, Term::path)) {
                for (std::size_t k = 0; k < nodes; ++k) {
                    worth(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(layout.one())) +=
                        double{path.radiance(band_index, k / heights_, k % heights_)};
                }
            }
            table_[m].resize(nodes * width_);
            Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                table_[m].data(), worth.rows(), worth.cols()) = worth.cast<float>();
        },
        1);
}

std::vector<Eigen::MatrixXd> EyeTable::worth(std::span<const float> row) const {
    std::vector<Eigen::MatrixXd> all;
    for (const std::vector<float>& table : table_) {
        if (table.empty()) continue;
        Eigen::MatrixXd& worth = all.emplace_back(ranges_, heights_);
        for (std::size_t k = 0; k < ranges_ * heights_; ++k) {
            double sum = 0.0;
            for (std::size_t j = 0; j < row.size(); ++j) {
                sum += double{row[j]} * double{table[k * width_ + j]};
            }
            worth(Eigen::Index(k / heights_), Eigen::Index(k % heights_)) = sum;
        }
    }
    return all;
}

void EyeTable::refine(const EyeGrid& grid) {
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXf by_range = interpolation(ranges_, grid.ranges).cast<float>();
    const Eigen::MatrixXf by_height = interpolation(heights_, grid.heights).cast<float>();
    const auto width = Eigen::Index(width_);
    for_each_index(
        table_.size(),
        [&](std::size_t m) {
            if (table_[m].empty()) return;
            // Heights first, of few ranges; then ranges, of whole rows.
            std::vector<float> higher(ranges_ * grid.heights * width_);
            for (std::size_t i = 0; i < ranges_; ++i) {
                Eigen::Map<Rows>(&higher[i * grid.heights * width_], Eigen::Index(grid.heights),
                                 width) =
                    by_height * Eigen::Map<const Rows>(&table_[m][i * heights_ * width_],
                                                       Eigen::Index(heights_), width);
            }
            const std::size_t row = grid.heights * width_;
            std::vector<float> fine(grid.ranges * row, 0.0f);
            for (std::size_t i = 0; i < grid.ranges; ++i) {
                float* to = &fine[i * row];
                for (std::size_t j = 0; j < ranges_; ++j) {
                    const float w = by_range(Eigen::Index(i), Eigen::Index(j));
                    if (w == 0.0f) continue;
                    const float* from = &higher[j * row];
#pragma omp simd
                    for (std::size_t k = 0; k < row; ++k) to[k] += w * from[k];
                }
            }
            table_[m] = std::move(fine);
        },
        1);
    ranges_ = grid.ranges;
    heights_ = grid.heights;
    per_height_ = grid.per_height;
}

void EyeTable::look(const GridPlaces& places, const TargetRows& facets, const float* rows,
                    std::size_t count, std::size_t stride, AtEye* out) const {
    const std::size_t n = width_, far = heights_ * n;
    for (std::size_t k = 0; k < count; ++k) {
        const float* node = table_[index(facets.material[k])].data() + places.start[k] * n;
        const float* row = rows + facets.slot[k] * n;
        Lane near_low = Lane::Zero(), near_high = near_low, far_low = near_low, far_high = near_low;
        for (std::size_t j = 0; j < n; j += 8) {
            const Lane from = load(row + j);
            near_low += from * load(node + j);
            near_high += from * load(node + n + j);
            far_low += from * load(node + far + j);
            far_high += from * load(node + far + n + j);
        }
        const float x = places.range[k], y = places.height[k];
        const std::array<float, 4> corner = sums(near_low, near_high, far_low, far_high);
        const float up_near = corner[1] - corner[0], up_far = corner[3] - corner[2];
        const float at_near = corner[0] + y * up_near, at_far = corner[2] + y * up_far;
        const float deeper = at_far - at_near;
        out[k * stride] = {at_near + x * deeper, deeper * places.per_metre[k],
                           (up_near + x * (up_far - up_near)) * per_height_};
    }
}

}  // namespace diurna
