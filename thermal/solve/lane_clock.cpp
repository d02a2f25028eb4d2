#include "thermal/solve/lane_clock.hpp"

#include <algorithm>
#include <utility>

namespace diurna {

LaneClock::LaneClock(std::size_t steps, double step, double longest, double first,
                     std::vector<Jump> jumps)
    : steps_(steps), length_(step), longest_(longest), first_(first), jump_(std::move(jumps)) {
    begin();
}

void LaneClock::begin() {
    i_ = next_jump_ = 0;
    now_ = 0.0;
    plan_stretch(true);
}

/// As far as the light goes on without a jump, within the step.
void LaneClock::plan_stretch(bool restart) {
    constexpr double no_stretch = 1.0, crumb = 1e-6;  // [s]
    while (next_jump_ < jump_.size() && jump_[next_jump_].step == i_) {
        const double ahead = (jump_[next_jump_].share - now_) * length_;
        if (ahead > (now_ > 0.0 ? no_stretch : crumb)) break;
        restart = true;
        ++next_jump_;
    }
    const bool jumps = next_jump_ < jump_.size() && jump_[next_jump_].step == i_;
    until_ = jumps ? jump_[next_jump_].share : 1.0;
    if (restart) wanted_ = first_;
    plan_step();
}

void LaneClock::plan_step() {
    double share = std::min(wanted_, longest_) / length_;
    if (until_ - now_ < 1.5 * share) share = until_ - now_;
    depth_ = 0;
    set_out_ = now_;
    end_[0] = share == until_ - now_ ? until_ : now_ + share;
}

void LaneClock::halve() {
    end_[depth_ + 1] = 0.5 * (now_ + end_[depth_]);
    ++depth_;
}

bool LaneClock::go_on() {
    constexpr double growth = 1.6, crumb = 1e-6;  // [s]
    now_ = end_[depth_];
    if (depth_ > 0) {
        --depth_;
        return false;
    }
    wanted_ = std::min(growth * (now_ - set_out_) * length_, longest_);
    if ((until_ - now_) * length_ > crumb) {
        plan_step();
        return false;
    }
    if (until_ < 1.0) {
        ++next_jump_;
        plan_stretch(true);
        return false;
    }
    ++i_;
    now_ = 0.0;
    if (!at_end()) plan_stretch(false);
    return true;
}

}  // namespace diurna
