#include "render/view/pixel_samples.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/base/random.hpp"

namespace diurna {

namespace {

constexpr std::size_t sample_lanes = RayBundles::lanes;

/// 32 bits that depend on seed and pixel alone, and then on the sample.
std::uint32_t pixel_hash(std::uint64_t seed, std::uint64_t pixel) {
    return static_cast<std::uint32_t>(spread_bits(seed * golden_step + pixel * second_step) >> 16);
}
inline std::uint32_t sample_hash(std::uint32_t pixel, std::uint32_t sample) {
    return spread_bits(pixel ^ (sample * golden_step32));
}

}  // namespace

PixelSamples::PixelSamples(const Observer& observer, int samples, std::uint64_t seed)
    : eye_(pixel_rays(observer)),
      position_(observer.position),
      starts_differ_(observer.projection == Projection::orthographic || observer.moves()),
      takes_time_(observer.takes_time()),
      origin_(observer.position.cast<float>()),
      width_(static_cast<std::size_t>(observer.width)),
      height_(static_cast<std::size_t>(observer.height)),
      samples_(static_cast<std::size_t>(samples)),
      seed_(seed) {
    if (takes_time_) {
        row_time_ = 0.5 * observer.row_time / observer.reach();
        exposure_ = 0.5 * observer.exposure / observer.reach();
    }
    const auto [columns, rows] = nearly_square(samples);
    columns_ = static_cast<std::size_t>(columns);
    const std::size_t whole = (samples_ + sample_lanes - 1) / sample_lanes * sample_lanes;
    for (std::size_t s = 0; s < whole; ++s) {
        const auto cell = static_cast<int>(s < samples_ ? s : s / sample_lanes * sample_lanes);
        right_.push_back(static_cast<float>(cell % columns) / static_cast<float>(columns));
        down_.push_back(static_cast<float>(cell / columns) / static_cast<float>(rows));
    }
    cell_right_ = 0x1p-16f / static_cast<float>(columns);
    cell_down_ = 0x1p-16f / static_cast<float>(rows);
}

inline void PixelSamples::aim_at(std::size_t column, std::size_t row, const Places& places,
                                 std::size_t bundle, RayBundles& rays) const {
    const std::size_t at = bundle * sample_lanes;
    const float *right = places.right, *down = places.down;
    float *to_x = rays.direction_x + at, *to_y = rays.direction_y + at,
          *to_z = rays.direction_z + at;
    if (!eye_.flat) {
        for (std::size_t s = 0; s < sample_lanes; ++s) {
            const double x = double(column) + double{right[s]}, y = double(row) + double{down[s]};
            const Eigen::Vector3f to = eye_.still(x, y).cast<float>();
            to_x[s] = to.x(), to_y[s] = to.y(), to_z[s] = to.z();
        }
        return;
    }
    const Eigen::Vector3f from =
        (eye_.corner + double(column) * eye_.column + double(row) * eye_.row).cast<float>();
    const Eigen::Vector3f a = eye_.column.cast<float>(), b = eye_.row.cast<float>();
    const float fx = from.x(), fy = from.y(), fz = from.z(), ax = a.x(), ay = a.y(), az = a.z(),
                bx = b.x(), by = b.y(), bz = b.z();
#pragma omp simd
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        const float dx = fx + right[s] * ax + down[s] * bx;
        const float dy = fy + right[s] * ay + down[s] * by;
        const float dz = fz + right[s] * az + down[s] * bz;
        const float scale = 1.0f / std::sqrt(dx * dx + dy * dy + dz * dz);
        to_x[s] = dx * scale;
        to_y[s] = dy * scale;
        to_z[s] = dz * scale;
    }
}

void PixelSamples::time_at(std::size_t row, const Places& places, std::span<const float> when,
                           std::size_t bundle, RayBundles& rays) const {
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        const double of_row = std::floor(double(row) + double{places.down[s]}) * row_time_;
        rays.time[bundle * sample_lanes + s] =
            static_cast<float>(0.5 + of_row + (double{when[s]} - 0.5) * exposure_);
    }
}

void PixelSamples::start_at(std::size_t column, std::size_t row, const Places& places,
                            std::span<const float> when, std::size_t bundle,
                            RayBundles& rays) const {
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        const double x = double(column) + double{places.right[s]};
        const double y = double(row) + double{places.down[s]};
        const Eigen::Vector3f from = (position_ + eye_.start(x, y, when[s])).cast<float>();
        rays.origin_x[bundle * sample_lanes + s] = from.x();
        rays.origin_y[bundle * sample_lanes + s] = from.y();
        rays.origin_z[bundle * sample_lanes + s] = from.z();
    }
}

void PixelSamples::turn_at(std::size_t row, const Places& places, std::span<const float> when,
                           std::size_t bundle, RayBundles& rays) const {
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        const std::size_t at = bundle * sample_lanes + s;
        const Eigen::Vector3d to{rays.direction_x[at], rays.direction_y[at], rays.direction_z[at]};
        const Eigen::Vector3f turned =
            eye_.turned(to, double(row) + double{places.down[s]}, when[s]).cast<float>();
        rays.direction_x[at] = turned.x();
        rays.direction_y[at] = turned.y();
        rays.direction_z[at] = turned.z();
    }
}

void PixelSamples::aim(std::size_t column, std::size_t row, std::size_t part, std::size_t at,
                       RayBundles& rays) const {
    const std::size_t first = part * sample_lanes;
    const std::uint32_t hash = pixel_hash(seed_, row * width_ + column);
    const float *from_right = &right_[first], *from_down = &down_[first];
    Places places;
#pragma omp simd
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        const std::uint32_t bits = sample_hash(hash, static_cast<std::uint32_t>(first + s));
        const auto i = static_cast<float>(static_cast<std::int32_t>(bits >> 16));
        const auto j = static_cast<float>(static_cast<std::int32_t>(bits & 0xFFFFu));
        places.right[s] = from_right[s] + cell_right_ * (i + 0.5f);
        places.down[s] = from_down[s] + cell_down_ * (j + 0.5f);
    }
    aim_at(column, row, places, at, rays);
    if (!starts_differ_ && !takes_time_) return;
    std::array<float, sample_lanes> when;
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        when[s] = static_cast<float>(exposed(first + s, double(hash) * 0x1p-32));
    }
    if (takes_time_) time_at(row, places, when, at, rays);
    if (starts_differ_) start_at(column, row, places, when, at, rays);
    if (eye_.turns) turn_at(row, places, when, at, rays);
}

void PixelSamples::aim_middles(std::size_t column, std::size_t row, std::size_t at,
                               RayBundles& rays) const {
    Places places;
    for (std::size_t s = 0; s < sample_lanes; ++s) {
        places.right[s] = 0.5f + static_cast<float>(std::min(s % 4, width_ - 1 - column));
        places.down[s] = 0.5f + static_cast<float>(std::min(s / 4, height_ - 1 - row));
    }
    aim_at(column, row, places, at, rays);
    if (!starts_differ_ && !takes_time_) return;
    std::array<float, sample_lanes> when;
    when.fill(0.5f);
    if (takes_time_) time_at(row, places, when, at, rays);
    if (starts_differ_) start_at(column, row, places, when, at, rays);
    if (eye_.turns) turn_at(row, places, when, at, rays);
}

}  // namespace diurna
