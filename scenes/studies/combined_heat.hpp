#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "thermal/field_difference.hpp"
#include "thermal/temperature_field.hpp"

namespace diurna {

/// Temperatures of a scene with several numbers changed at once, from scenes in which one of them
/// is at the ends and in the middle of its range: the sum of the changes, each a parabola of its
/// number (a straight line without a middle). Exact for numbers that act each by itself as a
/// polynomial of second order; the error of other cases is measured by difference_of() to a whole
/// solution.
class CombinedHeat {
 public:
    /// - base: of the unchanged scene; must outlive this
    explicit CombinedHeat(const TemperatureField& base) : base_(base) {}

    /// Temperatures with one number changed. Nothing: those of the unchanged scene.
    struct Changed {
        std::optional<TemperatureField> low{}, middle{}, high{};
        bool has_middle = false;
    };
    /// Adds a number. Returns false, and adds nothing, for temperatures of other facets or
    /// instants.
    bool add(Changed changed);

    /// - point: (number) 0 at its low end, 1 at its high one
    TemperatureField at(const std::vector<double>& point) const;
    /// [K] rms over facets and instants of the sum of the changes, each in magnitude: how far a
    /// point is from the unchanged scene.
    double departure(const std::vector<double>& point) const;

 private:
    struct Weighted {
        const std::optional<TemperatureField>& field;
        double weight;
    };
    static std::array<Weighted, 3> weighted(const Changed& changed, double at);

    const TemperatureField& base_;
    std::vector<Changed> number_;
    std::vector<std::array<double, 3>> change_;  // (number)(place) [K] rms
};

}  // namespace diurna
