#include "scenes/plan/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "materials/base/plain_text.hpp"

namespace diurna {

namespace {
double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}
}  // namespace

ProgressStyle default_progress_style() {
    return isatty(STDERR_FILENO) != 0 ? ProgressStyle::bar : ProgressStyle::lines;
}

Progress::~Progress() {
    // A stage that did not end was given up; its half-drawn bar would stand before the error.
    if (!name_.empty() && to_.style == ProgressStyle::bar) fmt::print(stderr, "\r\033[K");
}

void Progress::stage(const std::string& name) {
    finish();
    const std::lock_guard lock(mutex_);
    name_ = name;
    began_ = Clock::now();
    shown_ = {};
    if (to_.style == ProgressStyle::bar) show(0.0, false);
    if (to_.listener) to_.listener(name_, 0.0);
}

void Progress::done(double share) {
    const std::lock_guard lock(mutex_);
    if (name_.empty() || Clock::now() - shown_ < std::chrono::milliseconds(200)) return;
    shown_ = Clock::now();
    if (to_.style == ProgressStyle::bar || to_.style == ProgressStyle::json) show(share, false);
    if (to_.listener) to_.listener(name_, share);
}

void Progress::set_apart(const std::string& name, double seconds) {
    const std::lock_guard lock(mutex_);
    stages_.push_back({name, seconds});
    began_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    if (to_.style == ProgressStyle::lines) fmt::print(stderr, "{:<28} {:7.2f} s\n", name, seconds);
}

void Progress::finish() {
    const std::lock_guard lock(mutex_);
    if (name_.empty()) return;
    stages_.push_back({name_, seconds_since(began_)});
    show(1.0, true);
    if (to_.listener) to_.listener(name_, 1.0);
    name_.clear();
}

void Progress::show(double share, bool ended) {
    const double spent = seconds_since(began_);
    switch (to_.style) {
        case ProgressStyle::silent:
            return;
        case ProgressStyle::lines:
            if (ended) fmt::print(stderr, "{:<28} {:7.2f} s\n", plain(name_), spent);
            break;
        case ProgressStyle::json:
            fmt::print(stderr, "{{\"stage\":{},\"share\":{:.4f},\"seconds\":{:.3f}}}\n",
                       nlohmann::json(plain(name_)).dump(), share, spent);
            break;
        case ProgressStyle::bar: {
            constexpr int width = 30;
            const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
            const std::string eta =
                !ended && share > 0.02 ? fmt::format("  {:.0f} s left", spent * (1.0 / share - 1.0))
                                       : "";
            fmt::print(stderr, "\r\033[K{:<28} {:█>{}}{:░>{}} {:7.2f} s{}{}", plain(name_), "",
                       full, "", width - full, spent, eta, ended ? "\n" : "");
            break;
        }
    }
    std::fflush(stderr);
}

}  // namespace diurna
