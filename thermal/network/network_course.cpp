#include "thermal/network/network_course.hpp"

#include <algorithm>
#include <cmath>

namespace diurna {

namespace {

constexpr std::size_t together = 64;
constexpr float most = 32767.0f;

/// Calls body(first place of these, values) for nodes, edges and lumps.
template <class State, class Body>
void each(State& state, const Body& body) {
    std::size_t at = 0;
    for (auto* of : {&state.node, &state.edge, &state.lump}) {
        body(at, *of);
        at += (of->size() + together - 1) / together * together;
    }
}

std::size_t places(const NetworkState& state) {
    std::size_t sum = 0;
    each(state, [&](std::size_t, const std::vector<double>& of) {
        sum += (of.size() + together - 1) / together * together;
    });
    return sum;
}

}  // namespace

void NetworkCourse::begin_step(std::size_t i, std::size_t stages) {
    if (step_.size() <= i) step_.resize(i + 1);
    if (step_[i].size() != stages) step_[i].assign(stages, {});
    now_ = i;
    stage_ = 0;
}

void NetworkCourse::correct(NetworkState& guess) const {
    const Lacked& lacked = step_[now_][stage_];
    if (lacked.value.empty()) return;
    each(guess, [&](std::size_t at, std::vector<double>& of) {
        for (std::size_t k = 0; k < of.size(); ++k) {
            const float unit = lacked.unit[(at + k) / together];
            of[k] += double(unit * float(lacked.value[at + k]));
        }
    });
}

void NetworkCourse::store(const NetworkState& guess, const NetworkState& found) {
    Lacked& lacked = step_[now_][stage_++];
    lacked.value.resize(places(found));
    lacked.unit.resize(lacked.value.size() / together);
    const std::vector<double>* const guessed[]{&guess.node, &guess.edge, &guess.lump};
    std::size_t which = 0;
    each(found, [&](std::size_t at, const std::vector<double>& of) {
        const std::vector<double>& from = *guessed[which++];
        for (std::size_t begin = 0; begin < of.size(); begin += together) {
            const std::size_t end = std::min(of.size(), begin + together);
            float largest = 0.0f;
            for (std::size_t k = begin; k < end; ++k) {
                largest = std::max(largest, std::abs(float(of[k] - from[k])));
            }
            const float per_unit = largest > 0.0f ? most / largest : 0.0f;
            lacked.unit[(at + begin) / together] = largest / most;
            for (std::size_t k = begin; k < end; ++k) {
                lacked.value[at + k] =
                    std::int16_t(std::nearbyint(float(of[k] - from[k]) * per_unit));
            }
        }
    });
}

void NetworkCourse::discard() { step_[now_][stage_++] = {}; }

}  // namespace diurna
