#include "render/detection/busy_background.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

using namespace diurna;

// How busy a background is, on pictures whose figures are known on paper.

namespace {

struct Made {
    int width, height;
    std::vector<float> value;

    template <class Of>
    Made(int w, int h, const Of& of) : width(w), height(h) {
        for (int y = 0; y < h; ++y) {
            for (int x = 0; x < w; ++x) value.push_back(static_cast<float>(of(x, y)));
        }
    }
    PlaneView view() const { return {value, width, height}; }
    std::vector<std::uint8_t> mask(int left, int top, int w, int h) const {
        std::vector<std::uint8_t> in(value.size(), 0);
        for (int y = top; y < top + h; ++y) {
            for (int x = left; x < left + w; ++x) in[std::size_t(y * width + x)] = 1;
        }
        return in;
    }
};

}  // namespace

TEST_CASE("clutter of a chequerboard is half its step, of a ramp its own", "[render][clutter]") {
    const Made board(64, 48, [](int x, int y) { return (x + y) % 2 == 0 ? 290.0 : 294.0; });
    const CellClutter clutter = cell_clutter(board.view(), {}, 8);
    CHECK(clutter.level == Approx(2.0));
    CHECK(clutter.cells == 48);
    // A ramp of 0.5 K a column: in cells of n columns sd = 0.5 sqrt((n^2 - 1) / 12).
    const Made ramp(64, 48, [](int x, int) { return 280.0 + 0.5 * x; });
    for (const int n : {4, 8, 12}) {
        CHECK(cell_clutter(ramp.view(), {}, n).level ==
              Approx(0.5 * std::sqrt((double(n) * n - 1.0) / 12.0)));
    }
    // Half the cells flat, half with 2 K: 2 / sqrt 2.
    const Made half(64, 48, [](int x, int y) {
        return x < 32 ? 292.0 : (x + y) % 2 == 0 ? 290.0 : 294.0;
    });
    CHECK(cell_clutter(half.view(), {}, 8).level == Approx(std::sqrt(2.0)));
}

TEST_CASE("the target's pixels are in no cell", "[render][clutter]") {
    const Made hot(64, 48, [](int x, int y) {
        return x >= 17 && x < 21 && y >= 9 && y < 12 ? 400.0 : (x + y) % 2 == 0 ? 290.0 : 294.0;
    });
    const CellClutter clutter = cell_clutter(hot.view(), hot.mask(17, 9, 4, 3), 8);
    CHECK(clutter.level == Approx(2.0));
    CHECK(clutter.cells == 47);
    CHECK(std::isnan(cell_clutter(hot.view(), hot.mask(0, 0, 64, 48), 8).level));
}

TEST_CASE("what looks like the target is structural clutter, what is flat is not",
          "[render][clutter]") {
    // A pattern of 8 x 8 everywhere, and the target one of them.
    const auto pattern = [](int x, int y) { return 290.0 + 3.0 * ((x % 8) / 4) + (y % 8) / 4; };
    const Made same(64, 48, pattern);
    CHECK(similar_clutter(same.view(), same.mask(16, 16, 8, 8), 16, 16, 8, 8).level == Approx(1.0));
    // On flat ground at its mean: c2 / (variance + c2) with c2 = (0.03 R)^2, by the definition.
    const Made alone(64, 48, [&](int x, int y) {
        const bool in = x >= 16 && x < 24 && y >= 16 && y < 24;
        return in ? pattern(x, y) : 292.0;
    });
    const double variance = 2.25 + 0.25, c2 = std::pow(0.03 * 4.0, 2);
    const CellClutter flat = similar_clutter(alone.view(), alone.mask(16, 16, 8, 8), 16, 16, 8, 8);
    CHECK(flat.level == Approx(c2 / (variance + c2)).epsilon(1e-6));
    CHECK(flat.cells == 47);
}

TEST_CASE("entropy counts bits, and gradients slopes", "[render][clutter]") {
    const Made levels(64, 16, [](int x, int) { return 280.05 + 0.1 * (x % 16); });
    const std::vector<std::uint8_t> all(levels.value.size(), 1);
    CHECK(entropy_bits(levels.value, all, 0.1) == Approx(4.0));
    const Made flat(8, 8, [](int, int) { return 300.0; });
    CHECK(entropy_bits(flat.value, flat.mask(0, 0, 8, 8), 0.1) == Approx(0.0).margin(1e-12));
    const Made plane(20, 20, [](int x, int y) { return 0.3 * x - 0.4 * y; });
    CHECK(mean_gradient(plane.view(), plane.mask(0, 0, 20, 20)) == Approx(0.5));
    // A step of 4 K: 2 K/pixel on either side of it.
    const Made step(20, 20, [](int x, int) { return x < 10 ? 0.0 : 4.0; });
    CHECK(mean_gradient(step.view(), step.mask(9, 0, 2, 20)) == Approx(2.0));
    CHECK(std::isnan(mean_gradient(step.view(), step.mask(0, 0, 1, 20))));
}
