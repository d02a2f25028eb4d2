// Pictures of rough ground of 2 million triangles, seen obliquely: what casting costs against bare
// Embree, what shading adds, what a frame costs once the view is cast, and how the error falls with
// the number of samples. The time of rows on one thread is the processor's.
//
//   render_bench [posts = 1001] [size = 1024]

#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <time.h>
#include <algorithm>
#include <array>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <numbers>

#include "materials/base/parallel.hpp"
#include "materials/base/units.hpp"
#include "materials/matter/read_library.hpp"
#include "materials/radiation/planck.hpp"
#include "render/light/lit_facets.hpp"
#include "render/picture/exr.hpp"
#include "render/tracer.hpp"
#include "render/view/adaptive.hpp"
#include "render/view/cast_view.hpp"
#include "render/view/pixel_samples.hpp"
#include "terrain/place/site.hpp"
#include "terrain/visibility/ray_bundles.hpp"
#include "terrain/visibility/ray_scene.hpp"
#include "terrain/visibility/sun_fraction.hpp"
#include "terrain/visibility/view_factor_sampling.hpp"

using namespace diurna;

namespace {

double now() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
}

/// Time the process has had on its processors [s]: unlike wall time, little changed by neighbours.
double cpu_now() {
    timespec time{};
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return double(time.tv_sec) + 1e-9 * double(time.tv_nsec);
}

/// Median time of a few runs: processor time on one thread, wall time on more.
template <class Work>
double median_time(int threads, int runs, const Work& work) {
    const auto clock = [&] { return threads == 1 ? cpu_now() : now(); };
    std::vector<double> times;
    for (int i = 0; i < runs; ++i) {
        const double start = clock();
        work();
        times.push_back(clock() - start);
    }
    std::nth_element(times.begin(), times.begin() + runs / 2, times.end());
    return times[std::size_t(runs / 2)];
}

/// Sums of sines of random direction: relief of about 1200 m over 10 km, rough down to 20 m.
double relief(double x, double y) {
    double z = 0.0, wave = 8000.0, height = 300.0, angle = 0.4;
    for (int octave = 0; octave < 9; ++octave) {
        const double k = 2.0 * std::numbers::pi / wave;
        z += height * std::sin(k * (x * std::cos(angle) + y * std::sin(angle)) + octave) *
             std::cos(k * 0.8 * (y * std::cos(angle) - x * std::sin(angle)) + 2.0 * octave);
        wave *= 0.5;
        height *= 0.5;
        angle += 1.3;
    }
    return z;
}

FacetSet rough_ground(int posts, double size, std::span<const MaterialId> used) {
    std::vector<Eigen::Vector3d> vertex;
    std::vector<std::array<std::uint32_t, 3>> triangle;
    const double step = size / (posts - 1);
    for (int j = 0; j < posts; ++j) {
        for (int i = 0; i < posts; ++i) {
            const double x = i * step - 0.5 * size, y = j * step - 0.5 * size;
            vertex.emplace_back(x, y, relief(x, y));
        }
    }
    for (int j = 0; j + 1 < posts; ++j) {
        for (int i = 0; i + 1 < posts; ++i) {
            const auto a = std::uint32_t(j * posts + i), up = std::uint32_t(posts);
            triangle.push_back({a, a + 1, a + up + 1});
            triangle.push_back({a, a + up + 1, a + up});
        }
    }
    FacetSet facets;
    append_facets(facets, vertex, triangle, std::vector<MaterialId>(triangle.size(), used.front()),
                  ObjectId{0});
    for (std::size_t f = 0; f < facets.size(); ++f) {
        const Eigen::Vector3f& c = facets.centroid[f];
        const auto patch = std::size_t(
            std::abs(std::floor(c.x() / 300.0f) * 7.0f + std::floor(c.y() / 300.0f) * 3.0f));
        facets.material[f] = used[patch % used.size()];
    }
    return facets;
}

