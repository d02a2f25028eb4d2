#include "scenes/job/run/instrument_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "materials/base/files.hpp"
#include "materials/base/number_of.hpp"
#include "materials/base/parallel.hpp"
#include "materials/radiation/planck.hpp"
#include "render/instrument/count_calibration.hpp"
#include "render/instrument/display.hpp"
#include "render/instrument/distortion.hpp"
#include "render/picture/exr.hpp"
#include "render/picture/grey_picture.hpp"
#include "scenes/job/plan/frame_files.hpp"
#include "scenes/job/run/camera_truth.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr double reach = 20.0;         // time constants after which a picture is forgotten
constexpr double sun_colour = 5772.0;  // [K] of light that bands below 3 µm see

double seconds_since_1970(Instant instant) {
    return std::chrono::duration<double>(instant.time_since_epoch()).count();
}

bool sees_heat(const Band& band) { return 0.5 * (band.from_um() + band.to_um()) >= 3.0; }

/// One instrument's work on its frames.
class Taking {
 public:
    Taking(const InstrumentView& view, const Prepared& prepared, const Sequence& sequence,
           const fs::path& out)
        : view_(view), prepared_(prepared), sequence_(sequence), out_(out) {}

    struct Messages {
        double integration_time = 0.0;
        std::size_t saturated = 0, dead = 0;
        bool lagged = false;
    };
    Messages take_frame(std::size_t k) const;

 private:
    fs::path base(std::size_t k) const {
        return out_ / instrument_base(view_.observer.name, view_.band.name, sequence_.frame[k]);
    }
    std::vector<float> flux_at(std::size_t k) const {
        const std::array<std::string, 1> wanted{"flux." + view_.band.name};
        return read_exr(base(k).string() + ".exr", wanted)[wanted[0]].pixel;
    }
    double between(std::size_t k) const {
        return seconds_between(sequence_.frame[k - 1], sequence_.frame[k]);
    }
    bool lag_up_to(std::size_t k, std::vector<float>& flux) const;
    void add_measured(const Shot& shot, Frame& frame) const;
    void add_facts(const Shot& shot, std::size_t k, Frame& frame) const;
    void write_grey(const Shot& shot, std::size_t k, const Frame& frame,
                    const std::vector<std::uint8_t>& shown) const;

    const InstrumentView& view_;
    const Prepared& prepared_;
    const Sequence& sequence_;
    const fs::path& out_;
};

/// What a bolometer shows of the flux at frame k; whether it remembers any picture before.
bool Taking::lag_up_to(std::size_t k, std::vector<float>& flux) const {
    const double tau = view_.camera.instrument.detector.time_constant;
    if (tau <= 0.0 || k == 0 || between(k) > forgotten_after * tau) return false;
    std::size_t from = k - 1;
    while (from > 0 && seconds_between(sequence_.frame[from], sequence_.frame[k]) < reach * tau &&
           between(from) <= forgotten_after * tau) {
        --from;
    }
    std::vector<float> seen = flux_at(from), shown = seen;
    for (std::size_t i = from + 1; i <= k; ++i) {
        std::vector<float> now = i == k ? flux : flux_at(i);
        const std::vector<float> next_seen = now;
        lag(tau, between(i), seen, shown, now);
        seen = next_seen;
        shown = std::move(now);
    }
    flux = std::move(shown);
    return true;
}

void Taking::add_measured(const Shot& shot, Frame& frame) const {
    const Camera& camera = view_.camera;
    const std::string& band = view_.band.name;
    frame.planes.push_back({"signal." + band, camera.response.unit, shot.signal});
    frame.planes.push_back({"measured." + band, camera.response.unit, shot.measured});
    Plane counts{"counts." + band, "1", {}};
    counts.pixel.assign(shot.counts.begin(), shot.counts.end());
    frame.planes.push_back(std::move(counts));
    Plane radiance{"measured_radiance." + band, "W m-2 sr-1", {}};
    radiance.pixel.resize(shot.measured.size());
    if (sees_heat(view_.band)) {
        Plane temperature{"measured_temperature." + band, "K",
                          measured_temperature(camera, shot.measured, shot.integration_time)};
        for_each_index(radiance.pixel.size(), [&](std::size_t p) {
            radiance.pixel[p] =
                static_cast<float>(temperature.pixel[p] > 0.0f
                                       ? band_radiance(view_.band, double{temperature.pixel[p]})
                                       : 0.0);
        });
        frame.planes.push_back(std::move(temperature));
    } else {
        const bool photon = camera.instrument.detector.kind == DetectorKind::photon;
        const double dark = camera.response.lens + camera.response.beside +
                            (photon ? camera.instrument.detector.dark_current : 0.0);
        const double worth = band_radiance(view_.band, sun_colour) /
                             band_radiance(camera.response.scene, sun_colour) /
                             camera.response.per_radiance;
        for (std::size_t p = 0; p < radiance.pixel.size(); ++p) {
            radiance.pixel[p] = static_cast<float>(
                (double{shot.measured[p]} / shot.integration_time - dark) * worth);
        }
    }
    frame.planes.push_back(std::move(radiance));
}

