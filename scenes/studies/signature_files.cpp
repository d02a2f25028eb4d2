#include "scenes/studies/signature_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "materials/base/units.hpp"
#include "scenes/charts/html.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

using OrderedJson = nlohmann::ordered_json;
using Rows = std::span<const SignatureRow>;

/// Rows of one instant and band, in the order of the report.
std::vector<Rows> discs_of(const SignatureReport& report) {
    std::vector<Rows> discs;
    const Rows all = report.rows;
    for (std::size_t from = 0; from < all.size();) {
        std::size_t to = from;
        while (to < all.size() && all[to].when == all[from].when &&
               all[to].band == all[from].band) {
            ++to;
        }
        discs.push_back(all.subspan(from, to - from));
        from = to;
    }
    return discs;
}

OrderedJson extremes(Rows rows, double SignatureRow::*what) {
    double least = INFINITY, most = -INFINITY, sum = 0.0;
    std::size_t count = 0;
    for (const SignatureRow& row : rows) {
        const double value = row.*what;
        if (std::isnan(value)) continue;
        least = std::min(least, value);
        most = std::max(most, value);
        sum += value;
        ++count;
    }
    if (count == 0) return nullptr;
    return {{"least", least}, {"mean", sum / double(count)}, {"greatest", most}};
}

/// "" of what is not known.
std::string reported(double value) { return std::isnan(value) ? "" : fmt::format("{:.6g}", value); }

// The picture.

constexpr double radius = 92.0, pitch = 250.0, row_pitch = 264.0, plot_left = 120.0,
                 top = 64.0;  // [px]

/// From white to a dark red, or to blue below zero.
std::string colour(double share) {
    const std::array<double, 3> far =
        share >= 0.0 ? std::array<double, 3>{165, 0, 38} : std::array<double, 3>{49, 54, 149};
    const double s = std::clamp(std::abs(share), 0.0, 1.0);
    const auto part = [&](std::size_t i) { return int(std::lround(std::lerp(247.0, far[i], s))); };
    return fmt::format("#{:02x}{:02x}{:02x}", part(0), part(1), part(2));
}

/// One disc about (x, y), its title and ends of the scale below.
std::string disc(Rows rows, double SignatureRow::*what, double x, double y) {
    double most = 0.0, dot = radius;
    for (const SignatureRow& row : rows) {
        if (!std::isnan(row.*what)) most = std::max(most, std::abs(row.*what));
    }
    dot = radius * 0.95 / std::sqrt(double(std::max<std::size_t>(rows.size(), 1)));
    std::string text = fmt::format(
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"#fff\" stroke=\"#888\"/>\n", x, y,
        radius + dot);
    for (const SignatureRow& row : rows) {
        const double out = radius * (90.0 - row.elevation_deg) / 90.0;
        const double turn = radians(row.aspect_deg), value = row.*what;
        const bool known = !std::isnan(value) && row.area > 0.0;
        text += fmt::format(
            "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{:.1f}\" fill=\"{}\" stroke=\"#bbb\" "
            "stroke-width=\"0.5\"><title>{:.0f}, {:.0f} deg: {}</title></circle>\n",
            x + out * std::sin(turn), y - out * std::cos(turn), dot,
            known ? colour(most > 0.0 ? value / most : 0.0) : "none", row.aspect_deg,
            row.elevation_deg, known ? fmt::format("{:.4g} W/sr", value) : "not seen");
    }
    return text;
}

std::string signature_words(double x, double y, const std::string& text, const char* more = "") {
    return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\"{}>{}</text>\n", x, y,
                       more, text);
}

std::string range_reported(Rows rows, double SignatureRow::*what) {
    const OrderedJson ends = extremes(rows, what);
    if (ends.is_null()) return "not known";
    return fmt::format("{:.3g} to {:.3g} W/sr", ends["least"].get<double>(),
                       ends["greatest"].get<double>());
}

}  // namespace

