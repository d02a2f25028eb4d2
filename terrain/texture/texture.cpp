#include "terrain/texture/texture.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

int wrapped(int i, int n) { return ((i % n) + n) % n; }

}  // namespace

RasterTexture::RasterTexture(Layout layout) : layout_(std::move(layout)) {
    level_.push_back({layout_.columns, layout_.rows, std::move(layout_.value)});
    while (level_.back().columns > 1 || level_.back().rows > 1) {
        const Level& fine = level_.back();
        Level coarse{(fine.columns + 1) / 2, (fine.rows + 1) / 2, {}};
        coarse.value.reserve(std::size_t(coarse.columns) * std::size_t(coarse.rows));
        for (int row = 0; row < coarse.rows; ++row) {
            for (int column = 0; column < coarse.columns; ++column) {
                double sum = 0.0;
                int count = 0;
                for (int r = 2 * row; r < std::min(2 * row + 2, fine.rows); ++r) {
                    for (int c = 2 * column; c < std::min(2 * column + 2, fine.columns); ++c) {
                        const float v =
                            fine.value[std::size_t(r) * std::size_t(fine.columns) + std::size_t(c)];
                        if (std::isnan(v)) continue;
                        sum += double{v};
                        ++count;
                    }
                }
                coarse.value.push_back(count > 0 ? static_cast<float>(sum / count)
                                                 : std::numeric_limits<float>::quiet_NaN());
            }
        }
        level_.push_back(std::move(coarse));
    }
    Eigen::Matrix2d turn;
    turn << layout_.to_texel[1], layout_.to_texel[2];
    texel_ = 1.0 / std::sqrt(std::abs(turn.determinant()));
}

Eigen::Vector2d RasterTexture::texel_at(double x, double y) const {
    const auto& p = layout_.to_texel;
    return p[0] + x * (p[1] + x * p[3] + y * p[4]) + y * (p[2] + y * p[5]);
}

double RasterTexture::look_up(const Level& level, double column, double row) const {
    const auto value = [&](int c, int r) -> double {
        if (layout_.repeat) {
            c = wrapped(c, level.columns);
            r = wrapped(r, level.rows);
        } else {
            c = std::clamp(c, 0, level.columns - 1);
            r = std::clamp(r, 0, level.rows - 1);
        }
        return double{level.value[std::size_t(r) * std::size_t(level.columns) + std::size_t(c)]};
    };
    if (layout_.nearest) {
        return value(static_cast<int>(std::floor(column)), static_cast<int>(std::floor(row)));
    }
    const double x = column - 0.5, y = row - 0.5;
    const double left = std::floor(x), above = std::floor(y);
    double sum = 0.0, weight = 0.0;
    for (int j = 0; j < 2; ++j) {
        for (int i = 0; i < 2; ++i) {
            const double w =
                (i == 0 ? 1.0 - (x - left) : x - left) * (j == 0 ? 1.0 - (y - above) : y - above);
            const double v = value(static_cast<int>(left) + i, static_cast<int>(above) + j);
            if (std::isnan(v) || w == 0.0) continue;
            sum += w * v;
            weight += w;
        }
    }
    return weight > 0.0 ? sum / weight : std::numeric_limits<double>::quiet_NaN();
}

double RasterTexture::at(double x, double y, double spacing) const {
    const Eigen::Vector2d at = texel_at(x, y);
    if (!layout_.repeat &&
        !(at.x() >= 0.0 && at.y() >= 0.0 && at.x() <= layout_.columns && at.y() <= layout_.rows)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    std::size_t level = 0;
    double size = 1.0;
    while (level + 1 < level_.size() && 1.5 * size * texel_ <= spacing) {
        size *= 2.0;
        ++level;
    }
    return look_up(level_[level], at.x() / size, at.y() / size);
}

std::array<double, 2> RasterTexture::range(std::span<const Eigen::Vector2d> places) const {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    constexpr long most = 1 << 14;
    Eigen::Vector2d low = Eigen::Vector2d::Constant(1e300), high = -low;
    for (const Eigen::Vector2d& place : places) {
        const Eigen::Vector2d at = texel_at(place.x(), place.y());
        low = low.cwiseMin(at);
        high = high.cwiseMax(at);
    }
    // A texel around, where values run from one to the next; a border belongs to those within.
    const double around = layout_.nearest ? -1e-4 : 0.5;
    Eigen::Vector2d first = (low.array() - around).floor(), last = (high.array() + around).floor();
    last = last.cwiseMax(first);
    if (!layout_.repeat) {
        first = first.cwiseMax(0.0);
        last = last.cwiseMin(Eigen::Vector2d(layout_.columns - 1, layout_.rows - 1));
        if (first.x() > last.x() || first.y() > last.y()) return {none, none};
    }
    const Level& level = level_.front();
    const double cells = (last.x() - first.x() + 1.0) * (last.y() - first.y() + 1.0);
    std::array<double, 2> range{none, none};
    const auto include = [&](float v) {
        if (std::isnan(v)) return;
        range[0] = range[0] <= double{v} ? range[0] : double{v};
        range[1] = range[1] >= double{v} ? range[1] : double{v};
    };
    if (cells > double(most)) {
        for (const float v : level.value) include(v);
        return range;
    }
    for (long r = std::lround(first.y()); r <= std::lround(last.y()); ++r) {
        for (long c = std::lround(first.x()); c <= std::lround(last.x()); ++c) {
            include(
                level.value[std::size_t(wrapped(int(r), level.rows)) * std::size_t(level.columns) +
                            std::size_t(wrapped(int(c), level.columns))]);
        }
    }
    return range;
}

Eigen::Vector2d texture_place(const TextureFrame& frame, const Eigen::Vector3d& place,
                              const Eigen::Vector3f& normal) {
    const Eigen::Vector3d from = place - frame.origin;
    constexpr float steep = 0.6f;
    if (std::abs(normal.z()) >= steep) {
        const double c = std::cos(frame.heading), s = std::sin(frame.heading);
        return {c * from.x() - s * from.y(), s * from.x() + c * from.y()};
    }
    const Eigen::Vector2d out = normal.head<2>().cast<double>().normalized();
    return {from.y() * out.x() - from.x() * out.y(), from.z()};
}

double texture_at(const Texture& texture, const Eigen::Vector2d& place, double spacing) {
    if (const auto* raster = std::get_if<RasterTexture>(&texture)) {
        return raster->at(place.x(), place.y(), spacing);
    }
    const auto& clutter = std::get<ClutterTexture>(texture);
    return clutter.mean + clutter.deviation * clutter.field.at(place.x(), place.y(), spacing);
}

}  // namespace diurna