/// Its settings and what came of them, as attributes.
void Taking::add_facts(const Shot& shot, std::size_t k, Frame& frame) const {
    const Camera& camera = view_.camera;
    const Instrument& instrument = camera.instrument;
    const CountScale scale = count_scale(camera);
    const double seconds = seconds_since_1970(sequence_.frame[k]);
    auto& facts = frame.attributes;
    facts["instrument.name"] = instrument.name;
    facts["instrument.focal_length_mm"] = fmt::format("{:.9g}", 1e3 * camera.focal_length);
    facts["instrument.f_number"] = fmt::format("{:.9g}", instrument.lens.f_number);
    facts["instrument.pixel_pitch_um"] = fmt::format("{:.9g}", 1e6 * instrument.detector.pitch);
    if (instrument.detector.kind == DetectorKind::photon) {
        facts["instrument.integration_time_ms"] =
            fmt::format("{:.9g}", 1e3 * shot.integration_time);
    }
    facts["instrument.bits"] = fmt::format("{}", instrument.electronics.bits);
    facts["instrument.count_zero"] = fmt::format("{:.9g}", scale.zero);
    facts["instrument.counts_per_signal"] = fmt::format("{:.9g}", scale.per_signal);
    facts["instrument.frame_number"] = fmt::format("{}", frame_number(instrument, seconds));
    facts["instrument.hours_since_correction"] =
        fmt::format("{:.9g}", hours_since_correction(instrument, seconds));
    facts["instrument.saturated_pixels"] = fmt::format("{}", shot.saturated);
    if (sees_heat(view_.band)) {
        facts["instrument.netd_300K_mK"] =
            fmt::format("{:.6g}", 1e3 * netd_at(300.0, instrument, camera.response, camera.noise,
                                                1.0 / scale.per_signal));
    }
    frame.notes["instrument"] = camera.oversampling.why;
    frame.notes["left_out"] = fmt::format("{}", fmt::join(left_out(instrument), ", "));
}

void Taking::write_grey(const Shot& shot, std::size_t k, const Frame& frame,
                        const std::vector<std::uint8_t>& shown) const {
    const Camera& camera = view_.camera;
    const CountScale scale = count_scale(camera);
    const GreyFormat format = prepared_.scene.labels.format;
    const GreyPicture counts{.width = frame.width,
                             .height = frame.height,
                             .bits = camera.instrument.electronics.bits > 8 ? 16 : 8,
                             .count = shot.counts,
                             .scale = fmt::format("{} = {:g} + {:g} count", camera.response.unit,
                                                  scale.signal(0.0), 1.0 / scale.per_signal)};
    write_grey_picture(base(k).string() + extension_of(format), counts, format);
    const GreyPicture display{.width = frame.width,
                              .height = frame.height,
                              .bits = 8,
                              .count = {shown.begin(), shown.end()},
                              .scale = "display"};
    write_grey_picture(base(k).string() + "_display.png", display, GreyFormat::png);
}

Taking::Messages Taking::take_frame(std::size_t k) const {
    const Camera& camera = view_.camera;
    const std::string& band = view_.band.name;
    Frame frame = read_exr(base(k).string() + ".exr");
    std::vector<float> flux = frame["flux." + band].pixel;
    Messages reported{.lagged = lag_up_to(k, flux)};
    const double seconds = seconds_since_1970(sequence_.frame[k]);
    const Shot shot = take(camera, flux, frame_number(camera.instrument, seconds),
                           hours_since_correction(camera.instrument, seconds));
    reported.integration_time = shot.integration_time;
    reported.saturated = shot.saturated;
    reported.dead = shot.dead;
    // Only what seen_flux() left: a picture may be taken again.
    std::erase_if(frame.planes, [&](const Plane& plane) {
        return plane.name != "flux." + band && plane.name != "radiance." + band &&
               plane.name != "apparent_temperature." + band;
    });
    const std::vector<std::uint8_t> shown = displayed(shot.counts, camera.instrument.electronics);
    add_measured(shot, frame);
    Plane display{"display." + band, "1", {}};
    display.pixel.assign(shown.begin(), shown.end());
    frame.planes.push_back(std::move(display));
    add_facts(shot, k, frame);
    write_grey(shot, k, frame, shown);
    const CameraTags tags = camera_tags(prepared_, sequence_.at(k), sequence_.frame[k]);
    write_exr(base(k).string() + ".exr", frame, prepared_.scene.output.compression, &tags);
    return reported;
}

