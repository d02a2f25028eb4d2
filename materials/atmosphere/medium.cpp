#include "materials/atmosphere/medium.hpp"

#include <algorithm>
#include <cmath>

#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

using MediumTables = BandModelTables;

constexpr double standard_pressure_hPa = 1013.25;

}  // namespace

void negative_exponentials(std::span<double> values) {
    double* const v = values.data();
    const std::size_t count = values.size();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) v[i] = fast_exp(-v[i]);
}

void Amounts::add(const Amounts& other) {
    for (std::size_t i = 0; i < gas.size(); ++i) gas[i] += other.gas[i];
    for (std::size_t i = 0; i < linear.size(); ++i) linear[i] += other.linear[i];
    for (std::size_t i = 0; i < aerosol.size(); ++i) aerosol[i] += other.aerosol[i];
    for (std::size_t k = 0; k < haze.size(); ++k) {
        for (std::size_t i = 0; i < haze[k].size(); ++i) haze[k][i] += other.haze[k][i];
    }
    rain += other.rain;
}

Medium::Medium(const BandModel& model, BinRange bins)
    : tables_(band_model_tables()),
      model_(model),
      bins_(bins),
      haze_(model),
      no_depth_(bins.size(), 0.0) {
    constexpr auto carbon_dioxide = static_cast<std::size_t>(Gas::carbon_dioxide);
    const double profile_co2 = model.profile.mixing_ratio_ppm[carbon_dioxide].front();
    co2_scale_ = profile_co2 > 0.0 ? model.co2_ppm / profile_co2 : 0.0;
    for (std::size_t i = 0; i < tables_.runs.size(); ++i) {  // in the order of their groups
        const MediumTables::Run& run = tables_.runs[i];
        if (run.first >= bins.last || run.first + run.bins <= bins.first) continue;
        run_.push_back(i);
        if (active_.empty() || active_.back() != run.group) active_.push_back(run.group);
    }
    for (const std::size_t group : active_) {
        pressure_power_.push_back(tables_.groups[group].n);
        temperature_power_.push_back(tables_.groups[group].m);
    }
    pressure_power_.resize(active_.size() + group_lanes, 0.0);
    temperature_power_.resize(active_.size() + group_lanes, 0.0);
}

Amounts Medium::none() const {
    Amounts amounts;
    amounts.gas.assign(tables_.groups.size(), 0.0);
    const bool aerosol = haze_.boundary() != nullptr;
    if (aerosol || haze_.rains()) amounts.aerosol.assign(bins_.size(), 0.0);
    if (aerosol) {
        amounts.haze = {std::vector<double>(haze_.boundary()->node.size(), 0.0),
                        std::vector<double>(haze_.tropospheric()->node.size(), 0.0)};
    }
    return amounts;
}

void Medium::add_aerosol(const MediumTables::Aerosol& aerosol, double dryness, double depth,
                         std::span<double> node) const {
    if (aerosol.levels.size() == 1) {  // fog, whatever the humidity
        node[0] += depth;
        return;
    }
    const auto [low, high, t] = place_of(aerosol, dryness);
    // Drier or damper than the table: its end.
    const std::size_t interval = std::min(low, aerosol.levels.size() - 2);
    const double x = low == high ? (low == 0 ? 0.0 : 1.0) : t;
    constexpr std::size_t count = MediumTables::interval_nodes;
    static const auto [place, norm] = [] {
        std::array<double, count> at{}, over{};
        for (std::size_t k = 0; k < count; ++k) at[k] = chebyshev_node(k, count);
        for (std::size_t k = 0; k < count; ++k) {
            over[k] = 1.0;
            for (std::size_t j = 0; j < count; ++j) over[k] /= j == k ? 1.0 : at[k] - at[j];
        }
        return std::pair(at, over);
    }();
    for (std::size_t k = 0; k < count; ++k) {  // Lagrange's form
        double weight = norm[k];
        for (std::size_t j = 0; j < count; ++j) weight *= j == k ? 1.0 : x - place[j];
        node[interval * count + k] += depth * weight;
    }
}