/// Seconds that Embree alone takes for the very rays of cast_view(), sixteen at a time in coherent
/// packets: those of the pixels' samples, and those of their middles. Tiles of 32 x 32; the rays
/// of a row of one are laid out before the clock starts.
std::array<double, 2> bare_seconds(const FacetSet& facets, const RayScene& rays,
                                   const Observer& observer) {
    RTCDevice device = rtcNewDevice("isa=avx2");
    RTCScene scene = rtcNewScene(device);
    rtcSetSceneFlags(scene, RTC_SCENE_FLAG_ROBUST);
    RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12, facets.vertex.size()));
    auto* corner = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12, facets.corner.size()));
    for (std::size_t v = 0; v < facets.vertex.size(); ++v) {
        std::copy_n(facets.vertex[v].data(), 3, vertex + 3 * v);
    }
    for (std::size_t f = 0; f < facets.size(); ++f) {
        std::copy_n(facets.corner[f].data(), 3, corner + 3 * f);
    }
    rtcCommitGeometry(geometry);
    rtcAttachGeometry(scene, geometry);
    rtcReleaseGeometry(geometry);
    rtcCommitScene(scene);

    constexpr int tile = 32;
    const PixelSamples samples(observer, 16, ViewOptions{}.seed);
    RayBundles bundles(rays, tile);
    bundles.set_origin(samples.origin());
    std::vector<RTCRayHit16> packets(tile);
    alignas(64) int valid[16];
    std::fill_n(valid, 16, -1);
    const auto seconds_of = [&](std::size_t count) {
        for (std::size_t p = 0; p < count; ++p) {
            RTCRayHit16& packet = packets[p];
            for (std::size_t s = 0; s < 16; ++s) {
                const std::size_t ray = 16 * p + s;
                packet.ray.org_x[s] = bundles.origin_x[ray];
                packet.ray.org_y[s] = bundles.origin_y[ray];
                packet.ray.org_z[s] = bundles.origin_z[ray];
                packet.ray.dir_x[s] = bundles.direction_x[ray];
                packet.ray.dir_y[s] = bundles.direction_y[ray];
                packet.ray.dir_z[s] = bundles.direction_z[ray];
                packet.ray.tnear[s] = 0.0f;
                packet.ray.tfar[s] = 1e30f;
                packet.ray.time[s] = 0.0f;
                packet.ray.mask[s] = 0xFFFFFFFFu;
                packet.ray.flags[s] = 0;
                packet.hit.geomID[s] = RTC_INVALID_GEOMETRY_ID;
                packet.hit.instID[0][s] = RTC_INVALID_GEOMETRY_ID;
            }
        }
        const double start = cpu_now();
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
        for (std::size_t p = 0; p < count; ++p) {
            rtcIntersect16(valid, scene, &context, &packets[p]);
        }
        return cpu_now() - start;
    };
    std::array<double, 2> seconds{};
    for (int y0 = 0; y0 + tile <= observer.height; y0 += tile) {
        for (int x0 = 0; x0 + tile <= observer.width; x0 += tile) {
            for (int y = y0; y < y0 + tile; ++y) {
                for (int k = 0; k < tile; ++k) {
                    samples.aim(std::size_t(x0 + k), std::size_t(y), 0, std::size_t(k), bundles);
                }
                seconds[0] += seconds_of(tile);
                if (y % 4 != 0) continue;
                for (int k = 0; k < tile / 4; ++k) {
                    samples.aim_middles(std::size_t(x0 + 4 * k), std::size_t(y), std::size_t(k),
                                        bundles);
                }
                seconds[1] += seconds_of(tile / 4);
            }
        }
    }
    rtcReleaseScene(scene);
    rtcReleaseDevice(device);
    return seconds;
}

/// Root mean square difference of apparent temperatures [K].
double rms(const Frame& a, const Frame& b, const std::string& plane) {
    const auto &x = a[plane].pixel, &y = b[plane].pixel;
    double sum = 0.0;
    for (std::size_t p = 0; p < x.size(); ++p) sum += (x[p] - y[p]) * (x[p] - y[p]);
    return std::sqrt(sum / double(x.size()));
}

/// The scene of all rows: rough ground at one instant, and who looks at it.
struct Stage {
    int size;  // of the picture [pixel]
    MaterialLibrary materials = default_material_library();
    FacetSet facets;
    RayScene rays;
    FacetViews sky;
    Eigen::Vector3d to_sun = direction(110.0, 35.0);
    std::vector<float> sun, temperature;  // (facet)
    Atmosphere air =
        BandModel{.profile = afgl_profile("MLS"), .aerosol = "rural", .visibility_km = 23.0};
    Observer aerial{};
    std::vector<Band> lw{flat_band("8-12", 8.0, 12.0, bin_edges_um())};
    std::vector<Band> both{flat_band("3-5", 3.0, 5.0, bin_edges_um()), lw[0]};

