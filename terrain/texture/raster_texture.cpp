#include "terrain/texture/raster_texture.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

namespace diurna {

namespace {

int wrapped(int i, int n) { return ((i % n) + n) % n; }

}  // namespace

RasterTexture::RasterTexture(Layout layout) : layout_(std::move(layout)) {
    level_.push_back({layout_.columns, layout_.rows, std::move(layout_.value)});
    while (level_.back().columns > 1 || level_.back().rows > 1) {
        level_.push_back(halved(level_.back()));
    }
    Eigen::Matrix2d turn;
    turn << layout_.to_texel[1], layout_.to_texel[2];
    texel_ = 1.0 / std::sqrt(std::abs(turn.determinant()));
}

Eigen::Vector2d RasterTexture::texel_at(double x, double y) const {
    const auto& p = layout_.to_texel;
    return p[0] + x * (p[1] + x * p[3] + y * p[4]) + y * (p[2] + y * p[5]);
}

double RasterTexture::look_up(const Grid& level, double column, double row) const {
    const auto value = [&](int c, int r) -> double {
        if (layout_.repeat) {
            c = wrapped(c, level.columns);
            r = wrapped(r, level.rows);
        } else {
            c = std::clamp(c, 0, level.columns - 1);
            r = std::clamp(r, 0, level.rows - 1);
        }
        return double{level.at(r, c)};
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
    const Grid& level = level_.front();
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
            include(level.at(wrapped(int(r), level.rows), wrapped(int(c), level.columns)));
        }
    }
    return range;
}

}  // namespace diurna
