#include "materials/atmosphere/sunlit_path.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "materials/atmosphere/scaled_aerosol.hpp"
#include "materials/base/fast_exp.hpp"
#include "materials/base/units.hpp"

namespace diurna {

namespace {

constexpr double dark = 460.0;  // optical depth that counts as no light

/// Mean over a stretch of a transmittance that falls exponentially, nearly, from `before` to
/// `after` by the optical depth x: (1 − e⁻ˣ) / x, by its series where it cancels.
double mean_between(double before, double after, double x) {
    const bool cancels = (x < 0.0 ? -x : x) < 0.01;
    const double series = before * (1.0 - x * (0.5 - x * (1.0 / 6.0)));
    return cancels ? series : (before - after) / (cancels ? 1.0 : x);
}

/// Optical depths of all bins, and the transmittances.
struct Passage {
    std::vector<double> depth, share;

    explicit Passage(std::size_t bins) : depth(bins, 0.0), share(bins, 1.0) {}
    void set_share() {
        double *const x = depth.data(), *const out = share.data();
        const std::size_t count = share.size();
#pragma omp simd
        for (std::size_t b = 0; b < count; ++b) {
            x[b] = x[b] < dark ? x[b] : dark;
            out[b] = x[b];
        }
        negative_exponentials(share);
    }
};

/// One direction to the sun: how the line turns its light.
struct Direction {
    double turn;  // cosine of the angle by which light turns
    /// Share of the forward peak that is spread out again: light of the peak that is scattered
    /// into it once more. Close to the sun the peak is thinned by all extinction, far from it
    /// (where it is no peak) by the scaled one.
    double peaked;
    std::array<std::vector<double>, 3> phase;  // of the parts of the aerosol, (bin)
    std::vector<double> excess;                // (bin) light the peak loses before the eye
};

Direction direction_of(const Medium& medium, double turn) {
    Direction d;
    d.turn = turn;
    const double t = std::clamp((degrees(std::acos(d.turn)) - 20.0) / 40.0, 0.0, 1.0);
    d.peaked = 1.0 - t * t * (3.0 - 2.0 * t);
    d.phase = phase_functions(medium, d.turn);
    d.excess.assign(medium.bins().size(), 0.0);
    return d;
}

/// A stretch of the line: its middle and length, and how much of the beam a cloud lets through.
struct Stretch {
    double height_km, length, through;
};

/// Sunlight gathered along a line, stretch after stretch outward from the eye.
class Gathering {
 public:
    Gathering(const SunlitAir& air, bool under_cloud, std::span<const double> turn, double start_km,
              const SightLine& onward);

    /// A stretch and the height of its far end.
    void add(double middle_km, double end_km, double length);
    /// Whoever multiplies what is behind by the whole transmittance leaves out what its forward
    /// peak brings: diffuse light of the end's own direction.
    void add_peak_of_what_is_behind(double end_km, double sign = 1.0);
    ScatteredLight light() const;

 private:
    void follow(const SightLine& onward);
    /// Transmittance of both ways: from the sun to a height, and on along the line.
    void beam_at(double height_km, Passage& out) const;
    void scatter_once(const ScaledAerosol& aerosol, const Stretch& stretch);
    void scatter_often(const ScaledAerosol& aerosol, const Stretch& stretch);
    void thin_peak(const ScaledAerosol& aerosol, const Stretch& stretch);

