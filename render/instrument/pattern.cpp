#include "render/instrument/pattern.hpp"

#include <algorithm>

#include "render/instrument/draws.hpp"

namespace diurna {

namespace {

constexpr double curve_spread = 0.1;  // of the share lacking at a full well

Fate fate_of(const Detector& detector, double drawn) {
    if (drawn < 0.5 * detector.dead) return Fate::dark;
    if (drawn < detector.dead) return Fate::full;
    return drawn < detector.dead + detector.blinking ? Fate::blinking : Fate::whole;
}

}  // namespace

Pattern pattern_of(const Detector& detector, std::uint64_t seed, int width, int height,
                   double unit) {
    Pattern pattern;
    pattern.width = width;
    pattern.height = height;
    const auto drawn = [&](double rms, Draw purpose, std::uint64_t place) {
        return rms == 0.0 ? 0.0 : rms * normal(seed, purpose, place);
    };
    for (int row = 0; row < height; ++row) {
        const double of_row =
            drawn(unit * detector.row_offset, Draw::row_offset, std::uint64_t(row));
        for (int column = 0; column < width; ++column) {
            const std::uint64_t p =
                std::uint64_t(row) * std::uint64_t(width) + std::uint64_t(column);
            pattern.gain.push_back(
                static_cast<float>(1.0 + drawn(detector.gain_spread, Draw::gain, p)));
            pattern.offset.push_back(static_cast<float>(
                of_row + drawn(unit * detector.offset_spread, Draw::offset, p) +
                drawn(unit * detector.column_offset, Draw::column_offset, std::uint64_t(column))));
            pattern.gain_drift.push_back(
                static_cast<float>(drawn(detector.gain_drift, Draw::gain_drift, p)));
            pattern.offset_drift.push_back(
                static_cast<float>(drawn(unit * detector.offset_drift, Draw::offset_drift, p)));
            pattern.curve.push_back(
                static_cast<float>(detector.nonlinearity +
                                   drawn(curve_spread * detector.nonlinearity, Draw::curve, p)));
            pattern.fate.push_back(fate_of(detector, uniform(seed, Draw::fate, p)));
        }
    }
    return pattern;
}

PixelCorrection two_point(const Pattern& pattern, std::size_t p, double well,
                          const double (&seen)[2], const double (&shown)[2]) {
    const double low = pattern.answer(p, seen[0], well, 0.0);
    const double high = pattern.answer(p, seen[1], well, 0.0);
    const double scale = (shown[1] - shown[0]) / (high - low);
    return {scale, shown[0] - scale * low};
}

PixelCorrection one_point(const Pattern& pattern, std::size_t p, double well, double seen,
                          double shown) {
    return {1.0, shown - pattern.answer(p, seen, well, 0.0)};
}

std::size_t replace_dead(const Pattern& pattern, std::vector<float>& signal) {
    std::size_t left = 0;
    const auto is_dead = [&](std::size_t p) {
        return pattern.fate[p] == Fate::dark || pattern.fate[p] == Fate::full;
    };
    for (int row = 0; row < pattern.height; ++row) {
        for (int column = 0; column < pattern.width; ++column) {
            const std::size_t p =
                std::size_t(row) * std::size_t(pattern.width) + std::size_t(column);
            if (!is_dead(p)) continue;
            double sum = 0.0;
            int count = 0;
            for (int r = std::max(0, row - 1); r <= std::min(pattern.height - 1, row + 1); ++r) {
                for (int c = std::max(0, column - 1); c <= std::min(pattern.width - 1, column + 1);
                     ++c) {
                    const std::size_t q =
                        std::size_t(r) * std::size_t(pattern.width) + std::size_t(c);
                    if (is_dead(q)) continue;
                    sum += double{signal[q]};
                    ++count;
                }
            }
            if (count > 0) {
                signal[p] = static_cast<float>(sum / count);
            } else {
                ++left;
            }
        }
    }
    return left;
}

}  // namespace diurna
