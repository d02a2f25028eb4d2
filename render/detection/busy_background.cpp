#include "render/detection/busy_background.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <vector>

namespace diurna {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

struct Moments {
    double mean = 0.0, variance = 0.0;
};

/// The values of a cell, row by row; empty where one of them does not count.
std::vector<double> cell_at(const PlaneView& plane, std::span<const std::uint8_t> left_out,
                            int left, int top, int width, int height) {
    std::vector<double> values;
    values.reserve(std::size_t(width) * std::size_t(height));
    for (int y = top; y < top + height; ++y) {
        for (int x = left; x < left + width; ++x) {
            const auto p = std::size_t(y) * std::size_t(plane.width) + std::size_t(x);
            if ((!left_out.empty() && left_out[p] != 0) || !std::isfinite(plane.value[p])) {
                return {};
            }
            values.push_back(double{plane.value[p]});
        }
    }
    return values;
}

Moments moments_of(const std::vector<double>& values) {
    Moments m;
    for (const double v : values) m.mean += v;
    m.mean /= double(values.size());
    for (const double v : values) m.variance += (v - m.mean) * (v - m.mean);
    m.variance /= double(values.size());
    return m;
}

/// Root mean square of `of` over the cells that count.
template <class Of>
CellClutter over_cells(const PlaneView& plane, std::span<const std::uint8_t> left_out, int width,
                       int height, const Of& of) {
    CellClutter clutter;
    double squares = 0.0;
    for (int y = 0; y + height <= plane.height; y += height) {
        for (int x = 0; x + width <= plane.width; x += width) {
            const std::vector<double> cell = cell_at(plane, left_out, x, y, width, height);
            if (cell.empty()) continue;
            squares += of(cell);
            ++clutter.cells;
        }
    }
    // (T51) of docs/theory.md
    clutter.level = clutter.cells > 0 ? std::sqrt(squares / double(clutter.cells)) : none;
    return clutter;
}

}  // namespace

CellClutter cell_clutter(const PlaneView& plane, std::span<const std::uint8_t> left_out, int side) {
    side = std::max(side, 1);
    return over_cells(plane, left_out, side, side,
                      [](const std::vector<double>& cell) { return moments_of(cell).variance; });
}

CellClutter similar_clutter(const PlaneView& plane, std::span<const std::uint8_t> left_out,
                            int left, int top, int width, int height) {
    double least = std::numeric_limits<double>::max(), most = -least;
    for (const float v : plane.value) {
        if (!std::isfinite(v)) continue;
        least = std::min(least, double{v});
        most = std::max(most, double{v});
    }
    std::vector<double> target = cell_at(plane, {}, left, top, width, height);
    if (target.empty()) return {.level = none, .cells = 0};
    const double span = most - least;
    const double c1 = std::pow(0.01 * span, 2), c2 = std::pow(0.03 * span, 2);
    for (double& v : target) v -= least;  // else all cells of 300 K are alike
    const Moments t = moments_of(target);
    return over_cells(plane, left_out, width, height, [&](std::vector<double> cell) {
        for (double& v : cell) v -= least;
        const Moments m = moments_of(cell);
        double together = 0.0;
        for (std::size_t i = 0; i < cell.size(); ++i) {
            together += (cell[i] - m.mean) * (target[i] - t.mean);
        }
        together /= double(cell.size());
        const double upper = (2.0 * m.mean * t.mean + c1) * (2.0 * together + c2);
        const double lower =
            (m.mean * m.mean + t.mean * t.mean + c1) * (m.variance + t.variance + c2);
        const double similar = lower > 0.0 ? upper / lower : 1.0;  // one value all over
        return similar * similar;
    });
}

double entropy_bits(std::span<const float> value, std::span<const std::uint8_t> counted,
                    double step) {
    std::map<long long, std::size_t> bins;
    std::size_t all = 0;
    for (std::size_t p = 0; p < value.size(); ++p) {
        if (counted[p] == 0 || !std::isfinite(value[p])) continue;
        ++bins[static_cast<long long>(std::floor(double{value[p]} / step))];
        ++all;
    }
    double bits = 0.0;
    for (const auto& [bin, count] : bins) {
        const double share = double(count) / double(all);
        bits -= share * std::log2(share);
    }
    return bits;
}

double mean_gradient(const PlaneView& plane, std::span<const std::uint8_t> counted) {
    double sum = 0.0;
    std::size_t count = 0;
    for (int y = 1; y + 1 < plane.height; ++y) {
        for (int x = 1; x + 1 < plane.width; ++x) {
            const auto p = std::size_t(y) * std::size_t(plane.width) + std::size_t(x);
            if (counted[p] == 0) continue;
            const auto at = [&](int dx, int dy) {
                return double{plane.value[std::size_t((y + dy) * plane.width + x + dx)]};
            };
            const double right =
                (at(1, -1) + 2.0 * at(1, 0) + at(1, 1) - at(-1, -1) - 2.0 * at(-1, 0) - at(-1, 1)) /
                8.0;
            const double down =
                (at(-1, 1) + 2.0 * at(0, 1) + at(1, 1) - at(-1, -1) - 2.0 * at(0, -1) - at(1, -1)) /
                8.0;
            const double size = std::hypot(right, down);
            if (!std::isfinite(size)) continue;
            sum += size;
            ++count;
        }
    }
    return count > 0 ? sum / double(count) : none;
}

}  // namespace diurna
