#pragma once

#include <Eigen/Core>
#include <array>

#include "terrain/place/instant.hpp"
#include "terrain/place/site.hpp"
#include "terrain/place/sun.hpp"

namespace diurna {

/// The sun's path over one site for series of many instants: a cubic through positions computed
/// every ten minutes, without refraction. Within 0.1″ of sun_position
/// (tests/terrain/sun_path_test.cpp), much faster if the instants ascend in short steps.
class SunPath {
 public:
    explicit SunPath(const Site& site) : site_(site) {}
    SunPosition at(Instant instant);

 private:
    struct Knot {
        long long index = 0;
        bool filled = false;
        Eigen::Vector3d place;  // direction times distance [au]
    };
    const Eigen::Vector3d& knot(long long index);

    Site site_;
    std::array<Knot, 8> knots_;
};

}  // namespace diurna
