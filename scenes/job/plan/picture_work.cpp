#include "scenes/job/plan/picture_work.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "materials/matter/waves.hpp"
#include "scenes/job/plan/costly_pixels.hpp"
#include "scenes/job/plan/instrument_cost.hpp"
#include "scenes/job/plan/picture_samples.hpp"
#include "scenes/job/plan/plan_costs.hpp"

namespace diurna {

namespace {

constexpr double planes_of_picture = 14.0;  // of truth, beside those of its bands

/// For an observer: pixels that are looked at, blocks that are followed, and poses for these.
constexpr std::size_t looked_at = 144, blocks = 16, poses_looked_at = 4;

/// [m s⁻¹] Mean over an observer's frames, over water.
double mean_wind(const Weather& weather, const std::vector<Instant>& frames) {
    double sum = 0.0;
    for (const Instant when : frames) {
        sum += wind_over_water(weather.at(when).wind_speed, weather.wind_height);
    }
    return sum / std::max(1.0, double(frames.size()));
}

/// Of a picture, mean over an observer's views.
FollowedRays of_a_view(const Scene& scene, const World& world, const Weather& weather,
                       const RayScene& rays, const ObserverInput& observer,
                       const Sequence& sequence) {
    const std::size_t count = std::min(poses_looked_at, sequence.pose.size());
    if (count == 0 || observer.frames.empty()) return {};
    const FollowedOptions options{.samples = observer.samples,
                                  .by_need = adaptive_secondary(scene, observer),
                                  .wind_speed = mean_wind(weather, observer.frames),
                                  .looked_at = looked_at / count,
                                  .blocks = blocks / count};
    FollowedRays mean;
    for (std::size_t k = 0; k < count; ++k) {
        Observer pose = sequence.pose[k * sequence.pose.size() / count];
        pose.width = observer.width;
        pose.height = observer.height;
        const FollowedRays one = followed_rays(scene, world, rays, pose, options);
        mean.pixels += one.pixels / double(count);
        mean.in_lobes += one.in_lobes / double(count);
        mean.rays += one.rays / double(count);
        mean.secondary += one.secondary / double(count);
    }
    return mean;
}

/// Adds what its pictures take of rays that go on, and returns that of one view.
FollowedRays add_onward(const FollowedRays& each, double views, double pictures, PictureWork& work,
                        FollowedLight& light) {
    work.followed_rays += views * each.rays;
    light.secondary += each.secondary * pictures;
    light.lobes += std::sqrt(each.in_lobes) * pictures;
    return each;
}

/// Adds the rays of its views that take more than others.
void add_costly(const CostlyPixels& costly, double pixels, int samples, const Sequence& sequence,
                PictureWork& work) {
    const double rays = pixels * samples * double(sequence.pose.size());
    work.smoke_rays += costly.smoke * rays;
    work.textured_rays += costly.textured * rays;
}

/// An observer as an instrument of its samples the radiance, without margins.
ObserverInput sampled_by(const ObserverInput& observer, const InstrumentCost& cost) {
    const int times = cost.oversampling.times;
    ObserverInput seen = observer;
    seen.width *= times;
    seen.height *= times;
    seen.samples = cost.samples;
    seen.surfaces = 0;
    if (seen.adaptive) {
        seen.adaptive->from = seen.samples = std::max(2, seen.adaptive->from / (times * times));
        seen.adaptive->to = std::max(seen.samples, seen.adaptive->to / (times * times));
    }
    return seen;
}

double channels_of(const Scene& scene, const std::string& cube) {
    const auto at = std::find_if(scene.cubes.begin(), scene.cubes.end(),
                                 [&](const CubeInput& one) { return one.name == cube; });
    return at == scene.cubes.end() ? 0.0 : double(at->channels);
}

}  // namespace

PictureWork picture_work(const Scene& scene, const World& world, const Weather& weather,
                         const RayScene* rays, std::span<const Sequence> sequences,
                         std::span<const Plume> plumes) {
    PictureWork work;
    std::vector<CostlyPixels> costly(scene.observers.size());
    for (std::size_t o = 0; o < scene.observers.size(); ++o) {
        const ObserverInput& observer = scene.observers[o];
        const double pixels = double(observer.width) * observer.height;
        const double bands = double(observer.bands.size());
        const double frames = double(observer.frames.size());
        double channels = 0.0;
        for (const std::string& cube : observer.cubes) channels += channels_of(scene, cube);
        work.pictures += bands * frames;
        work.pixels += pixels * bands * frames;
        work.surface_pixels += pixels * observer.surfaces * bands * frames;
        work.channel_pictures += channels * frames;
        work.channel_pixels += pixels * channels * frames;
        const double planes = planes_of_picture + bands * (observer.terms ? 8.0 : 2.0);
        FollowedRays each;
        if (rays != nullptr && o < sequences.size()) {
            each = add_onward(of_a_view(scene, world, weather, *rays, observer, sequences[o]),
                              double(sequences[o].pose.size()), frames * bands, work, work.onward);
            costly[o] = costly_pixels(world, plumes, observer, sequences[o]);
            if (!sequences[o].goes) work.standing_views += plan_costs.view_pixel * pixels;
            add_costly(costly[o], pixels, observer.samples, sequences[o], work);
            work.onward.smoke += costly[o].smoke * pixels * frames * bands;
        }
        const double behind = plan_costs.smoke_sample * costly[o].smoke * observer.samples;
        work.largest_other =
            std::max(work.largest_other, pixels * (plan_costs.other_pixel + behind) +
                                             plan_costs.secondary_bytes * each.secondary);
        work.largest_view =
            std::max(work.largest_view,
                     pixels * (plan_costs.view_pixel + behind + plan_costs.plane_value * planes +
                               plan_costs.channel_value * channels +
                               plan_costs.surface_value * observer.surfaces * bands) +
                         plan_costs.secondary_bytes * each.secondary);
    }
    for (const InstrumentInput& input : scene.instruments) {
        const ObserverInput& observer = observer_of(scene, input);
        const auto o = static_cast<std::size_t>(&observer - scene.observers.data());
        if (rays == nullptr || o >= sequences.size()) continue;
        const ObserverInput seen = sampled_by(observer, instrument_cost(scene, input));
        add_onward(of_a_view(scene, world, weather, *rays, seen, sequences[o]),
                   double(sequences[o].pose.size()), double(observer.frames.size()), work,
                   work.of_instruments);
        const double pixels = double(seen.width) * seen.height;
        add_costly(costly[o], pixels, seen.samples, sequences[o], work);
        work.of_instruments.smoke += costly[o].smoke * pixels * double(observer.frames.size());
    }
    return work;
}

}  // namespace diurna