    Stage(int posts, int size_)
        : size(size_), facets(rough_ground(posts, 10e3, used())), rays(facets) {
        const double start = now();
        sky = facet_views(facets, rays, {.rays = 32});
        fmt::print(stderr, "{} facets, sky view {:.1f} s, {:.1f} exchange entries each\n",
                   facets.size(), now() - start,
                   double(sky.others.facet.size()) / double(facets.size()));
        sun.resize(facets.size());
        sun_fraction(facets, rays, to_sun, sun);
        temperature.resize(facets.size());
        for (std::size_t f = 0; f < facets.size(); ++f) {
            temperature[f] =
                288.0f - 0.0065f * facets.centroid[f].z() +
                18.0f * sun[f] * std::max(0.0f, facets.normal[f].dot(to_sun.cast<float>()));
        }
        aerial.name = "aerial";
        aerial.position = {-6000.0, -6000.0, 3000.0};
        aerial = looking_at(aerial, {0.0, 0.0, -300.0});
        aerial.horizontal_fov_deg = 50.0;
        aerial.width = aerial.height = size;
    }
    std::vector<MaterialId> used() const {
        std::vector<MaterialId> ids;
        for (const char* name : {"grass", "forest", "bare_soil", "rock"}) {
            ids.push_back(materials.find(name));
        }
        return ids;
    }
    RadianceInput input(std::span<const float> temperatures) const {
        return {.facets = facets,
                .views = sky,
                .materials = materials,
                .atmosphere = air,
                .temperature = temperatures,
                .sun_fraction = sun,
                .to_sun = to_sun,
                .sun_zenith_deg = 55.0,
                .ground_height_km = 0.8};
    }
    std::string setting() const { return fmt::format("{}x{}x16", size, size); }
    void row(const char* name, const char* method, const std::string& setting, int threads,
             double seconds, double error, const char* unit) const {
        fmt::print("{},{},{},{},{},{:.4f},{:.4g},{}\n", name, method, setting, facets.size(),
                   threads, seconds, error, unit);
        std::fflush(stdout);
    }
};

/// Casting a view and rendering from it, on one thread and two. Returns the seconds of casting on
/// one.
double frame_rows(const Stage& s) {
    const double rays = 17.0 * s.size * s.size;  // with the one through the pixel's centre
    View view;
    double cast[3] = {}, frame[3] = {}, two_bands[3] = {};
    for (const int threads : {1, 2}) {
        set_thread_count(threads);
        cast[threads] =
            median_time(threads, 3, [&] { view = cast_view(s.rays, s.facets, s.aerial, {}); });
        s.row("cast", "cast_view", s.setting(), threads, cast[threads], 1e-6 * rays / cast[threads],
              "Mray/s");
        const LitFacets lit = lit_facets(s.input(s.temperature), view.surface, s.lw);
        const LitFacets lit_both = lit_facets(s.input(s.temperature), view.surface, s.both);
        Frame picture;
        frame[threads] = median_time(threads, 7, [&] {
            picture =
                render(view, s.aerial, s.lw, s.input(s.temperature), {.truth = false, .lit = &lit});
        });
        s.row("frame", "from_view", s.setting() + " 8-12", threads, frame[threads],
              cast[threads] / frame[threads], "x cheaper than casting");
        two_bands[threads] = median_time(threads, 5, [&] {
            picture = render(view, s.aerial, s.both, s.input(s.temperature),
                             {.truth = false, .lit = &lit_both});
        });
        s.row("frame", "from_view", s.setting() + " 3-5 8-12", threads, two_bands[threads], 0.0,
              "");
    }
    fmt::print(stderr, "{} targets, {:.2f} sightings a pixel\n", view.surface.size(),
               double(view.sighting.size()) / double(view.pixels()));
    s.row("ratio", "cast_to_cast_and_shade", s.setting(), 1, 0.0, cast[1] / (cast[1] + frame[1]),
          "must 0.80");
    s.row("ratio", "frame_to_rendering_again", s.setting(), 1, 0.0, frame[1] / (cast[1] + frame[1]),
          "must 0.083");
    s.row("ratio", "two_threads_cast", s.setting(), 2, 0.0, cast[1] / cast[2], "must 1.85");
    s.row("ratio", "two_threads_frame", s.setting(), 2, 0.0, frame[1] / frame[2], "must 1.85");
    return cast[1];
}

/// A day of pictures, written.
void day_rows(const Stage& s) {
    set_thread_count(0);
    Observer camera = s.aerial;
    camera.width = 640;
    camera.height = 512;
    const auto folder = std::filesystem::temp_directory_path() /
                        fmt::format("diurna-render-bench-{}", std::uint64_t(1e6 * now()));
    std::filesystem::create_directories(folder);
    double start = now();
    const double cpu_start = cpu_now();
    const View still = cast_view(s.rays, s.facets, camera, {});
    const double still_cast = now() - start;
    const LitFacets lit = lit_facets(s.input(s.temperature), still.surface, s.both);
    for_each_index(
        24,
        [&](std::size_t hour) {
            std::vector<float> warm(s.temperature.size());
            for (std::size_t f = 0; f < warm.size(); ++f) {
                warm[f] = s.temperature[f] + 0.2f * float(hour);
            }
            RadianceInput state = s.input(warm);
            state.instant = later(state.instant, 3600.0 * double(hour));
            const Frame picture = render(still, camera, s.both, state, {.lit = &lit});
            for (const Band& band : s.both) {
                write_exr(folder / (frame_name(picture, band.name) + ".exr"),
                          band_frame(picture, band.name));
            }
        },
        1);
    const double day = now() - start, day_cpu = cpu_now() - cpu_start;
    s.row("day", "24_frames_2_bands_exr", "640x512x16", 2, day, still_cast, "s of it casting");
    // Half of it is the wall time of two processors that nobody else uses.
    s.row("day", "processor_time", "640x512x16", 2, day_cpu, day_cpu / day, "processors had");
    std::filesystem::remove_all(folder);
}

