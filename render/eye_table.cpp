#include "render/eye_table.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "terrain/parallel.hpp"

namespace diurna {

namespace {

using Lane = Eigen::Array<float, 8, 1>;
Eigen::Map<const Lane> load(const float* from) { return Eigen::Map<const Lane>(from); }

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

PathGrid::PathGrid(const PathTable& path, double ground_height_km)
    : ranges_(path.ranges()), heights_(path.heights()) {
    // The table's grid is uniform in the cube root of kilometres: a tenth of that of metres.
    places_per_root_ = static_cast<float>(0.1 * path.places_per_root());
    root_low_ = static_cast<float>(-10.0 * path.place(0.0) / path.places_per_root());
    places_per_height_ = static_cast<float>(1e-3 * path.places_per_height_km());
    height_low_ = static_cast<float>(1e3 * (path.least_height_km() - ground_height_km));
}

void PathGrid::place(std::span<const float> range, std::span<const float> range_root,
                     std::span<const float> height, GridPlaces& out) const {
    const std::size_t count = range.size();
    assert(count <= GridPlaces::most);
    const auto last = static_cast<float>(ranges_ - 4);
    for (std::size_t k = 0; k < count; ++k) {
        const float x = (range_root[k] - root_low_) * places_per_root_;
        float before = static_cast<float>(static_cast<int>(x)) - 1.0f;
        before = before < 0.0f ? 0.0f : before;
        before = before > last ? last : before;
        out.start[k] = static_cast<std::uint32_t>(static_cast<int>(before));
        const float t = x - before, a = t - 1.0f, b = t - 2.0f, c = t - 3.0f;
        const float slope = places_per_root_ * range_root[k] / (3.0f * range[k]);
        out.range[0][k] = a * b * c * (-1.0f / 6.0f);
        out.range[1][k] = t * b * c * 0.5f;
        out.range[2][k] = t * a * c * -0.5f;
        out.range[3][k] = t * a * b * (1.0f / 6.0f);
        out.range_slope[0][k] = slope * (a * b + a * c + b * c) * (-1.0f / 6.0f);
        out.range_slope[1][k] = slope * (t * b + t * c + b * c) * 0.5f;
        out.range_slope[2][k] = slope * (t * a + t * c + a * c) * -0.5f;
        out.range_slope[3][k] = slope * (t * a + t * b + a * b) * (1.0f / 6.0f);
    }
    const float scale = places_per_height_;
    for (std::size_t k = 0; k < count; ++k) {
        const float y = (height[k] - height_low_) * scale;
        if (heights_ == 2) {
            out.height[0][k] = 1.0f - y;
            out.height[1][k] = y;
            out.height_slope[0][k] = -scale;
            out.height_slope[1][k] = scale;
        } else if (heights_ == 3) {
            out.height[0][k] = 0.5f * (y - 1.0f) * (y - 2.0f);
            out.height[1][k] = y * (2.0f - y);
            out.height[2][k] = 0.5f * y * (y - 1.0f);
            out.height_slope[0][k] = scale * (y - 1.5f);
            out.height_slope[1][k] = scale * (2.0f - 2.0f * y);
            out.height_slope[2][k] = scale * (y - 0.5f);
        } else {
            const float a = y - 1.0f, b = y - 2.0f, c = y - 3.0f, d = y - 4.0f;
            const float ab = a * b, cd = c * d, ya = y * a;
            const float dab = a + b, dcd = c + d, dya = y + a;
            out.height[0][k] = ab * cd * (1.0f / 24.0f);
            out.height[1][k] = y * b * cd * (-1.0f / 6.0f);
            out.height[2][k] = ya * cd * 0.25f;
            out.height[3][k] = ya * b * d * (-1.0f / 6.0f);
            out.height[4][k] = ya * b * c * (1.0f / 24.0f);
            out.height_slope[0][k] = scale * (dab * cd + ab * dcd) * (1.0f / 24.0f);
            out.height_slope[1][k] = scale * ((y + b) * cd + y * b * dcd) * (-1.0f / 6.0f);
            out.height_slope[2][k] = scale * (dya * cd + ya * dcd) * 0.25f;
            out.height_slope[3][k] = scale * (dya * b * d + ya * (b + d)) * (-1.0f / 6.0f);
            out.height_slope[4][k] = scale * (dya * b * c + ya * (b + c)) * (1.0f / 24.0f);
        }
    }
}

EyeTable::EyeTable(const PathTable& path, std::size_t band_index, const Band& band,
                   const Channels& channels, const SpectralBasis& basis,
                   std::span<const NodeOptics> optics, const std::array<Light, 3>& light,
                   const TermSet& terms)
    : heights_(path.heights()), table_(optics.size()) {
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

/// Eight numbers of the row at a time stay in registers.
template <std::size_t Heights>
AtEye EyeTable::at(const float* table, const GridPlaces& places, std::size_t k,
                   const float* row) const {
    const std::size_t n = width_, stride = Heights * n;
    const float* first = table + places.start[k] * stride;
    const auto &w = places.range, &s = places.range_slope;
    Lane value = Lane::Zero(), by_range = Lane::Zero(), by_height = Lane::Zero();
    for (std::size_t j = 0; j < n; j += 8) {
        Lane here = Lane::Zero(), deeper = Lane::Zero(), higher = Lane::Zero();
        for (std::size_t h = 0; h < Heights; ++h) {
            const float* t = first + h * n + j;
            const Lane t0 = load(t), t1 = load(t + stride), t2 = load(t + 2 * stride),
                       t3 = load(t + 3 * stride);
            const Lane across = w[0][k] * t0 + w[1][k] * t1 + w[2][k] * t2 + w[3][k] * t3;
            here += places.height[h][k] * across;
            higher += places.height_slope[h][k] * across;
            deeper +=
                places.height[h][k] * (s[0][k] * t0 + s[1][k] * t1 + s[2][k] * t2 + s[3][k] * t3);
        }
        const Lane from = load(row + j);
        value += from * here;
        by_range += from * deeper;
        by_height += from * higher;
    }
    return {value.sum(), by_range.sum(), by_height.sum()};
}

AtEye EyeTable::operator()(MaterialId material, const GridPlaces& places, std::size_t k,
                           const float* row) const {
    const float* table = table_[index(material)].data();
    switch (heights_) {
        case 2:
            return at<2>(table, places, k, row);
        case 3:
            return at<3>(table, places, k, row);
        default:
            return at<5>(table, places, k, row);
    }
}

}  // namespace diurna
