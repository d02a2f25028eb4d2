#pragma once

#include <Eigen/Core>

#include "terrain/place/sun_path.hpp"
#include "thermal/point/point_facet.hpp"
#include "thermal/point/point_job.hpp"
#include "thermal/weather/sky_series.hpp"

namespace diurna {

/// Inputs of a job's facet from its weather: sun and sky on its plane, and air at its height. The
/// job must outlive it.
class PointWeather {
 public:
    explicit PointWeather(const PointJob& job);

    double up_cosine() const { return normal_.z(); }  // of the facet's normal
    PointForcing operator()(Instant when);
    /// One line on quantities modelled because they were not measured; or empty.
    const std::string& note() const { return series_.weather().note; }

 private:
    const PointJob& job_;
    SkySeries series_;
    SunPath sun_;
    Eigen::Vector3d normal_;
    double rain_share_;  // share of rain on level ground that falls on it
    OpenSky open_{};
    double tilted_ = 0.0;  // tilted_sky_excess
};

}  // namespace diurna