/// [K]: around what is seen; of what shines below 3 µm, glowing bodies.
std::string calibration_of(const InstrumentView& view) {
    if (!sees_heat(view.band)) {
        return calibration_csv(view.camera,
                               calibration(view.camera, view.band, 800.0, 3000.0, 50.0));
    }
    return calibration_csv(view.camera, calibration(view.camera, view.band, 233.0, 423.0, 1.0));
}

/// [pixels] by which distortion moves what is at the picture's border.
double largest_shift(const Camera& camera) {
    const double per_pixel = camera.instrument.detector.pitch / camera.focal_length;
    double most = 0.0;
    for (const double x : {0.0, 0.5 * camera.width}) {
        for (const double y : {0.0, 0.5 * camera.height}) {
            const Eigen::Vector2d place(x * per_pixel, y * per_pixel);
            const Eigen::Vector2d from = undistorted(camera.instrument.lens, place);
            most = std::max(most, (place - from).norm() / per_pixel);
        }
    }
    return most;
}

}  // namespace

std::vector<std::string> take_pictures(const InstrumentView& view, const Prepared& prepared,
                                       const Sequence& sequence,
                                       std::span<const std::size_t> wanted, const fs::path& out) {
    const Taking taking(view, prepared, sequence, out);
    std::vector<Taking::Messages> reported(wanted.size());
    for_each_index(
        wanted.size(), [&](std::size_t i) { reported[i] = taking.take_frame(wanted[i]); }, 1);
    write_whole_file(out / calibration_file(view.observer.name, view.band.name),
                     calibration_of(view));

    const Instrument& instrument = view.camera.instrument;
    const std::string name =
        fmt::format("{} of {} in {}: ", instrument.name, view.observer.name, view.band.name);
    std::vector<std::string> notes{name + view.camera.oversampling.why};
    notes.push_back(name + "effects without settings, not modelled: " +
                    fmt::format("{}", fmt::join(left_out(instrument), ", ")));
    if (sees_heat(view.band)) {
        notes.push_back(name + fmt::format("NETD at 300 K {:.3g} mK",
                                           1e3 * netd_at(300.0, instrument, view.camera.response,
                                                         view.camera.noise)));
    }
    if (const double by = largest_shift(view.camera); by > 0.5) {
        notes.push_back(name + fmt::format("lens distortion moves image points by up to {:.1f} "
                                           "pixels; truth planes and labels are not distorted",
                                           by));
    }
    std::vector<std::int64_t> number;
    for (const Instant when : sequence.frame) {
        number.push_back(frame_number(instrument, seconds_since_1970(when)));
    }
    if (std::adjacent_find(number.begin(), number.end()) != number.end()) {
        notes.push_back(
            name +
            fmt::format("pictures less than one frame period apart ({:g} Hz) have the same noise",
                        instrument.electronics.frame_rate));
    }
    if (prepared.scene.tolerance > 0.0) {
        notes.push_back(
            name +
            fmt::format("the instrument also images {} pixels beyond each edge; facets there may "
                        "have the temperature of a representative facet (tolerance_K)",
                        view.camera.margin));
    }
    if (reported.empty()) return notes;
    std::size_t saturated = 0, pictures = 0, lagged = 0;
    double shortest = reported.front().integration_time, longest = shortest;
    for (const Taking::Messages& one : reported) {
        saturated = std::max(saturated, one.saturated);
        pictures += one.saturated > 0 ? 1 : 0;
        lagged += one.lagged ? 1 : 0;
        shortest = std::min(shortest, one.integration_time);
        longest = std::max(longest, one.integration_time);
    }
    if (instrument.detector.kind == DetectorKind::photon) {
        const std::string least = fmt::format("{:.3g}", 1e3 * shortest),
                          most = fmt::format("{:.3g}", 1e3 * longest);
        notes.push_back(
            name +
            (least == most ? fmt::format("integration time {} ms", most)
                           : fmt::format("integration times {} to {} ms", least, most)) +
            (pictures == 0
                 ? "; no saturated pixels"
                 : fmt::format("; saturated pixels in {}, at most {} in one",
                               number_of(pictures, "picture"), number_of(saturated, "pixel"))));
    } else if (instrument.detector.time_constant > 0.0) {
        notes.push_back(
            name +
            fmt::format("thermal lag: {} of {} pictures follow another within {:g} time constants; "
                        "the others have no lag (error below a thousandth of the change)",
                        lagged, reported.size(), forgotten_after));
    }
    if (reported.front().dead > 0) {
        notes.push_back(
            name + fmt::format("{} not replaced", number_of(reported.front().dead, "dead pixel")));
    }
    return notes;
}

}  // namespace diurna