void Medium::spread(Amounts& amounts) const {
    if (amounts.aerosol.empty()) return;
    const std::size_t count = bins_.size();
    double* const depth = amounts.aerosol.data();
    for (std::size_t part = 0; part < amounts.haze.size(); ++part) {
        std::vector<double>& weight = amounts.haze[part];
        const auto& node = (part == 0 ? haze_.boundary() : haze_.tropospheric())->node;
        constexpr std::size_t group = MediumTables::interval_nodes;
        for (std::size_t k = 0; k < weight.size(); k += group) {
            if (weight.size() == 1) {
                const double* const e = node[0].data() + bins_.first;
#pragma omp simd
                for (std::size_t i = 0; i < count; ++i) depth[i] += weight[0] * e[i];
                break;
            }
            const double* const w = &weight[k];
            if (std::all_of(w, w + group, [](double x) { return x == 0.0; })) continue;
            const double w0 = w[0], w1 = w[1], w2 = w[2], w3 = w[3], w4 = w[4], w5 = w[5];
            const auto at = [&](std::size_t j) { return node[k + j].data() + bins_.first; };
            const double *const e0 = at(0), *const e1 = at(1), *const e2 = at(2), *const e3 = at(3),
                                *const e4 = at(4), *const e5 = at(5);
#pragma omp simd
            for (std::size_t i = 0; i < count; ++i) {
                depth[i] +=
                    (w0 * e0[i] + w1 * e1[i] + w2 * e2[i]) + (w3 * e3[i] + w4 * e4[i] + w5 * e5[i]);
            }
        }
        std::fill(weight.begin(), weight.end(), 0.0);
    }
    if (amounts.rain > 0.0) {
        for (std::size_t i = 0; i < count; ++i) depth[i] += amounts.rain;
        amounts.rain = 0.0;
    }
}

void Medium::add_gases(const AirSample& air, double length_km, Amounts& amounts) const {
    const double pressure = air.pressure_hPa / standard_pressure_hPa;
    const double temperature = zero_celsius / air.temperature;
    const double amagat = pressure * temperature;  // density over that at 0 °C, 1 atm

    std::array<double, gas_count> amount;  // [cm at STP], water [g cm⁻²]
    for (std::size_t gas = 0; gas < gas_count; ++gas) {
        amount[gas] = 1e5 * amagat * air.mixing_ratio_ppm[gas] * 1e-6 * length_km;
    }
    const auto of = [&](Gas gas) -> double& { return amount[static_cast<std::size_t>(gas)]; };
    of(Gas::carbon_dioxide) *= co2_scale_;
    const double water_cm = of(Gas::water);
    constexpr double loschmidt = 2.68675e19, avogadro = 6.022045e23, water_molar_mass = 18.015;
    of(Gas::water) *= loschmidt / avogadro * water_molar_mass;

    // (T37) of docs/theory.md: what W is summed of
    const double ln_pressure = std::log(pressure), ln_temperature = std::log(temperature);
    for (std::size_t begin = 0; begin < active_.size(); begin += group_lanes) {
        std::array<double, group_lanes> scale;
#pragma omp simd
        for (std::size_t i = 0; i < group_lanes; ++i) {
            scale[i] = fast_exp(pressure_power_[begin + i] * ln_pressure +
                                temperature_power_[begin + i] * ln_temperature);
        }
        const std::size_t end = std::min(begin + group_lanes, active_.size());
        for (std::size_t i = begin; i < end; ++i) {
            amounts.gas[active_[i]] += of(tables_.groups[active_[i]].gas) * scale[i - begin];
        }
    }

    const double molecules = water_cm * loschmidt * 1e-20;  // [1e20 cm⁻²]
    const double vapour_hPa = air.vapour_pressure_hPa();
    const double reference = 296.0 / air.temperature / standard_pressure_hPa;
    const double self = molecules * vapour_hPa * reference;
    const double foreign = molecules * (air.pressure_hPa - vapour_hPa) * reference;
    const double colder = std::clamp((296.0 - air.temperature) / 36.0, 0.0, 1.0);
    const std::array<double, MediumTables::linear_count> linear = {
        self,
        self * colder,
        foreign,
        0.781 * amagat * pressure * std::sqrt(temperature) * length_km,
        amagat * length_km,
        of(Gas::ozone),
        of(Gas::nitric_acid)};
    for (std::size_t i = 0; i < linear.size(); ++i) amounts.linear[i] += linear[i];
}

void Medium::add(double height_km, double length_km, std::span<const double> aerosol,
                 Amounts& amounts) const {
    for (std::size_t i = 0; i < amounts.aerosol.size(); ++i) {
        amounts.aerosol[i] += aerosol[i] * length_km;
    }
    add_gases(air_at(model_.profile, height_km), length_km, amounts);
}

void Medium::add(double height_km, double length_km, Amounts& amounts) const {
    const AirSample air = air_at(model_.profile, height_km);
    add_gases(air, length_km, amounts);
    const double drops = haze_.rain(height_km);
    if (haze_.boundary() != nullptr) {
        const auto [boundary, troposphere, above] = haze_.extinction(height_km);
        // Rain saturates the air.
        const double dryness = drops > 0.0 ? 0.0 : ln_dryness(air);
        if (boundary > 0.0) {
            add_aerosol(*haze_.boundary(), dryness, boundary * length_km, amounts.haze[0]);
        }
        if (troposphere > 0.0) {
            add_aerosol(*haze_.tropospheric(), dryness, troposphere * length_km, amounts.haze[1]);
        }
        if (above > 0.0) {
            add_aerosol(*haze_.tropospheric(), std::log(100.0), above * length_km, amounts.haze[1]);
        }
    }
    amounts.rain += drops * length_km;
}

