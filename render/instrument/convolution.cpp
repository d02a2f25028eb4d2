#include "render/instrument/convolution.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <mutex>
#include <numbers>

namespace diurna {

namespace {

/// FFTW makes and destroys plans on one thread at a time; executing them is free.
std::mutex& planner() {
    static std::mutex mutex;
    return mutex;
}

int smooth_size(int least) {
    for (int size = least;; ++size) {
        int left = size;
        for (const int factor : {2, 3, 5}) {
            while (left % factor == 0) left /= factor;
        }
        if (left == 1) return size;
    }
}

struct Free {
    void operator()(double* memory) const { fftw_free(memory); }
};

struct Plan {
    fftw_plan plan;
    explicit Plan(fftw_plan made) : plan(made) {}
    Plan(const Plan&) = delete;
    Plan& operator=(const Plan&) = delete;
    ~Plan() {
        const std::lock_guard lock(planner());
        fftw_destroy_plan(plan);
    }
};

}  // namespace

Convolution::Convolution(int width, int height,
                         const std::function<double(double, double)>& transfer, double shift)
    : width_(width),
      height_(height),
      columns_(smooth_size(width)),
      rows_(smooth_size(height)),
      shift_(shift) {
    const int half = columns_ / 2 + 1;
    transfer_.resize(std::size_t(half) * std::size_t(rows_));
    for (int r = 0; r < rows_; ++r) {
        const double down = double(r <= rows_ / 2 ? r : r - rows_) / rows_;
        for (int c = 0; c < half; ++c) {
            transfer_[std::size_t(r) * std::size_t(half) + std::size_t(c)] =
                transfer(double(c) / columns_, down);
        }
    }
}

std::vector<float> Convolution::operator()(std::span<const float> picture) const {
    const std::size_t columns = std::size_t(columns_), rows = std::size_t(rows_);
    const std::size_t half = columns / 2 + 1, stride = 2 * half;
    const std::unique_ptr<double, Free> memory(fftw_alloc_real(stride * rows));
    double* const real = memory.get();
    auto* const spectrum = reinterpret_cast<fftw_complex*>(real);
    const auto plans = [&] {
        const std::lock_guard lock(planner());
        // Estimated: the same algorithm on every call.
        return std::pair(fftw_plan_dft_r2c_2d(rows_, columns_, real, spectrum, FFTW_ESTIMATE),
                         fftw_plan_dft_c2r_2d(rows_, columns_, spectrum, real, FFTW_ESTIMATE));
    }();
    const Plan forward(plans.first), backward(plans.second);
    for (std::size_t r = 0; r < rows; ++r) {
        const std::size_t from = std::min(r, std::size_t(height_ - 1)) * std::size_t(width_);
        for (std::size_t c = 0; c < columns; ++c) {
            real[r * stride + c] = double{picture[from + std::min(c, std::size_t(width_ - 1))]};
        }
    }
    fftw_execute(forward.plan);
    auto* const bin = reinterpret_cast<std::complex<double>*>(spectrum);
    const double scale = 1.0 / (double(columns_) * rows_), turn = 2.0 * std::numbers::pi * shift_;
    for (std::size_t r = 0; r < rows; ++r) {
        const double down = (2 * r <= rows ? double(r) : double(r) - double(rows)) / double(rows);
        for (std::size_t c = 0; c < half; ++c) {
            const double by = transfer_[r * half + c] * scale;
            bin[r * half + c] *=
                shift_ == 0.0 ? by : std::polar(by, turn * (double(c) / double(columns) + down));
        }
    }
    fftw_execute(backward.plan);
    std::vector<float> result(std::size_t(width_) * std::size_t(height_));
    for (std::size_t r = 0; r < std::size_t(height_); ++r) {
        for (std::size_t c = 0; c < std::size_t(width_); ++c) {
            result[r * std::size_t(width_) + c] = static_cast<float>(real[r * stride + c]);
        }
    }
    return result;
}

}  // namespace diurna
