#include "thermal/solve/own_longwave.hpp"

#include <algorithm>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"

namespace diurna {

OwnLongwave::OwnLongwave(const SolveState& solve, const NetworkObject& object)
    : solve_(solve), face_(object.facet), place_of_back_(object.size(), no_number) {
    if (solve.excess.empty()) return;
    for (std::uint32_t n = 0; n < object.size(); ++n) end_of_.push_back(n);
    for (std::uint32_t n = 0; n < object.size(); ++n) {
        if (object.back[n] == no_number) continue;
        place_of_back_[n] = std::uint32_t(face_.size());
        face_.push_back(object.back[n]);
        end_of_.push_back(n);
    }
    std::vector<std::uint32_t> place(solve.facets, no_number);
    for (std::uint32_t k = 0; k < face_.size(); ++k) place[face_[k]] = k;
    const FacetViews& view = solve.input.views;
    const auto add = [&](std::uint32_t from, float factor) {
        if (from == no_number || factor == 0.0f) return;
        from_.push_back(from);
        factor_.push_back(factor);
    };
    row_.push_back(0);
    for (std::uint32_t k = 0; k < face_.size(); ++k) {
        const std::uint32_t f = face_[k];
        add(k, seen_as_itself(view, f));
        for (auto at = view.others.row[f]; at < view.others.row[f + 1]; ++at) {
            add(place[view.others.facet[at]], view.others.factor[at]);
        }
        row_.push_back(std::uint32_t(from_.size()));
    }
    leaves_.resize(face_.size());
    begin();
}

void OwnLongwave::begin() {
    if (!solve_.excess.empty()) arrives_.assign(face_.size(), 0.0);
}

void OwnLongwave::at(std::size_t instant, const std::vector<double>& outer,
                     const std::vector<double>& inner) {
    if (arrives_.empty()) return;
    const PackedField::Row known = solve_.kelvin.row(instant);
    const auto leave = [&](std::size_t k) {
        const double now = (k < outer.size() ? outer : inner)[end_of_[k]];
        const double emissivity = double(solve_.optics.emissivity[face_[k]]);
        leaves_[k] =
            emissivity * stefan_boltzmann * (power4(now) - power4(double(known(face_[k])))) +
            (1.0 - emissivity) * arrives_[k];
    };
    const auto arrive = [&](std::size_t k) {
        double sum = 0.0;
        for (std::uint32_t e = row_[k]; e < row_[k + 1]; ++e) {
            sum += double(factor_[e]) * leaves_[from_[e]];
        }
        arrives_[k] = sum;
    };
    constexpr std::size_t at_once = 512;
    for_each_index(face_.size(), leave, at_once);
    for_each_index(face_.size(), arrive, at_once);
}

}  // namespace diurna
