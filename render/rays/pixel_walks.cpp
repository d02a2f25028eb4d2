#include "render/rays/pixel_walks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "render/rays/merge.hpp"

namespace diurna {

namespace {

/// Times as many samples as asked at first, until so many meet what is followed.
constexpr int most_of_first = 16, least_met = 2;

double fraction(double x) { return x - std::floor(x); }

/// Rays of a pixel into lobes that meet things near by: as many as these, at most so many for each
/// sample. Those of a pixel are a lattice (golden_section): a straight edge's share of 64 is found
/// to 0.003.
constexpr int lobe_rays_of_pixel = 64, most_lobe_rays = 4;

/// The samples take the lattice's points in steps of this, so that those in one part of a pixel,
/// where a mirror's edge crosses it, spread over the whole lobe: of 256 half find a share to 0.014
/// rms, in the lattice's own order to 0.17 in the lower half. Near a quarter, prime to their
/// number.
int lattice_step(int samples) {
    int step = std::max(1, static_cast<int>(std::lround(samples * (std::sqrt(5.0) - 2.0))));
    while (std::gcd(step, samples) != 1) ++step;
    return step;
}

/// Whether a sample only meets what the view knows the share of.
bool known(const SecondaryScene& scene, const AskedPixel& asked,
           std::span<const SecondaryRay> sample) {
    if (asked.shares.followed == 0.0f) return false;
    return sample.front().kind != SecondaryRay::Kind::facet ||
           !scene.needs_rays(sample.front().surface());
}

/// - values: what each sample that is followed shows; null, or no sampling: not requested
WalkedPixel follow(const PixelWalks& walks, const AskedPixel& asked, int samples, int lobe_rays,
                   std::uint64_t seed, std::vector<double>* values) {
    const auto& [scene, observer, eye, options, sampling] = walks;
    const std::size_t p = asked.pixel;
    const auto [columns, rows] = nearly_square(samples);
    const auto width = static_cast<std::size_t>(observer.width);
    std::vector<SecondaryRay> sample;
    WalkedPixel walked;
    std::vector<SecondaryRay>& seen = walked.seen;
    RandomStream of_pixel{(seed << 32) + p};
    const double offset = of_pixel();
    const int step = lattice_step(samples);
    const std::array<double, 2> turn = {of_pixel(), of_pixel()};
    for (int s = 0; s < samples; ++s) {
        RandomStream chance{(seed * golden_step) ^
                            ((std::uint64_t{p} << 16) + std::uint64_t(s)) * second_step};
        const double x = chance(), y = chance();
        const double column = double(p % width) + (s % columns + x) / columns;
        const double row = double(p / width) + (double(s / columns) + y) / rows;
        const double when = exposed(std::size_t(s), offset);
        const int point = s * step % samples;
        sample.clear();
        walked.rays +=
            walk(scene,
                 {.origin = observer.position + eye.start(column, row, when),
                  .direction = eye.towards(column, row, when),
                  .weight = 1.0f / static_cast<float>(samples),
                  .lobe = {.count = lobe_rays,
                           .first = {fraction(turn[0] + double(point) / (samples * lobe_rays)),
                                     fraction(turn[1] + point * golden_section)},
                           .step = {1.0 / lobe_rays, samples * golden_section}}},
                 chance, sample);
        if (known(scene, asked, sample)) continue;
        ++walked.met;
        if (values && sampling) sample_values(scene, sample, sampling->appearances, *values);
        add_sample(sample, scene.plumes, seen);
    }
    if (walked.met > 0 && asked.shares.followed > 0.0f) {
        const float scale = asked.shares.followed * float(samples) / float(walked.met);
        for (SecondaryRay& secondary : seen) secondary.weight *= scale;
        for (const SecondaryRay& plain : asked.shares.plain) {
            add_sample({&plain, 1}, scene.plumes, seen);
        }
    }
    // Past the plumes after all?
    const bool plain = std::all_of(seen.begin(), seen.end(), [&](const SecondaryRay& secondary) {
        return secondary.before < 0 && !secondary.closed &&
               secondary.kind != SecondaryRay::Kind::plume &&
               !(secondary.kind == SecondaryRay::Kind::facet &&
                 scene.needs_rays(secondary.surface()));
    });
    if (plain) seen.clear();
    return walked;
}

}  // namespace

WalkedPixel PixelWalks::first(const AskedPixel& asked, int& wanted) const {
    wanted = sampling ? sampling->options.from : options.samples;
    const int most = sampling ? sampling->options.to : most_of_first * wanted;
    std::vector<double> values;
    WalkedPixel walked = follow(*this, asked, wanted, 1, options.seed, &values);
    // What covers little of a pixel may be missed.
    while (walked.met < least_met && 2 * wanted <= most) {
        wanted *= 2;
        values.clear();
        const std::uint64_t before = walked.rays;
        walked = follow(*this, asked, wanted, 1, options.seed, &values);
        walked.rays += before;
    }
    if (sampling == nullptr || walked.seen.empty()) return walked;
    // The share is known: only what differs within it matters.
    const double share = double(walked.met) / wanted;
    SecondarySampling within = *sampling;
    within.options.from = walked.met;
    within.options.to = static_cast<int>(share * most);
    within.options.tolerance /= share;
    wanted *= std::max(1, samples_wanted(values, within) / walked.met);
    return walked;
}

WalkedPixel PixelWalks::all(const AskedPixel& asked, int samples, bool many) const {
    const int wanted = (lobe_rays_of_pixel + samples - 1) / samples;
    return follow(*this, asked, samples, many ? std::min(most_lobe_rays, wanted) : 1,
                  options.seed + golden_step, nullptr);
}

}  // namespace diurna
