#include "render/eye/eye_table.hpp"

#include <immintrin.h>

#include "materials/base/parallel.hpp"
#include "render/eye/eye_row.hpp"
#include "render/light/origin.hpp"

namespace diurna {

namespace {

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

/// What the numbers of an EyeRow represent, before the air, in one material.
struct RowWorth {
    const BandLight& band;
    const NodeOptics& optics;
    const TermSet& terms;
    EyeRow layout;
    using Row = Eigen::Ref<Eigen::RowVectorXd>;

    static Eigen::Index at(std::size_t number) { return static_cast<Eigen::Index>(number); }

    /// Adds what a surface sends of itself at a node.
    void add_own(std::size_t n, Row row) const {
        const SpectralBasis& basis = band.basis;
        double own = has(terms, Term::emitted) ? optics.emissivity[n] : 0.0;
        if (has(terms, Term::behind) && optics.transparent) {
            if (optics.room.empty()) {
                own += optics.transmittance[n];
            } else {
                row[at(layout.one())] += band.band.weight[n] * optics.room[n];
            }
        }
        const double root = basis.root_weight[at(n)];
        for (std::size_t k = 0; k < basis.thermal; ++k) {
            row[at(k)] += root * own * basis.mode(at(n), at(k));
        }
    }

    /// Adds what it reflects of light of an origin, that of other surfaces, of the sky and the sun.
    void add_reflected(Origin origin, std::size_t n, Row row) const {
        const double reflectance = optics.reflectance[n], w = band.band.weight[n];
        if (has(terms, Term::surroundings)) {
            const double root = band.basis.root_weight[at(n)];
            for (std::size_t k = 0; k < band.basis.size(); ++k) {
                const auto light = band.basis.by_origin(band.basis.mode.col(at(k)), n);
                row[at(layout.thermal + k)] +=
                    root * reflectance * light[static_cast<std::size_t>(origin)];
            }
        }
        for (std::size_t k = 0; k < layout.skies && has(terms, Term::sky); ++k) {
            const std::vector<double>& sky = from(band.sky.spectrum[k], origin);
            if (!sky.empty()) row[at(layout.sky() + k)] += w * reflectance * sky[n];
        }
        if (!has(terms, Term::sun) || origin != Origin::sunlight) return;
        for (std::size_t h = 0; h < band.incident.size(); ++h) {
            row[at(layout.sun() + h)] += w * reflectance * band.incident[h].from_sun(n);
        }
    }
};

/// Sums over the nodes of each channel of weight × what the numbers of an EyeRow represent of an
/// origin's light: (channel, number).
Eigen::MatrixXd channel_weights(const RowWorth& worth, Origin origin) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Channels& channels = worth.band.channels;
    Rows sums = Rows::Zero(Eigen::Index(channels.size()), Eigen::Index(worth.layout.width()));
    for (std::size_t c = 0; c < channels.size(); ++c) {
        auto row = sums.row(static_cast<Eigen::Index>(c));
        for (std::size_t n = channels.first[c]; n < channels.first[c + 1]; ++n) {
            if (origin == Origin::surface) worth.add_own(n, row);
            worth.add_reflected(origin, n, row);
        }
    }
    return sums;
}

/// Transmittance of an origin's light at the nodes of a path: (node, channel).
Eigen::MatrixXd transmittances(const PathTable& path, std::size_t band, std::size_t channels,
                               Origin origin) {
    Eigen::MatrixXd transmittance(path.nodes(), channels);
    for (std::size_t k = 0; k < path.nodes(); ++k) {
        const float* t = path.transmittance(band, k, origin);
        for (std::size_t c = 0; c < channels; ++c) {
            transmittance(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(c)) = t[c];
        }
    }
    return transmittance;
}

}  // namespace

EyeTable::EyeTable(const PathTable& path, std::size_t band_index, const BandLight& band,
                   const TermSet& terms)
    : ranges_(path.grid().ranges), heights_(path.grid().heights), table_(band.optics.size()) {
    const EyeRow layout(band);
    width_ = layout.width();
    const std::size_t nodes = path.nodes();
    std::array<Eigen::MatrixXd, origin_count> transmittance;
    for (const Origin origin : all_origins) {
        transmittance[static_cast<std::size_t>(origin)] =
            transmittances(path, band_index, band.channels.size(), origin);
    }
    for_each_index(
        table_.size(),
        [&](std::size_t m) {
            const NodeOptics& optics = band.optics[m];
            if (optics.reflectance.empty()) return;
            const RowWorth worth{band, optics, terms, layout};
            Eigen::MatrixXd at_eye =
                Eigen::MatrixXd::Zero(Eigen::Index(nodes), Eigen::Index(width_));
            for (const Origin origin : all_origins) {
                at_eye += transmittance[static_cast<std::size_t>(origin)] *
                          channel_weights(worth, origin);
            }
            if (has(terms, Term::path)) {
                for (std::size_t k = 0; k < nodes; ++k) {
                    at_eye(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(layout.one())) +=
                        double{path.radiance(band_index, k)};
                }
            }
            table_[m].resize(nodes * width_);
            Eigen::Map<Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>(
                table_[m].data(), at_eye.rows(), at_eye.cols()) = at_eye.cast<float>();
        },
        1);
}

std::vector<double> worth_on_leaving(const BandLight& band, const NodeOptics& optics,
                                     const TermSet& terms) {
    const RowWorth worth{band, optics, terms, EyeRow(band)};
    Eigen::RowVectorXd sum = Eigen::RowVectorXd::Zero(Eigen::Index(worth.layout.width()));
    for (const Origin origin : all_origins) {
        sum += channel_weights(worth, origin).colwise().sum();
    }
    return {sum.begin(), sum.end()};
}

std::vector<Eigen::MatrixXd> EyeTable::radiance_of(std::span<const float> row) const {
    std::vector<Eigen::MatrixXd> all;
    for (const std::vector<float>& table : table_) {
        if (table.empty()) continue;
        Eigen::MatrixXd& radiance = all.emplace_back(ranges_, heights_);
        for (std::size_t k = 0; k < ranges_ * heights_; ++k) {
            double sum = 0.0;
            for (std::size_t j = 0; j < row.size(); ++j) {
                sum += double{row[j]} * double{table[k * width_ + j]};
            }
            radiance(Eigen::Index(k / heights_), Eigen::Index(k % heights_)) = sum;
        }
    }
    return all;
}

void EyeTable::refine(const EyeGrid& grid) {
    using Rows = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::MatrixXf by_range = interpolation_matrix(ranges_, grid.ranges).cast<float>();
    const Eigen::MatrixXf by_height = interpolation_matrix(heights_, grid.heights).cast<float>();
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