/// Error against samples, alike in all pixels and where they are needed; processor time of casting.
/// What facets look like is known as it is in a job: their temperatures and materials.
void samples_rows(const Stage& s, const Observer& eye) {
    const View finest = cast_view(s.rays, s.facets, eye, {.samples = 1024});
    const Frame truth = render(finest, eye, s.lw, s.input(s.temperature), {.truth = false});
    const auto samples_row = [&](const char* method, const auto& cast_it) {
        const double begin = cpu_now();
        const View some = cast_it();
        const double seconds = cpu_now() - begin;
        const Frame picture = render(some, eye, s.lw, s.input(s.temperature), {.truth = false});
        s.row("samples", method,
              fmt::format("{} {}x{}x{:.1f}", eye.name, eye.width, eye.height,
                          double(some.rays) / double(some.pixels()) - 1.0),
              1, seconds, rms(picture, truth, "apparent_temperature.8-12"), "K rms");
    };
    for (const int samples : {1, 2, 4, 8, 16, 32, 64, 128, 256}) {
        samples_row("uniform", [&] {
            return cast_view(s.rays, s.facets, eye, {.samples = samples, .seed = 7});
        });
    }
    const Appearance appearance{
        .facet = thermal_appearance(s.facets, s.sky, s.materials, s.temperature, s.lw[0]),
        .sky = 250.0f};
    for (const double tolerance : {0.4, 0.2, 0.1, 0.05, 0.025}) {
        samples_row("adaptive", [&] {
            return cast_adaptive_view(s.rays, s.facets, eye, {&appearance, 1},
                                      {.from = 16, .to = 1024, .tolerance = tolerance},
                                      {.seed = 7});
        });
    }
}

/// The middle of the aerial picture; and near slopes, ridges and sky.
std::array<Observer, 2> sampled_observers(const Stage& s) {
    Observer part = s.aerial;
    part.width = part.height = s.size / 4;
    part.horizontal_fov_deg =
        2.0 * degrees(std::atan(0.25 * std::tan(0.5 * radians(s.aerial.horizontal_fov_deg))));
    Observer ground = part;
    ground.name = "ground";
    ground.position = {-3000.0, -3000.0, relief(-3000.0, -3000.0) + 30.0};
    ground = looking_at(ground, {0.0, 0.0, ground.position.z() - 50.0});
    ground.horizontal_fov_deg = 50.0;
    return {part, ground};
}

/// - cast: seconds that cast_view took on one thread
void bare_rows(const Stage& s, double cast) {
    set_thread_count(1);
    const auto [bare_samples, bare_middles] = bare_seconds(s.facets, s.rays, s.aerial);
    s.row("cast", "embree_alone_samples", s.setting(), 1, bare_samples,
          1e-6 * 16.0 * double(s.size) * s.size / bare_samples, "Mray/s");
    s.row("cast", "embree_alone_middles", s.setting(), 1, bare_middles,
          1e-6 * double(s.size) * s.size / bare_middles, "Mray/s");
    s.row("ratio", "cast_view_to_embree_same_rays", s.setting(), 1, 0.0,
          (bare_samples + bare_middles) / cast, "must 0.90");
    s.row("ratio", "cast_view_to_embree_samples_only", s.setting(), 1, 0.0, bare_samples / cast,
          "middles counted as ours");
}

}  // namespace

int main(int argc, char** argv) {
    const Stage stage(argc > 1 ? std::atoi(argv[1]) : 1001, argc > 2 ? std::atoi(argv[2]) : 1024);
    fmt::print("case,method,setting,facets,threads,wall_s,error,unit\n");
    const double cast = frame_rows(stage);
    day_rows(stage);
    for (const Observer& eye : sampled_observers(stage)) samples_rows(stage, eye);
    // Last: a second device made while threads are limited keeps the first to one for good.
    bare_rows(stage, cast);
}
