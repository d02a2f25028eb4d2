#include "scenes/studies/combined_heat.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace diurna {

namespace {

bool alike(const TemperatureField& a, const TemperatureField& b) {
    return a.facets == b.facets && a.instant == b.instant && a.kelvin.size() == b.kelvin.size();
}

}  // namespace

bool CombinedHeat::add(Changed changed) {
    std::array<double, 3> change{};
    std::size_t place = 0;
    for (const auto* field : {&changed.low, &changed.middle, &changed.high}) {
        if (*field && !alike(**field, base_)) return false;
        change[place++] = *field ? difference_of(**field, base_).rms : 0.0;
    }
    number_.push_back(std::move(changed));
    change_.push_back(change);
    return true;
}

std::array<CombinedHeat::Weighted, 3> CombinedHeat::weighted(const Changed& changed, double at) {
    if (!changed.has_middle) {
        return {{{changed.low, 1.0 - at}, {changed.middle, 0.0}, {changed.high, at}}};
    }
    return {{{changed.low, (2.0 * at - 1.0) * (at - 1.0)},
             {changed.middle, 4.0 * at * (1.0 - at)},
             {changed.high, at * (2.0 * at - 1.0)}}};
}

TemperatureField CombinedHeat::at(const std::vector<double>& point) const {
    std::vector<double> sum(base_.kelvin.begin(), base_.kelvin.end());
    for (std::size_t u = 0; u < number_.size(); ++u) {
        for (const auto& [field, weight] : weighted(number_[u], point[u])) {
            if (!field || weight == 0.0) continue;
            for (std::size_t i = 0; i < sum.size(); ++i) {
                sum[i] += weight * (double{field->kelvin[i]} - double{base_.kelvin[i]});
            }
        }
    }
    TemperatureField made = base_;
    std::transform(sum.begin(), sum.end(), made.kelvin.begin(),
                   [](double kelvin) { return static_cast<float>(kelvin); });
    return made;
}

double CombinedHeat::departure(const std::vector<double>& point) const {
    double sum = 0.0;
    for (std::size_t u = 0; u < number_.size(); ++u) {
        const auto places = weighted(number_[u], point[u]);
        for (std::size_t i = 0; i < places.size(); ++i) {
            sum += std::abs(places[i].weight) * change_[u][i];
        }
    }
    return sum;
}

}  // namespace diurna