    const SunlitAir& air_;
    const bool under_cloud_;
    const DiffuseField& field_;
    const Medium medium_;
    const std::size_t count_;
    std::vector<Direction> directions_;
    bool any_peaked_ = false;
    Amounts seen_;  // from the eye
    // Once-scattered light per phase function: ∫ scattering · transmittance of both ways ds.
    std::vector<double> by_air_;
    std::array<std::vector<double>, 3> by_aerosol_;
    std::vector<double> often_, by_cosine_;  // light scattered more often
    std::vector<double> peak_seen_;          // optical depth that scaling took, from the eye
    Passage both_before_, both_after_, tau_before_, tau_after_;
    // Of a stretch: mean transmittance of both ways, times length; and that of the peak's light.
    std::vector<double> single_, thinned_;
    std::vector<double> lobes_;  // of the aerosol in a direction
};

Gathering::Gathering(const SunlitAir& air, bool under_cloud, std::span<const double> turn,
                     double start_km, const SightLine& onward)
    : air_(air),
      under_cloud_(under_cloud),
      field_(under_cloud ? air.cloudy : air.clear),
      medium_(air.model, air.bins),
      count_(air.bins.size()),
      seen_(medium_.none()),
      by_air_(count_, 0.0),
      often_(count_, 0.0),
      by_cosine_(count_, 0.0),
      peak_seen_(count_, 0.0),
      both_before_(count_),
      both_after_(count_),
      tau_before_(count_),
      tau_after_(count_),
      single_(count_),
      thinned_(count_),
      lobes_(count_) {
    for (const double cosine : turn) {
        directions_.push_back(direction_of(medium_, cosine));
        any_peaked_ = any_peaked_ || directions_.back().peaked > 0.0;
    }
    if (onward.size() > 0) follow(onward);
    beam_at(start_km, both_before_);
}

/// The way to an eye scatters light of its own, which is not asked for; but whoever has asked for
/// it has been given what its forward peak brings of something behind, which is this very light.
void Gathering::follow(const SightLine& onward) {
    for (std::size_t i = 0; i < onward.size(); ++i) {
        const ScaledAerosol aerosol = scaled_aerosol(medium_, onward.height_km[i]);
        medium_.add(onward.height_km[i], onward.length_km[i], aerosol.extinction, seen_);
        for (std::size_t b = 0; b < count_; ++b) {
            peak_seen_[b] += onward.length_km[i] * aerosol.peak(b);
        }
    }
    medium_.depths(seen_, tau_before_.depth);
    tau_before_.set_share();
    add_peak_of_what_is_behind(onward.height_within(onward.size() - 1, 1.0), -1.0);
}

void Gathering::beam_at(double height_km, Passage& out) const {
    const HermiteWeights w = air_.at_height(height_km);
    if (!air_.sun_reaches(w)) {
        std::fill(out.depth.begin(), out.depth.end(), dark);
        std::fill(out.share.begin(), out.share.end(), 0.0);
        return;
    }
    medium_.depths(amounts_to_sun(air_, medium_, w), seen_, out.depth);
    out.set_share();
}

void Gathering::add(double middle_km, double end_km, double length) {
    const ScaledAerosol aerosol = scaled_aerosol(medium_, middle_km);
    medium_.add(middle_km, length, aerosol.extinction, seen_);
    beam_at(end_km, both_after_);
    medium_.depths(seen_, tau_after_.depth);
    tau_after_.set_share();
    const bool shaded = under_cloud_ && middle_km < air_.model.cloud.base_km;
    const Stretch stretch{middle_km, length, shaded ? air_.beam_through_cloud : 1.0};
    scatter_once(aerosol, stretch);
    scatter_often(aerosol, stretch);
    if (any_peaked_) thin_peak(aerosol, stretch);
    double* const peak = peak_seen_.data();
    const double *const whole = aerosol.whole.aerosol_extinction.data(), *const scaled =
                                                                             aerosol.extinction
                                                                                 .data();
#pragma omp simd
    for (std::size_t b = 0; b < count_; ++b) peak[b] += length * (whole[b] - scaled[b]);
    std::swap(both_before_, both_after_);
    std::swap(tau_before_, tau_after_);
}

void Gathering::scatter_once(const ScaledAerosol& aerosol, const Stretch& stretch) {
    const double length = stretch.through * stretch.length;
    const double *const share_before = both_before_.share.data(),
                        *const share_after = both_after_.share.data(),
                        *const depth_before = both_before_.depth.data(),
                        *const depth_after = both_after_.depth.data(),
                        *const rayleigh = aerosol.whole.rayleigh.data();
    double *const single = single_.data(), *const by_air = by_air_.data();
#pragma omp simd
    for (std::size_t b = 0; b < count_; ++b) {
        single[b] = length *
                    mean_between(share_before[b], share_after[b], depth_after[b] - depth_before[b]);
        by_air[b] += rayleigh[b] * single[b];
    }
    for (std::size_t k = 0; k < by_aerosol_.size(); ++k) {
        const std::vector<double>& part = aerosol.whole.part[k];
        if (part.empty()) continue;
        if (by_aerosol_[k].empty()) by_aerosol_[k].assign(count_, 0.0);
        const double* const scattering = part.data();
        double* const sum = by_aerosol_[k].data();
#pragma omp simd
        for (std::size_t b = 0; b < count_; ++b) sum[b] += scattering[b] * single[b];
    }
}

void Gathering::scatter_often(const ScaledAerosol& aerosol, const Stretch& stretch) {
    const HermiteWeights w = air_.at_height(stretch.height_km);
    const LevelCurves::Row rising = field_.up.row(w), falling = field_.down.row(w);
    const double *const share_before = tau_before_.share.data(),
                        *const share_after = tau_after_.share.data(),
                        *const depth_before = tau_before_.depth.data(),
                        *const depth_after = tau_after_.depth.data(),
                        *const rayleigh = aerosol.whole.rayleigh.data(),
                        *const scattering = aerosol.scattering.data(),
                        *const asymmetry = aerosol.asymmetry.data();
    double *const often = often_.data(), *const by_cosine = by_cosine_.data();
    const double length = stretch.length;
#pragma omp simd
    for (std::size_t b = 0; b < count_; ++b) {
        const double up = rising[b], down = falling[b];
        // Eddington's radiance, scattered: light that comes down the line moves against it.
        // Asymmetries are below a half, so that it is never negative.
        const double mean_radiance = (up + down) * 0.5 * std::numbers::inv_pi;
        const double tilt = 0.75 * std::numbers::inv_pi * (down - up);
        const double reach = length * mean_between(share_before[b], share_after[b],
                                                   depth_after[b] - depth_before[b]);
        often[b] += reach * (rayleigh[b] + scattering[b]) * mean_radiance;
        by_cosine[b] += reach * scattering[b] * asymmetry[b] * tilt;
    }
}

void Gathering::thin_peak(const ScaledAerosol& aerosol, const Stretch& stretch) {
    const LevelCurves::Row above = air_.peak.row(air_.at_height(stretch.height_km));
    const double length = stretch.length, lit_length = stretch.through * length;
    const double *const share_before = both_before_.share.data(),
                        *const share_after = both_after_.share.data(),
                        *const depth_before = both_before_.depth.data(),
                        *const depth_after = both_after_.depth.data(),
                        *const whole = aerosol.whole.aerosol_extinction.data(),
                        *const scaled = aerosol.extinction.data(), *const seen = peak_seen_.data(),
                        *const single = single_.data(),
                        *const scattering = aerosol.scattering.data(),
                        *const asymmetry = aerosol.asymmetry.data();
    double *const thinned = thinned_.data(), *const lobes = lobes_.data();
#pragma omp simd
    for (std::size_t b = 0; b < count_; ++b) {
        const double thinner = length * (whole[b] - scaled[b]);
        const double before = fast_exp(-seen[b] - above[b]);
        const double after = before * fast_exp(-thinner);
        thinned[b] = lit_length * mean_between(share_before[b] * before, share_after[b] * after,
                                               depth_after[b] - depth_before[b] + thinner);
    }
    for (Direction& d : directions_) {
        if (d.peaked <= 0.0) continue;
        std::fill(lobes_.begin(), lobes_.end(), 0.0);
        for (std::size_t k = 0; k < d.phase.size(); ++k) {
            if (aerosol.whole.part[k].empty()) continue;
            const double *const part = aerosol.whole.part[k].data(), *const phase =
                                                                         d.phase[k].data();
#pragma omp simd
            for (std::size_t b = 0; b < count_; ++b) lobes[b] += part[b] * phase[b];
        }
        const double turn = d.turn;
        double* const excess = d.excess.data();
#pragma omp simd
        for (std::size_t b = 0; b < count_; ++b) {
            const double peak = lobes[b] - scattering[b] * henyey_greenstein(asymmetry[b], turn);
            excess[b] += (peak > 0.0 ? peak : 0.0) * (thinned[b] - single[b]);
        }
    }
}

void Gathering::add_peak_of_what_is_behind(double end_km, double sign) {
    const HermiteWeights w = air_.at_height(end_km);
    for (std::size_t b = 0; b < count_; ++b) {
        const double up = field_.up.at(w, b), down = field_.down.at(w, b);
        const double share =
            sign * tau_before_.share[b] * -std::expm1(-peak_seen_[b]) * 0.5 * std::numbers::inv_pi;
        often_[b] += share * (up + down);
        by_cosine_[b] += share * (down - up);
    }
}

ScatteredLight Gathering::light() const {
    ScatteredLight light{{}, by_cosine_};
    for (const Direction& d : directions_) {
        const double rayleigh_phase = 0.75 * (1.0 + d.turn * d.turn);
        std::vector<double>& of_turn = light.at_turn.emplace_back(count_);
        for (std::size_t b = 0; b < count_; ++b) {
            double once = by_air_[b] * rayleigh_phase + d.peaked * d.excess[b];
            for (std::size_t k = 0; k < by_aerosol_.size(); ++k) {
                if (!by_aerosol_[k].empty()) once += by_aerosol_[k][b] * d.phase[k][b];
            }
            of_turn[b] = air_.above_air[b] * 0.25 * std::numbers::inv_pi * once + often_[b];
        }
    }
    return light;
}

}  // namespace

std::vector<double> turns(const SunLight& sun, double zenith_deg,
                          std::span<const double> azimuth_from_sun_deg) {
    const double view = std::cos(radians(zenith_deg)), sin_view = std::sin(radians(zenith_deg));
    const double sun_up = std::cos(radians(sun.zenith_deg)),
                 sun_aside = std::sin(radians(sun.zenith_deg));
    std::vector<double> turn;
    for (const double azimuth : azimuth_from_sun_deg) {
        const double turned = view * sun_up + sin_view * sun_aside * std::cos(radians(azimuth));
        turn.push_back(std::clamp(turned, -1.0, 1.0));
    }
    return turn;
}

std::vector<double> ScatteredLight::towards(std::size_t turn, double cosine) const {
    std::vector<double> sum = at_turn[turn];
    for (std::size_t b = 0; b < sum.size(); ++b) sum[b] += cosine * by_cosine[b];
    return sum;
}

void ScatteredLight::scale(double factor) {
    for (std::vector<double>& of_turn : at_turn) {
        for (double& value : of_turn) value *= factor;
    }
    for (double& value : by_cosine) value *= factor;
}

void ScatteredLight::mix(double share, const ScatteredLight& other) {
    const auto mix_in = [share](std::vector<double>& of, const std::vector<double>& with) {
        for (std::size_t b = 0; b < of.size(); ++b) of[b] += share * (with[b] - of[b]);
    };
    for (std::size_t a = 0; a < at_turn.size(); ++a) mix_in(at_turn[a], other.at_turn[a]);
    mix_in(by_cosine, other.by_cosine);
}

ScatteredLight scattered_light(const SunlitAir& air, const SightLine& line,
                               std::span<const double> turn, bool under_cloud,
                               bool something_behind, const SightLine& onward) {
    const std::vector<double> none(air.bins.size(), 0.0);
    if (line.size() == 0 || none.empty()) {
        return {std::vector<std::vector<double>>(turn.size(), none), none};
    }
    Gathering gathering(air, under_cloud, turn, line.height_within(0, 0.0), onward);
    // Few segments (level lines have one) are cut so that the product of both ways is followed.
    const int cuts = line.size() < 12 ? static_cast<int>(16 / line.size()) + 1 : 1;
    for (std::size_t segment = 0; segment < line.size(); ++segment) {
        for (int cut = 0; cut < cuts; ++cut) {
            gathering.add(line.height_within(segment, (cut + 0.5) / cuts),
                          line.height_within(segment, (cut + 1.0) / cuts),
                          line.length_km[segment] / cuts);
        }
    }
    if (something_behind) {
        gathering.add_peak_of_what_is_behind(line.height_within(line.size() - 1, 1.0));
    }
    return gathering.light();
}

}  // namespace diurna
