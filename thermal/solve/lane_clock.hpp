#pragma once

#include <array>
#include <vector>

namespace diurna {

/// Step control of one facet over a span of even steps: from its start and from each jump of its
/// sunlight with a first, short step that grows; steps that do not converge are halved.
class LaneClock {
 public:
    struct Jump {
        std::size_t step;
        double share;  // of the step
    };
    /// step, longest, first  [s]; jumps ascending
    LaneClock(std::size_t steps, double step, double longest, double first,
              std::vector<Jump> jumps);

    void begin();  // the span (again)
    std::size_t step() const { return i_; }
    double from() const { return now_; }
    double to() const { return end_[depth_]; }  // shares of the step
    double duration() const { return (to() - from()) * length_; }
    /// Further halving is not possible.
    bool gentle() const { return depth_ == deepest; }

    /// The part from `from` to `to` did not converge: halves it.
    void halve();
    /// The part converged; true at the end of a step.
    bool go_on();
    bool at_end() const { return i_ == steps_; }

 private:
    static constexpr std::size_t deepest = 10;
    void plan_stretch(bool restart);
    void plan_step();

    std::size_t steps_;
    double length_, longest_, first_;
    std::vector<Jump> jump_;
    std::size_t i_ = 0, next_jump_ = 0, depth_ = 0;
    double now_ = 0.0, set_out_ = 0.0, until_ = 1.0;  // until: the next jump, or the step's end
    double wanted_ = 0.0;                             // [s]
    std::array<double, deepest + 1> end_{};
};

}  // namespace diurna
