#pragma once

#include <cstdint>
#include <vector>

#include "thermal/network/network_system.hpp"

namespace diurna {

/// What the first guess of each stage of a march lacked [K]. The next march through similar
/// surroundings guesses with it, so that Newton's method begins at 1e-4 to 1e-6 of the heat flow
/// instead of 1e-3. 16 bits for each temperature and stage, relative to the largest of 64.
class NetworkCourse {
 public:
    /// Stages of step i follow; another number of them than before discards what is known.
    void begin_step(std::size_t i, std::size_t stages);
    /// Adds to a guess what the same stage lacked last time, if it is known.
    void correct(NetworkState& guess) const;
    /// Stores what the guess lacked, and goes on to the next stage.
    void store(const NetworkState& guess, const NetworkState& found);
    /// Goes on to the next stage and knows nothing of this one.
    void discard();
    void clear() { step_.clear(); }

 private:
    struct Lacked {
        std::vector<float> unit;  // [K] of the 64 values
        std::vector<std::int16_t> value;
    };
    std::vector<std::vector<Lacked>> step_;  // (step, stage)
    std::size_t now_ = 0, stage_ = 0;
};

}  // namespace diurna
