#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "terrain/parallel.hpp"
#include "thermal/passes.hpp"

namespace diurna {

namespace {

using Eigen::MatrixXd;

/// The derivative of the period map with the mean slopes of this material.
MatrixXd layered_map(const Kind& kind) {
    const auto n = static_cast<Eigen::Index>(kind.column.grid.size());
    MatrixXd map = MatrixXd::Identity(n, n);
    for (std::size_t stage = 0; stage < kind.slope.size(); stage += 2) {
        linear_step(kind.column.grid, kind.column.stage, kind.slope[stage], kind.slope[stage + 1],
                    map);
    }
    return map;
}

MatrixXd mode_map(const Kind& kind) {
    const ModeStep& step = kind.modes->step;
    const auto n = static_cast<Eigen::Index>(step.modes());
    const auto vector = [&](const std::vector<double>& v) {
        return Eigen::Map<const Eigen::VectorXd>(v.data(), n);
    };
    const MatrixXd& turn = kind.modes->closed.turn;
    MatrixXd map = turn.transpose();
    Eigen::RowVectorXd drive = (kind.slope[0] + step.film) * vector(step.surface).transpose() * map;
    for (std::size_t at = 1; at < kind.slope.size(); ++at) {
        map = vector(step.decay).asDiagonal() * map;
        map += vector(step.from) * drive;
        const double slope = kind.slope[at] + step.film;
        drive = slope / (1.0 - step.response * slope) * vector(step.surface).transpose() * map;
        map += vector(step.to) * drive;
    }
    return turn * map;
}

/// The same for plates, between nodes.
MatrixXd plate_map(const Kind& kind) {
    const PlateStep& step = *kind.plate;
    const auto n = Eigen::Index(step.modes());
    const auto vector = [&](const std::vector<double>& v) {
        return Eigen::Map<const Eigen::VectorXd>(v.data(), n);
    };
    MatrixXd face(n, 2);
    face << vector(step.face[0]), vector(step.face[1]);
    const Eigen::Matrix2d response{{step.response[0], step.response[1]},
                                   {step.response[1], step.response[2]}};
    const auto steepness = [&](std::size_t at) {
        return Eigen::Matrix2d(
            Eigen::Vector2d(kind.slope[at] + step.film[0], kind.back_slope[at] + step.film[1])
                .asDiagonal());
    };
    MatrixXd map = step.into;
    MatrixXd drive = steepness(0) * face.transpose() * map;
    for (std::size_t at = 1; at < kind.slope.size(); ++at) {
        map = vector(step.decay).asDiagonal() * map;
        map += vector(step.from).asDiagonal() * face * drive;
        const Eigen::Matrix2d g = steepness(at);
        drive = (Eigen::Matrix2d::Identity() - g * response).inverse() * g * face.transpose() * map;
        map += vector(step.to).asDiagonal() * face * drive;
    }
    return step.turn * map;
}

/// Factors I − M, M the derivative of the period map.
void linearise(Kind& kind) {
    const MatrixXd map = kind.modes   ? mode_map(kind)
                         : kind.plate ? plate_map(kind)
                                      : layered_map(kind);
    kind.period.emplace();
    // A column that loses nothing keeps its heat for ever; its mean is then left as it is.
    kind.period->setThreshold(1e-9);
    kind.period->compute(MatrixXd::Identity(map.rows(), map.rows()) - map);
}

/// Moves a block's start by (I − M)⁻¹ times its change. The matrix
/// belongs to the material's mean facet; Broyden's update by the move before fits it to each.
/// `secant`: whether that move's effect is all that has changed since.
void correct_block(const Kind& kind, Block& block, bool secant) {
    const auto n = static_cast<Eigen::Index>(block.start.size() / block.stride);
    const auto count = static_cast<Eigen::Index>(block.facet.size());
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    using Strided = Eigen::Map<Rows, 0, Eigen::OuterStride<>>;
    const Eigen::OuterStride<> stride{Eigen::Index(block.stride)};
    const bool update = secant && !block.move.empty();
    block.move.resize(block.start.size());
    block.planned.resize(block.start.size());
    Strided start(block.start.data(), n, count, stride);
    Strided done(block.move.data(), n, count, stride);
    Strided planned(block.planned.data(), n, count, stride);
    const MatrixXd change = Strided(block.change.data(), n, count, stride);
    const MatrixXd plan = kind.period->solve(change);
    MatrixXd move = plan;
    for (Eigen::Index l = 0; update && l < count; ++l) {
        // Of the move `done` the matrix explains `explained`.
        const Eigen::VectorXd explained = planned.col(l) - plan.col(l);
        const double along = done.col(l).dot(explained);
        // Not `<`: a facet that has arrived did not move, and 0 < 0 would let 0 / 0 through.
        if (!(along > 0.1 * done.col(l).squaredNorm())) continue;
        move.col(l) += (done.col(l) - explained) * (done.col(l).dot(plan.col(l)) / along);
    }
    start += move;
    done = move;
    planned = plan;
    block.largest_move =
        (kind.modes ? MatrixXd(kind.modes->probe * move) : move).cwiseAbs().maxCoeff();
}

}  // namespace

void renew_matrices(const Job& job, Level& level) {
    for (Kind& kind : level.kind) {
        std::fill(kind.slope.begin(), kind.slope.end(), 0.0);
        std::fill(kind.back_slope.begin(), kind.back_slope.end(), 0.0);
    }
    for (const Block& block : job.block) {
        Kind& kind = level.kind[block.material];
        for (std::size_t i = 0; i < kind.slope.size(); ++i) {
            kind.slope[i] += block.slope[i] / double(kind.facets);
        }
        for (std::size_t i = 0; i < kind.back_slope.size(); ++i) {
            kind.back_slope[i] += block.back_slope[i] / double(kind.facets);
        }
    }
    for_each_index(
        level.kind.size(), [&](std::size_t k) { linearise(level.kind[k]); }, 1);
}

void correct(Job& job, const Level& level, bool secant) {
    for_each_index(
        job.block.size(),
        [&](std::size_t b) {
            Block& block = job.block[b];
            if (!block.rests) correct_block(level.kind[block.material], block, secant);
        },
        16);
}

}  // namespace diurna
