#include "thermal/solve/extrapolation.hpp"

#include <cmath>

#include "materials/base/parallel.hpp"

namespace diurna {

namespace {

constexpr std::size_t first_pass = 4;  // before it, Newton and exchange still work
constexpr double slow = 0.3, most = 0.98, least = -8.0;  // of λ: |λ| above `slow` is extrapolated

template <class Values>
double dot_of_changes(const Values& a, const Values& b, const Values& c, const Values& d) {
    double sum = 0.0;  // (b − a) · (d − c)
    for (std::size_t i = 0; i < a.size(); ++i) {
        sum += (double(b[i]) - double(a[i])) * (double(d[i]) - double(c[i]));
    }
    return sum;
}

/// The share of its error that each pass leaves, below 0 where passes overshoot; 0 where the last
/// three do not lie on a line.
template <class Values>
double share_left(const Values& first, const Values& second, const Values& third) {
    const double before = dot_of_changes(first, second, first, second);
    const double last = dot_of_changes(second, third, second, third);
    const double along = dot_of_changes(first, second, second, third);
    constexpr double on_a_line = 0.9;  // |cosine| between the two changes
    if (!(before > 0.0) || std::abs(along) < on_a_line * std::sqrt(before * last)) return 0.0;
    const double share = along / before;
    return std::abs(share) > slow && share > least && share < most ? share : 0.0;
}

template <class Body>
void for_each_facet(const Block& block, const Body& body) {
    for (const std::size_t f : block.facet) body(f);
    for (const std::size_t f : block.behind) body(f);
}

}  // namespace

Extrapolation::Iterate Extrapolation::taken(const SolveState& solve, const Block& block) {
    Iterate now{.excess = {}, .start = block.start};
    if (solve.excess.empty()) return now;
    const std::size_t instants = solve.excess.slots();
    for_each_facet(block, [&](std::size_t f) {
        now.excess.resize(now.excess.size() + instants);
        solve.excess.get(f, &now.excess[now.excess.size() - instants]);
    });
    return now;
}

void Extrapolation::after_pass(SolveState& solve) {
    if (++passes_ < first_pass || solve.excess.empty()) return;
    of_block_.resize(solve.block.size());
    for_each_index(solve.block.size(), [&](std::size_t b) {
        Block& block = solve.block[b];
        std::vector<Iterate>& known = of_block_[b];
        if (solve.of_target(block) || block.settled(solve.options, solve.left_by_pass)) {
            known.clear();
            return;
        }
        known.push_back(taken(solve, block));
        if (known.size() < 3) return;
        const double share = share_left(known[0].excess, known[1].excess, known[2].excess);
        if (share != 0.0) {
            const double further = share / (1.0 - share);
            for (std::size_t i = 0; i < block.start.size(); ++i) {
                block.start[i] += further * (known[2].start[i] - known[1].start[i]);
            }
            std::size_t at = 0;
            std::vector<float> excess(solve.excess.slots());
            for_each_facet(block, [&](std::size_t f) {
                solve.excess.get(f, excess.data());
                for (float& value : excess) {
                    value += float(further *
                                   (double(known[2].excess[at]) - double(known[1].excess[at])));
                    ++at;
                }
                solve.excess.put(f, excess.data());
            });
            block.move.clear();  // no pass has made this step: Broyden's update skips it
            block.heat_change = 1e9;
        }
        known.clear();
    });
}

}  // namespace diurna
