#include "materials/base/least_squares.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <boost/math/distributions/students_t.hpp>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace diurna {

namespace {

constexpr int most_passes = 60, most_tries = 12;
constexpr double settled = 1e-6;      // of all ranges
constexpr double small_share = 1e-4;  // of a variance, that a step would take
constexpr double stuck_share = 1e-2;  // the same where no step betters the fit
constexpr double held_apart = 1e-14;  // least eigenvalue of slopes of length one
constexpr double confidence = 0.95;

/// The problem in shares of the numbers' ranges.
class Scaled {
 public:
    explicit Scaled(const LeastSquares& problem)
        : problem_(problem),
          measured_(Eigen::Map<const Eigen::VectorXd>(problem.measured.data(),
                                                      Eigen::Index(problem.measured.size()))) {}

    Eigen::VectorXd start() const {
        Eigen::VectorXd u(size());
        for (Eigen::Index k = 0; k < u.size(); ++k) {
            const auto i = std::size_t(k);
            u[k] = (problem_.start[i] - problem_.low[i]) / range(k);
        }
        return u.cwiseMax(0.0).cwiseMin(1.0);
    }
    Eigen::Index size() const { return Eigen::Index(problem_.low.size()); }
    double range(Eigen::Index k) const {
        return problem_.high[std::size_t(k)] - problem_.low[std::size_t(k)];
    }
    double value(Eigen::Index k, double share) const {
        return problem_.low[std::size_t(k)] + share * range(k);
    }
    Eigen::VectorXd model(const Eigen::VectorXd& u) {
        ++runs;
        std::vector<double> numbers;
        for (Eigen::Index k = 0; k < u.size(); ++k) numbers.push_back(value(k, u[k]));
        const std::vector<double> values = problem_.model(numbers);
        if (values.size() != problem_.measured.size()) {
            throw std::invalid_argument("the model and the measurement have different lengths");
        }
        return Eigen::Map<const Eigen::VectorXd>(values.data(), measured_.size());
    }
    Eigen::VectorXd residual(const Eigen::VectorXd& model) const { return measured_ - model; }
    /// d model / d u.
    Eigen::MatrixXd slopes(const Eigen::VectorXd& u) {
        Eigen::MatrixXd slope(measured_.size(), u.size());
        for (Eigen::Index k = 0; k < u.size(); ++k) {
            Eigen::VectorXd before = u, behind = u;
            before[k] = std::max(0.0, u[k] - problem_.difference);
            behind[k] = std::min(1.0, u[k] + problem_.difference);
            slope.col(k) = (model(behind) - model(before)) / (behind[k] - before[k]);
        }
        return slope;
    }
    int runs = 0;

 private:
    const LeastSquares& problem_;
    Eigen::VectorXd measured_;
};

/// Numbers that may move: not those that the residual pushes out of their range.
std::vector<Eigen::Index> free_ones(const Eigen::VectorXd& u, const Eigen::VectorXd& towards) {
    std::vector<Eigen::Index> free;
    for (Eigen::Index k = 0; k < u.size(); ++k) {
        const bool out = (u[k] <= 0.0 && towards[k] < 0.0) || (u[k] >= 1.0 && towards[k] > 0.0);
        if (!out && towards[k] != 0.0) free.push_back(k);
    }
    return free;
}

Eigen::MatrixXd of_free(const Eigen::MatrixXd& all, const std::vector<Eigen::Index>& free) {
    return all(free, free);
}

/// Correlation of each residual with the one so many places on.
double alike(const Eigen::VectorXd& residual, Eigen::Index apart) {
    const Eigen::Index left = residual.size() - apart;
    const double sum = residual.squaredNorm();
    if (left <= 0 || sum <= 0.0) return 0.0;
    return residual.head(left).dot(residual.tail(left)) / sum;
}

/// How many neighbouring residuals count as one: 1 + 2 sum of their correlations, as long as those
/// of two distances one after the other have a positive sum (Geyer 1992, section 3.3).
double worth_one(const Eigen::VectorXd& residual) {
    double sum = -1.0;
    for (Eigen::Index k = 0; k < residual.size(); k += 2) {
        const double two = alike(residual, k) + alike(residual, k + 1);
        if (two <= 0.0) break;
        sum += 2.0 * two;
    }
    return std::max(1.0, sum);
}

/// Deviations, intervals and correlations at the place that was found.
void tell_errors(const Eigen::MatrixXd& slope, const Eigen::VectorXd& residual, Scaled& scaled,
                 const Eigen::VectorXd& u, const std::vector<Eigen::Index>& free, Fit& found) {
    const auto p = std::size_t(u.size());
    const double n = double(residual.size());
    found.alike = std::max(0.0, alike(residual, 1));
    const double widened = worth_one(residual);
    found.independent = n / widened;
    found.correlation.assign(p, std::vector<double>(p, 0.0));
    for (std::size_t i = 0; i < p; ++i) {
        const auto k = Eigen::Index(i);
        const double at = scaled.value(k, u[k]);
        found.number.push_back({.value = at, .least = at, .most = at});
        found.number[i].idle = slope.col(k).squaredNorm() == 0.0;
        found.number[i].at_bound = u[k] <= 0.0 || u[k] >= 1.0;
        found.correlation[i][i] = 1.0;
    }
    if (free.empty()) return;
    const Eigen::MatrixXd square = of_free(slope.transpose() * slope, free);
    const Eigen::VectorXd length = square.diagonal().cwiseSqrt();
    const Eigen::MatrixXd even =
        length.cwiseInverse().asDiagonal() * square * length.cwiseInverse().asDiagonal();
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(even);
    const Eigen::VectorXd parts = solver.eigenvalues().cwiseMax(held_apart).cwiseInverse();
    const Eigen::MatrixXd inverse =
        solver.eigenvectors() * parts.asDiagonal() * solver.eigenvectors().transpose();
    const double variance = residual.squaredNorm() / std::max(1.0, n - double(free.size()));
    const double freedom = std::max(1.0, found.independent - double(free.size()));
    const double t =
        boost::math::quantile(boost::math::students_t(freedom), 0.5 + 0.5 * confidence);
    for (std::size_t a = 0; a < free.size(); ++a) {
        const auto i = Eigen::Index(a);
        FittedNumber& number = found.number[std::size_t(free[a])];
        number.at_bound = false;
        number.deviation = std::sqrt(variance * inverse(i, i)) / length[i] * scaled.range(free[a]);
        number.least = number.value - t * std::sqrt(widened) * number.deviation;
        number.most = number.value + t * std::sqrt(widened) * number.deviation;
        for (std::size_t b = 0; b < free.size(); ++b) {
            const auto j = Eigen::Index(b);
            found.correlation[std::size_t(free[a])][std::size_t(free[b])] =
                inverse(i, j) / std::sqrt(inverse(i, i) * inverse(j, j));
        }
    }
}

double rms_of(const Eigen::VectorXd& residual) {
    return std::sqrt(residual.squaredNorm() / double(residual.size()));
}

}  // namespace

