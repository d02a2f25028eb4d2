#include "render/path/interpolation.hpp"

#include <cassert>

namespace diurna {

std::array<float, most_few> product_weights_of_few(float y, std::size_t count) {
    std::array<float, most_few + 1> before{1.0f}, after{};
    for (std::size_t j = 0; j < count; ++j) {
        before[j + 1] = before[j] * (y - static_cast<float>(j));
    }
    after[count] = 1.0f;
    for (std::size_t j = count - 1; j > 0; --j) {
        after[j] = after[j + 1] * (y - static_cast<float>(j));
    }
    static constexpr std::array<std::array<float, most_few>, most_few + 1> norms = {
        {{},
         {},
         {-1.0f, 1.0f},
         {0.5f, -1.0f, 0.5f},
         {},
         {1.0f / 24, -1.0f / 6, 0.25f, -1.0f / 6, 1.0f / 24}}};
    std::array<float, most_few> weight{};
    for (std::size_t j = 0; j < count; ++j) {
        weight[j] = norms[count][j] * before[j] * after[j + 1];
    }
    return weight;
}

Stencil stencil(double x, std::size_t nodes) {
    assert(nodes >= 4);
    const double before = std::clamp(std::floor(x) - 1.0, 0.0, double(nodes) - 4.0);
    const auto t = static_cast<float>(x - before);
    const float a = t - 1.0f, b = t - 2.0f, c = t - 3.0f;
    return {.start = static_cast<std::size_t>(before),
            .weight = {a * b * c * (-1.0f / 6.0f), t * b * c * 0.5f, t * a * c * -0.5f,
                       t * a * b * (1.0f / 6.0f)}};
}

double interpolated(std::span<const double> value, double x) {
    const Stencil s = stencil(x, value.size());
    double sum = 0.0;
    for (std::size_t k = 0; k < 4; ++k) sum += double(s.weight[k]) * value[s.start + k];
    return sum;
}

std::array<double, most_few> from_fewer(const std::array<double, most_few>& value,
                                        std::size_t count) {
    const std::size_t skip = (most_few - 1) / (count - 1);
    std::array<double, most_few> found{};
    for (std::size_t j = 0; j < most_few; ++j) {
        for (std::size_t k = 0; k < count; ++k) {
            const auto weight =
                static_cast<float>(lagrange_weight(double(j) / double(skip), k, count));
            found[j] += double{weight} * value[k * skip];
        }
    }
    return found;
}

Eigen::MatrixXd interpolation_matrix(std::size_t coarse, std::size_t fine) {
    const std::size_t taps = coarse < 6 ? coarse : 4;
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(Eigen::Index(fine), Eigen::Index(coarse));
    for (std::size_t i = 0; i < fine; ++i) {
        const double x = double(i) * double(coarse - 1) / double(fine - 1);
        const double first =
            taps == coarse ? 0.0 : std::clamp(std::floor(x) - 1.0, 0.0, double(coarse - taps));
        for (std::size_t j = 0; j < taps; ++j) {
            matrix(Eigen::Index(i), Eigen::Index(first) + Eigen::Index(j)) =
                lagrange_weight(x - first, j, taps);
        }
    }
    return matrix;
}

}  // namespace diurna
