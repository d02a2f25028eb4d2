#include "scenes/job/plan/progress.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
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

void Progress::stage(StageId id, const std::string& what) {
    finish();
    const std::lock_guard lock(mutex_);
    id_ = id;
    name_ = name_of(id, what);
    shown_name_ = part_.empty() ? name_ : part_ + ": " + name_;
    doing_.clear();
    share_ = 0.0;
    tenths_ = 0;
    began_ = Clock::now();
    shown_ = to_.style == ProgressStyle::lines ? began_ : Clock::time_point{};
    heard_ = began_;
    if (to_.style == ProgressStyle::bar) show(0.0, false);
    if (to_.listener) to_.listener(shown_name_, 0.0);
}

void Progress::part(const std::string& text) {
    const std::lock_guard lock(mutex_);
    part_ = text;
}

/// Whether what is known by now should be shown.
bool Progress::due(double share) const {
    if (name_.empty() || to_.style == ProgressStyle::silent) return false;
    const double since = seconds_since(shown_);
    if (to_.style != ProgressStyle::lines) return since >= 0.2;
    constexpr double apart = 2.0, patience = 10.0;  // [s]
    const bool tenth = int(10.0 * share) > tenths_ && share < 1.0;
    return (tenth && since >= apart) || (!doing_.empty() && since >= patience);
}

void Progress::done(double share) {
    const std::lock_guard lock(mutex_);
    share_ = share;
    if (to_.listener && !name_.empty() && seconds_since(heard_) >= 0.2) {
        heard_ = Clock::now();
        to_.listener(shown_name_, share);
    }
    if (!due(share)) return;
    shown_ = Clock::now();
    tenths_ = std::max(tenths_, int(10.0 * share));
    show(share, false);
}

void Progress::doing(const std::string& what) {
    const std::lock_guard lock(mutex_);
    doing_ = what;
    if (!due(share_)) return;
    shown_ = Clock::now();
    show(share_, false);
}

void Progress::tell(const std::string& note) {
    const std::lock_guard lock(mutex_);
    if (to_.style == ProgressStyle::silent) return;
    if (to_.style == ProgressStyle::json) {
        fmt::print(stderr, "{{\"note\":{}}}\n", nlohmann::json(plain(note)).dump());
    } else {
        fmt::print(stderr, "{}note: {}\n", to_.style == ProgressStyle::bar ? "\r\033[K" : "",
                   plain(note));
    }
    std::fflush(stderr);
}

void Progress::set_apart(StageId id, double seconds) {
    const std::lock_guard lock(mutex_);
    const std::string name = name_of(id);
    stages_.push_back({id, name, seconds});
    began_ += std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
    if (to_.style == ProgressStyle::lines) fmt::print(stderr, "{:<28} {:7.2f} s\n", name, seconds);
}

void Progress::finish() {
    const std::lock_guard lock(mutex_);
    if (name_.empty()) return;
    stages_.push_back({id_, name_, seconds_since(began_)});
    show(1.0, true);
    if (to_.listener) to_.listener(shown_name_, 1.0);
    name_.clear();
}

void Progress::show(double share, bool ended) {
    const double spent = seconds_since(began_);
    switch (to_.style) {
        case ProgressStyle::silent:
            return;
        case ProgressStyle::lines:
            if (ended) {
                fmt::print(stderr, "{:<28} {:7.2f} s\n", plain(shown_name_), spent);
            } else {
                fmt::print(stderr, "{:<28} {:7.2f} s  {:3.0f} %{}{}\n", plain(shown_name_), spent,
                           std::floor(100.0 * share), doing_.empty() ? "" : "  ", plain(doing_));
            }
            break;
        case ProgressStyle::json:
            fmt::print(stderr, "{{\"stage\":{},\"share\":{:.4f},\"seconds\":{:.3f}{}}}\n",
                       nlohmann::json(plain(shown_name_)).dump(), share, spent,
                       ended || doing_.empty()
                           ? ""
                           : fmt::format(",\"doing\":{}", nlohmann::json(plain(doing_)).dump()));
            break;
        case ProgressStyle::bar: {
            constexpr int width = 30;
            const int full = static_cast<int>(std::clamp(share, 0.0, 1.0) * width);
            const std::string eta =
                !ended && share > 0.02 ? fmt::format("  {:.0f} s left", spent * (1.0 / share - 1.0))
                                       : "";
            // What it works on where it has gone on for longer than it should have.
            const bool stalls = !ended && spent > 10.0 && !doing_.empty();
            fmt::print(stderr, "\r\033[K{:<28} {:█>{}}{:░>{}} {:7.2f} s{}{}", plain(shown_name_),
                       "", full, "", width - full, spent,
                       stalls ? "  " + plain(doing_).substr(0, 60) : eta, ended ? "\n" : "");
            break;
        }
    }
    std::fflush(stderr);
}

}  // namespace diurna