std::string signature_csv(const SignatureReport& report, double utc_offset) {
    std::string text =
        "time,band_um,aspect_deg,elevation_deg,projected_area_m2,radiant_intensity_W_sr,"
        "contrast_intensity_W_sr,background_radiance_W_m2_sr\n";
    for (const SignatureRow& row : report.rows) {
        text += fmt::format("{},{},{:.4f},{:.4f},{:.6g},{:.6g},{},{}\n",
                            format_local(row.when, utc_offset), row.band, row.aspect_deg,
                            row.elevation_deg, row.area, row.intensity, reported(row.contrast),
                            reported(row.background));
    }
    return text;
}

std::string signature_json(const SignatureInput& input, const SignatureReport& report,
                           const std::vector<std::string>& notes, double utc_offset) {
    OrderedJson json{
        {"study", "signature"}, {"name", input.name}, {"object", input.studied.object}};
    json["range_m"] = input.range > 0.0 ? OrderedJson(input.range) : OrderedJson(nullptr);
    json["directions"] = input.directions;
    json["directions_below_the_level"] = report.below;
    json["pixels"] = input.pixels;
    json["samples"] = input.samples;
    json["radiant_intensity"] =
        "integral of radiance over the visible projected area, W/sr; with range_m: irradiance at "
        "the observer times the range squared, atmosphere included";
    json["contrast_intensity"] =
        "radiant intensity minus the mean radiance of the surrounding picture times the projected "
        "area";
    json["notes"] = notes;
    json["summary"] = OrderedJson::array();
    for (const Rows rows : discs_of(report)) {
        json["summary"].push_back(
            {{"time", format_local(rows.front().when, utc_offset)},
             {"band_um", rows.front().band},
             {"projected_area_m2", extremes(rows, &SignatureRow::area)},
             {"radiant_intensity_W_sr", extremes(rows, &SignatureRow::intensity)},
             {"contrast_intensity_W_sr", extremes(rows, &SignatureRow::contrast)}});
    }
    return json.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::string signature_svg(const SignatureInput& input, const SignatureReport& report,
                          double utc_offset) {
    const std::size_t bands = input.bands.size();
    const double width = plot_left + 2.0 * pitch * double(bands);
    const double height = top + row_pitch * double(input.studied.frames.size()) + 20.0;
    std::string text = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {:.0f} {:.0f}\" width=\"{:.0f}\" "
        "height=\"{:.0f}\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#fff\"/>\n",
        width, height, width, height);
    text += signature_words(
        0.5 * width, 22.0,
        escaped(fmt::format(
            "{}{}: front at the top, horizontal directions at the rim, vertical in the centre",
            input.studied.object,
            input.range > 0.0 ? fmt::format(" from {:g} m", input.range) : std::string())),
        " font-size=\"15\"");
    std::size_t at = 0;
    for (const Rows rows : discs_of(report)) {
        const std::size_t band = at % bands, instant = at / bands;
        const double y = top + row_pitch * (double(instant) + 0.5);
        double x = plot_left + pitch * (2.0 * double(band) + 0.5);
        if (band == 0) {
            const std::string when = format_local(rows.front().when, utc_offset);
            text += signature_words(0.5 * plot_left, y, when.substr(0, 10));
            text += signature_words(0.5 * plot_left, y + 16.0,
                                    when.size() > 16 ? when.substr(11, 5) : "");
        }
        const std::array<std::pair<const char*, double SignatureRow::*>, 2> both{
            {{"intensity", &SignatureRow::intensity}, {"contrast", &SignatureRow::contrast}}};
        for (const auto& [name, what] : both) {
            if (instant == 0) {
                text += signature_words(x, top - 14.0,
                                        escaped(fmt::format("{}, {}", rows.front().band, name)));
            }
            text += disc(rows, what, x, y);
            text += signature_words(x, y + radius + 32.0, range_reported(rows, what),
                                    " font-size=\"11\"");
            x += pitch;
        }
        ++at;
    }
    return text + "</svg>\n";
}

}  // namespace diurna
