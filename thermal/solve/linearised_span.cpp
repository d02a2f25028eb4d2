#include "thermal/solve/linearised_span.hpp"

#include <Eigen/LU>

namespace diurna {

namespace {

using Eigen::RowVectorXd;
using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Heat on every facet at an instant, and between it and the one before.
struct Heat {
    const Eigen::MatrixXf& of;
    Eigen::Index facets;
    RowVectorXd before, after;

    Heat(const Eigen::MatrixXf& heat, Eigen::Index count)
        : of(heat), facets(count), before(RowVectorXd::Zero(count)), after(before) {
        if (of.size() > 0) after = of.row(0).cast<double>();
    }
    void next(Eigen::Index k) {
        before = after;
        if (of.size() > 0) after = of.row(k).cast<double>();
    }
    RowVectorXd at(double share) const { return before + share * (after - before); }
};

/// d(flux)/dT of a block's mean facet.
double mean_slope(const std::vector<double>& slope, std::size_t at, const Block& block) {
    return slope[at] / double(block.facet.size());
}

void run_modes(const Kind& kind, const Block& block, const Eigen::MatrixXf& given,
               LinearisedSpan& day) {
    const ModeStep& step = kind.modes->step;
    const Eigen::MatrixXd& turn = kind.modes->closed.turn;
    const auto n = Eigen::Index(step.modes());
    const int substeps = kind.column.substeps;
    Heat heat(given, day.state.cols());
    RowMajor x = turn.transpose() * day.state;
    const auto surface_of = [&]() -> RowVectorXd {
        return Eigen::Map<const RowVectorXd>(step.surface.data(), n) * x;
    };
    RowVectorXd theta = surface_of();
    const auto film_beyond = [&](std::size_t at) -> RowVectorXd {
        return (mean_slope(block.slope, at, block) * day.steep).array() + step.film;
    };
    RowVectorXd drive = heat.after + film_beyond(0).cwiseProduct(theta);
    day.warmer.row(0) = theta;
    std::size_t at = 0;
    for (Eigen::Index k = 1; k < day.warmer.rows(); ++k) {
        heat.next(k);
        for (int s = 0; s < substeps; ++s) {
            const RowVectorXd g = film_beyond(++at);
            const RowVectorXd now = heat.at(double(s + 1) / substeps);
            for (Eigen::Index m = 0; m < n; ++m) {
                x.row(m) =
                    step.decay[std::size_t(m)] * x.row(m) + step.from[std::size_t(m)] * drive;
            }
            theta =
                (surface_of() + step.response * now).array() / (1.0 - step.response * g.array());
            drive = now + g.cwiseProduct(theta);
            for (Eigen::Index m = 0; m < n; ++m) x.row(m) += step.to[std::size_t(m)] * drive;
        }
        day.warmer.row(k) = theta;
    }
    day.state = turn * x;
}

void run_plates(const Kind& kind, const Block& block, const Eigen::MatrixXf& given,
                LinearisedSpan& day) {
    const PlateStep& step = *kind.plate;
    const auto n = Eigen::Index(step.modes());
    const int substeps = kind.column.substeps;
    Heat heat(given, day.state.cols()), behind(day.behind, day.state.cols());
    RowMajor x = step.into * day.state;
    Eigen::Matrix<double, 2, Eigen::Dynamic> face(2, n);
    face.row(0) = Eigen::Map<const RowVectorXd>(step.face[0].data(), n);
    face.row(1) = Eigen::Map<const RowVectorXd>(step.face[1].data(), n);
    const auto& r = step.response;
    const auto film_beyond = [&](const std::vector<double>& slope, std::size_t at, double film) {
        return RowVectorXd((mean_slope(slope, at, block) * day.steep).array() + film);
    };
    using Faces = Eigen::Matrix<double, 2, Eigen::Dynamic, Eigen::RowMajor>;
    Faces theta = face * x, drive = theta;
    drive.row(0) =
        heat.after + film_beyond(block.slope, 0, step.film[0]).cwiseProduct(theta.row(0));
    drive.row(1) =
        behind.after + film_beyond(block.back_slope, 0, step.film[1]).cwiseProduct(theta.row(1));
    day.warmer.row(0) = theta.row(0);
    day.warmer_behind.resize(day.warmer.rows(), day.warmer.cols());
    day.warmer_behind.row(0) = theta.row(1);
    std::size_t at = 0;
    for (Eigen::Index k = 1; k < day.warmer.rows(); ++k) {
        heat.next(k);
        behind.next(k);
        for (int s = 0; s < substeps; ++s) {
            ++at;
            const Eigen::ArrayXXd g0 = film_beyond(block.slope, at, step.film[0]).array();
            const Eigen::ArrayXXd g1 = film_beyond(block.back_slope, at, step.film[1]).array();
            const RowVectorXd now = heat.at(double(s + 1) / substeps);
            const RowVectorXd there = behind.at(double(s + 1) / substeps);
            for (Eigen::Index m = 0; m < n; ++m) {
                const auto i = std::size_t(m);
                x.row(m) =
                    step.decay[i] * x.row(m) + step.from[i] * (face.col(m).transpose() * drive);
            }
            theta = face * x;
            theta.row(0) += r[0] * now + r[1] * there;
            theta.row(1) += r[1] * now + r[2] * there;
            // (1 − response slopes) θ = what is there without them
            const Eigen::ArrayXXd front = theta.row(0).array(), back = theta.row(1).array();
            const Eigen::ArrayXXd scale =
                1.0 / ((1.0 - r[0] * g0) * (1.0 - r[2] * g1) - r[1] * r[1] * g0 * g1);
            theta.row(0) = (scale * ((1.0 - r[2] * g1) * front + r[1] * g1 * back)).matrix();
            theta.row(1) = (scale * ((1.0 - r[0] * g0) * back + r[1] * g0 * front)).matrix();
            drive.row(0) = now + (g0 * theta.row(0).array()).matrix();
            drive.row(1) = there + (g1 * theta.row(1).array()).matrix();
            for (Eigen::Index m = 0; m < n; ++m) {
                x.row(m) += step.to[std::size_t(m)] * (face.col(m).transpose() * drive);
            }
        }
        day.warmer.row(k) = theta.row(0);
        day.warmer_behind.row(k) = theta.row(1);
    }
    day.state = step.turn * x;
}

void run_layered(const Kind& kind, const Block& block, const Eigen::MatrixXf& given,
                 LinearisedSpan& day) {
    const ColumnGrid& grid = kind.column.grid;
    const Stage& stage = kind.column.stage;
    const auto n = Eigen::Index(grid.size());
    const int substeps = kind.column.substeps;
    constexpr double again = (1.0 - sdirk_gamma) / sdirk_gamma;
    Heat heat(given, day.state.cols()), behind(day.behind, day.state.cols());
    RowMajor state = day.state, start, result(n, state.cols());
    day.warmer.row(0) = state.row(0);
    day.warmer_behind.resize(day.warmer.rows(), day.warmer.cols());
    day.warmer_behind.row(0) = state.row(n - 1);
    std::size_t at = 0;
    for (Eigen::Index k = 1; k < day.warmer.rows(); ++k) {
        heat.next(k);
        behind.next(k);
        for (int s = 0; s < substeps; ++s) {
            start = state;
            for (const double share : stage_share) {
                for (Eigen::Index i = n - 1; i >= 1; --i) {
                    const auto node = std::size_t(i);
                    result.row(i) = stage.remember[node] * start.row(i);
                    if (i + 1 < n) result.row(i) += stage.lift[node] * result.row(i + 1);
                }
                RowVectorXd a = stage.surface_store * start.row(0);
                if (n > 1) a += stage.lift[0] * result.row(1);
                // Heat behind counts as if it fell on the front.
                result.row(0) =
                    (a + heat.at((s + share) / substeps) + behind.at((s + share) / substeps)) /
                    (stage.b - mean_slope(block.slope, at++, block));
                for (Eigen::Index i = 1; i < n; ++i) {
                    result.row(i) += stage.follow[std::size_t(i)] * result.row(i - 1);
                }
                start = state + again * (result - state);
            }
            state = result;
        }
        day.warmer.row(k) = state.row(0);
        day.warmer_behind.row(k) = state.row(n - 1);
    }
    day.state = state;
}

}  // namespace

RowVectorXd relative_slopes(const Block& block) {
    const auto count = Eigen::Index(block.facet.size());
    if (block.steepness.empty()) return RowVectorXd::Ones(count);
    // A copy: where a vector's memory begins reports how Eigen sums it, and rounds.
    const RowVectorXd own = Eigen::Map<const RowVectorXd>(block.steepness.data(), count);
    const double mean = own.mean();
    if (!(mean < 0.0)) return RowVectorXd::Ones(count);
    return own / mean;
}

void run_linearised(const SolveState& solve, const Level& level, const Block& block,
                    const Eigen::MatrixXf& heat, LinearisedSpan& day) {
    const Kind& kind = level.kind[block.material];
    if (day.steep.size() == 0) day.steep = RowVectorXd::Ones(day.state.cols());
    day.warmer.resize(Eigen::Index(solve.steps() / level.stride + 1), day.state.cols());
    if (kind.modes) {
        run_modes(kind, block, heat, day);
    } else if (kind.plate) {
        run_plates(kind, block, heat, day);
    } else {
        run_layered(kind, block, heat, day);
    }
}

}  // namespace diurna
