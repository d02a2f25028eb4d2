#include "thermal/solve/periodic_newton.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/parallel.hpp"
#include "thermal/solve/linearised_span.hpp"

namespace diurna {

namespace {

using Eigen::MatrixXd;

constexpr double steeper = 1.25;

/// How far each facet's slopes, over the block's mean ones, are on the way from those to the
/// steeper ones.
Eigen::RowVectorXd way_to_steeper(const Eigen::RowVectorXd& steep) {
    constexpr double furthest = 0.6;  // beyond which a straight line is none
    return (steep.array() - 1.0).max(-furthest).min(furthest) / (steeper - 1.0);
}
/// The same for what a column makes of a heat that lasts, which goes with 1 / slope where that is
/// less than the mean.
Eigen::RowVectorXd way_of_lasting(const Eigen::RowVectorXd& steep) {
    constexpr double least = 0.3;
    return (steep.array() < 1.0)
        .select((steep.array().max(least).inverse() - 1.0) / (1.0 / steeper - 1.0),
                way_to_steeper(steep).array());
}

void linearise(const SolveState& solve, const Level& level, Block& block) {
    const auto n = Eigen::Index(block.start.size() / block.stride);
    const MatrixXd one = MatrixXd::Identity(n, n);
    LinearisedSpan day{
        .steep = Eigen::RowVectorXd::Ones(2 * n), .state = MatrixXd(n, 2 * n), .warmer = {}};
    day.steep.tail(n).setConstant(steeper);
    day.state << one, one;
    run_linearised(solve, level, block, {}, day);
    PeriodMap& map = block.period.emplace();
    map.follow_mean = day.warmer.leftCols(n).cast<float>();
    map.follow_steeper = day.warmer.rightCols(n).cast<float>();
    // A column that loses nothing keeps its heat for ever; its mean is then left as it is.
    map.mean.setThreshold(1e-9);
    map.mean.compute(one - day.state.leftCols(n));
    map.steeper.setThreshold(1e-9);
    map.steeper.compute(one - day.state.rightCols(n));
}

/// Moves a block's start by (I − M)⁻¹ times its change, and its temperatures with it. The matrix
/// knows how steep each facet's slopes are on the whole; Broyden's update by the move before adds
/// the rest.
void correct_block(SolveState& solve, const Level& level, Block& block) {
    const Kind& kind = level.kind[block.material];
    const auto n = Eigen::Index(block.start.size() / block.stride);
    const auto count = Eigen::Index(block.facet.size());
    const Eigen::OuterStride<> stride{Eigen::Index(block.stride)};
    // What the neighbours have moved it by since reports nothing of this matrix.
    const bool update = !block.move.empty() && block.nudge <= 0.2 * block.largest_move;
    block.nudge = 0.0;
    block.move.resize(block.start.size());
    block.planned.resize(block.start.size());
    BlockStates start(block.start.data(), n, count, stride);
    BlockChanges done(block.move.data(), n, count, stride);
    BlockChanges planned(block.planned.data(), n, count, stride);
    const MatrixXd change = BlockChanges(block.change.data(), n, count, stride).cast<double>();
    const Eigen::RowVectorXd steep = relative_slopes(block);
    const MatrixXd plan = close_period(block, steep, change);
    MatrixXd move = plan;
    for (Eigen::Index l = 0; update && l < count; ++l) {
        // Of the move `made` the matrix explains `explained`.
        const Eigen::VectorXd made = done.col(l).cast<double>();
        const Eigen::VectorXd explained = planned.col(l).cast<double>() - plan.col(l);
        const double along = made.dot(explained);
        // Not `<`: a facet that has arrived did not move, and 0 < 0 would let 0 / 0 through.
        if (!(along > 0.3 * made.squaredNorm())) continue;
        move.col(l) += (made - explained) * (made.dot(plan.col(l)) / along);
    }
    start += move;
    done = move.cast<float>();
    planned = plan.cast<float>();
    block.largest_move =
        (kind.modes ? MatrixXd(kind.modes->probe * move) : move).cwiseAbs().maxCoeff();
    warm(solve, block, follow_start(block, steep, move));
}

}  // namespace

MatrixXd close_period(const Block& block, const Eigen::RowVectorXd& steep, const MatrixXd& change) {
    // (T22) of docs/theory.md
    MatrixXd result = block.period->mean.solve(change);
    const MatrixXd further = block.period->steeper.solve(change);
    return result + (further - result) * way_of_lasting(steep).asDiagonal();
}

MatrixXd follow_start(const Block& block, const Eigen::RowVectorXd& steep, const MatrixXd& move) {
    const PeriodMap& map = *block.period;
    const MatrixXd further = move * way_to_steeper(steep).asDiagonal();
    const Eigen::MatrixXf warmer = map.follow_mean * (move - further).cast<float>() +
                                   map.follow_steeper * further.cast<float>();
    return warmer.cast<double>();
}

void renew_matrices(const SolveState& solve, Level& level, std::vector<Block>& blocks) {
    for (Kind& kind : level.kind) {
        std::fill(kind.slope.begin(), kind.slope.end(), 0.0);
        std::fill(kind.back_slope.begin(), kind.back_slope.end(), 0.0);
    }
    std::vector<double> run(level.kind.size(), 0.0);  // (kind) facets
    for (const Block& block : blocks) {
        if (block.has_run()) run[block.material] += double(block.facet.size());
    }
    for (const Block& block : blocks) {
        if (!block.has_run()) continue;
        Kind& kind = level.kind[block.material];
        for (std::size_t i = 0; i < kind.slope.size(); ++i) {
            kind.slope[i] += block.slope[i] / run[block.material];
        }
        for (std::size_t i = 0; i < kind.back_slope.size(); ++i) {
            kind.back_slope[i] += block.back_slope[i] / run[block.material];
        }
    }
    for_each_index(
        blocks.size(),
        [&](std::size_t b) {
            if (blocks[b].has_run()) linearise(solve, level, blocks[b]);
        },
        16);
}

void correct(SolveState& solve, const Level& level) {
    for_each_index(
        solve.block.size(),
        [&](std::size_t b) {
            if (!solve.block[b].rests) correct_block(solve, level, solve.block[b]);
        },
        16);
}

}  // namespace diurna
