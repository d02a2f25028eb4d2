#pragma once

#include <Eigen/Core>
#include <vector>

#include "thermal/column_tool.hpp"
#include "thermal/nonlinear_column.hpp"
#include "thermal/sun_path.hpp"
#include "thermal/surface_exchange.hpp"

namespace diurna {

/// Water on the surface [kg m⁻² = mm].
struct Standing {
    double water = 0.0, frost = 0.0;
};

/// The point tool's facet on its way through the weather: the column's state, what stands on it,
/// and how it steps.
///
/// A step is SDIRK2 twice over its halves; once over its whole, for the error it is chosen by
/// (ColumnJob::tolerance). Steps end on samples of the weather, so none looks past a kink.
class PointFacet {
 public:
    explicit PointFacet(const ColumnJob& job);

    /// Returns the heat that melted snow or frost [J m⁻²]. `steps` takes down the steps chosen;
    /// `map` carries the linearised span along.
    double advance(Instant from, Instant to, std::vector<double>* steps = nullptr,
                   Eigen::MatrixXd* map = nullptr);
    /// The same steps again.
    void repeat(Instant from, const std::vector<double>& steps, Eigen::MatrixXd& map);
    ColumnRow row(Instant when, double melt);
    void keep_in_bounds();

    struct Count {
        long long steps = 0, rejected = 0;
        int limited = 0;
        double worst_closure = 0.0;
    };

    NonlinearColumn column;
    std::vector<double> u;  // (node), see NonlinearColumn
    Standing standing;
    Count count;

 private:
    SurfaceConditions conditions(Instant when);
    double wet_share(double step) const;
    struct Taken {
        NonlinearColumn::Step step;
        double melted = 0.0;  // [J m⁻²]
        double terms = 0.0;   // [J m⁻²] sun and the surface's own emission, whatever their sum
    };
    Taken half_step(Instant from, double step, bool gentle, std::vector<double>& state,
                    Standing& water, Eigen::MatrixXd* map);
    void count_closure(const Taken& taken, const std::vector<double>& before,
                       const std::vector<double>& after);

    const ColumnJob& job_;
    SunPath sun_;
    LouisForm louis_;
    Eigen::Vector3d normal_;
    double sky_excess_;
    double next_step_ = 0.05;       // [s]
    double wet_evaporation_ = 0.0;  // of the last step [W m⁻²] per unit wet share
};

}  // namespace diurna