Fit fit(const LeastSquares& problem) {
    Scaled scaled(problem);
    const Eigen::Index p = scaled.size(), n = Eigen::Index(problem.measured.size());
    if (n <= p) throw std::invalid_argument("there are not more measured values than parameters");
    Fit found;
    Eigen::VectorXd u = scaled.start(), model = scaled.model(u);
    Eigen::VectorXd residual = scaled.residual(model);
    found.before.assign(model.begin(), model.end());
    found.rms_before = rms_of(residual);
    Eigen::MatrixXd slope = scaled.slopes(u);
    std::vector<Eigen::Index> free;
    double damping = 1e-3;
    for (;; ++found.passes) {
        const Eigen::VectorXd towards = slope.transpose() * residual;
        free = free_ones(u, towards);
        if (free.empty()) found.converged = true;
        if (found.converged || found.passes >= most_passes) break;
        const Eigen::MatrixXd square = of_free(slope.transpose() * slope, free);
        const Eigen::VectorXd pull = towards(free);
        const double variance = residual.squaredNorm() / double(n - p);
        const auto step_of = [&](double by) {
            Eigen::MatrixXd damped = square;
            damped.diagonal() *= 1.0 + by;
            return Eigen::VectorXd(damped.ldlt().solve(pull));
        };
        const auto moved_by = [&](const Eigen::VectorXd& step) {
            Eigen::VectorXd next = u;
            next(free) += step;
            return Eigen::VectorXd(next.cwiseMax(0.0).cwiseMin(1.0));
        };
        const auto moves = [&](const Eigen::VectorXd& next) {
            return (next - u).cwiseAbs().maxCoeff() > settled;
        };
        // What the step without damping would take off the squares. That damped steps are short
        // says nothing.
        const Eigen::VectorXd whole = step_of(held_apart);
        const double gain = pull.dot(whole);
        if (gain <= small_share * variance || !moves(moved_by(whole))) {
            found.converged = true;
            break;
        }
        bool better = false;
        for (int i = 0; i < most_tries && !better; ++i) {
            const Eigen::VectorXd next = moved_by(step_of(damping));
            if (!moves(next)) break;
            const Eigen::VectorXd tried = scaled.model(next), left = scaled.residual(tried);
            better = left.squaredNorm() < residual.squaredNorm();  // false of no number
            damping *= better ? 0.2 : 5.0;
            if (!better) continue;
            u = next;
            model = tried;
            residual = left;
        }
        if (!better) {
            found.converged = gain <= stuck_share * variance;
            break;
        }
        slope = scaled.slopes(u);
    }
    tell_errors(slope, residual, scaled, u, free, found);
    found.after.assign(model.begin(), model.end());
    found.rms = rms_of(residual);
    found.runs = scaled.runs;
    return found;
}

}  // namespace diurna
