#pragma once

#include <Eigen/Core>
#include <vector>

#include "materials/radiation/band.hpp"
#include "render/light/radiance.hpp"
#include "render/rays/secondary_rays.hpp"

namespace diurna {

/// The sum over a rough mirror's lobe (rough_mirror.hpp), (node).
struct NodeLobe {
    std::vector<double> reflected, sky, around;
    double open = 1.0;  // open_sky()
    bool sees_facets = false;
};

/// Lobe integrals of rough mirrors, node by node: the reference of LobeLight.
class NodeLobes {
 public:
    /// - scattered: null: no scattered sunlight
    NodeLobes(const Band& band, const RadianceInput& input, const ScatteredSun* scattered,
              double eye_km)
        : band_(band), input_(input), scattered_(scattered), eye_km_(eye_km) {}

    bool is_rough(const SecondaryRay& secondary) const;
    NodeLobe sum(const SecondaryRay& mirror) const;
    /// Adds a mirror's image of the background and the surrounding facets as it arrives at the eye.
    void add(const SecondaryRay& mirror, const NodeLobe& lobe, std::vector<double>& light) const;
    /// Subtracts the part of it that belongs to the hit of a reflected ray.
    void take_expected(const SecondaryRay& mirror, const NodeLobe& lobe,
                       const Eigen::Vector3d& direction, std::vector<double>& light) const;

    /// The background in a direction from a height, attenuated by `onward`.
    std::vector<double> background(const Eigen::Vector3d& to, double from_km,
                                   const SightLine& onward) const;
    SightLine line_to(const SecondaryRay& secondary) const;

 private:
    std::size_t nodes() const { return band_.node_um.size(); }
    const Material& material(const SecondaryRay& secondary) const {
        return input_.materials[input_.facets.material[secondary.what]];
    }
    Eigen::Vector3d normal_of(const SecondaryRay& secondary) const;
    std::vector<double> in_mirror(const SecondaryRay& mirror, const Eigen::Vector3d& to) const;
    std::vector<double> mean_around(const SecondaryRay& mirror) const;

    const Band& band_;
    const RadianceInput& input_;
    const ScatteredSun* scattered_;
    double eye_km_;
};

}  // namespace diurna