void Medium::add(const SightLine& line, std::size_t segment, Amounts& amounts) const {
    const double length = line.length_km[segment];
    constexpr double level_km = 0.02;  // where the middle is good to 1e-5 of the density
    if (line.edge_km.empty() ||
        std::abs(line.edge_km[segment + 1] - line.edge_km[segment]) < level_km) {
        add(line.height_km[segment], length, amounts);
        return;
    }
    constexpr double gauss = 0.21132486540518712;  // (1 − 1/√3) / 2
    for (const double share : {gauss, 1.0 - gauss}) {
        add(line.height_within(segment, share), 0.5 * length, amounts);
    }
}

void Medium::depths(const Amounts& amounts, std::span<double> out) const {
    find_depths(amounts, nullptr, true, out);
}

void Medium::depths(const Amounts& amounts, const Amounts& more, std::span<double> out) const {
    find_depths(amounts, &more, true, out);
}

void Medium::transmittances(const Amounts& amounts, std::span<double> out) const {
    find_depths(amounts, nullptr, true, out);
    negative_exponentials(out);
}

void Medium::absorption_transmittances(const Amounts& amounts, std::span<double> out) const {
    find_depths(amounts, nullptr, false, out);
    negative_exponentials(out);
}

void Medium::find_depths(const Amounts& amounts, const Amounts* more, bool scattering,
                         std::span<double> out) const {
    const std::array<const double*, MediumTables::linear_count> k = {
        tables_.linear[0].data() + bins_.first, tables_.linear[1].data() + bins_.first,
        tables_.linear[2].data() + bins_.first, tables_.linear[3].data() + bins_.first,
        tables_.linear[4].data() + bins_.first, tables_.linear[5].data() + bins_.first,
        tables_.linear[6].data() + bins_.first};
    std::array<double, MediumTables::linear_count> w = amounts.linear;
    for (std::size_t i = 0; more != nullptr && i < w.size(); ++i) w[i] += more->linear[i];
    if (!scattering) w[MediumTables::rayleigh] = 0.0;
    const std::size_t count = bins_.size();
    // Gases eight bins at a time, past the end of their runs and of the range: runs are filled up
    // with values that count nothing.
    constexpr std::size_t lanes = MediumTables::run_padding;
    constexpr std::size_t few = 128;  // bins whose sums need no memory of their own
    std::array<float, few> on_stack;
    std::vector<float> in_memory;
    if (count + lanes > few) in_memory.resize(count + lanes);
    float* const gas = in_memory.empty() ? on_stack.data() : in_memory.data();
    std::fill(gas, gas + count + lanes, 0.0f);
    std::size_t group = tables_.groups.size();
    float ln_amount = 0.0f;
    for (const std::size_t i : run_) {
        const MediumTables::Run& run = tables_.runs[i];
        const std::size_t from = std::max(run.first, bins_.first);
        const std::size_t to = std::min(run.first + run.bins, bins_.last);
        const float* ln_c = run.ln_c.data() + (from - run.first);
        const float* a = run.a.data() + (from - run.first);
        float* depth = gas + (from - bins_.first);
        if (run.group != group) {
            group = run.group;
            const double met =
                amounts.gas[group] + (more != nullptr ? more->gas[group] : 0.0) + 1e-300;
            ln_amount = static_cast<float>(std::log(met));
        }
        for (std::size_t block = 0; block < to - from; block += lanes) {
#pragma omp simd
            for (std::size_t j = 0; j < lanes; ++j) {
                const float x = a[block + j] * (ln_c[block + j] + ln_amount);
                depth[block + j] += fast_exp(x > 6.0f ? 6.0f : x);
            }
        }
    }
    const bool aerosol = scattering && !amounts.aerosol.empty();
    const double* const haze = aerosol ? amounts.aerosol.data() : no_depth_.data();
    const double* const more_haze =
        aerosol && more != nullptr ? more->aerosol.data() : no_depth_.data();
#pragma omp simd
    for (std::size_t i = 0; i < count; ++i) {
        out[i] = w[0] * k[0][i] + w[1] * k[1][i] + w[2] * k[2][i] + w[3] * k[3][i] +
                 w[4] * k[4][i] + w[5] * k[5][i] + w[6] * k[6][i] + (haze[i] + more_haze[i]) +
                 double{gas[i]};
    }
}

}  // namespace diurna
