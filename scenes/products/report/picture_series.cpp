#include "scenes/products/report/picture_series.hpp"

#include <fmt/format.h>

#include <utility>

#include "scenes/charts/clock_names.hpp"
#include "scenes/charts/html.hpp"
#include "terrain/place/local_time.hpp"

namespace diurna {

namespace {

constexpr int ticks = 5;

std::string image(const char* style, const std::string& says, const std::vector<std::byte>& png) {
    return fmt::format("<img{} alt=\"{}\" src=\"data:image/png;base64,{}\">", style, says,
                       base64(png));
}

std::string figure(const PictureSeries& series, const SeriesPicture& picture,
                   const Prepared& prepared) {
    const double offset = prepared.scene.time.utc_offset;
    const std::string time = clock_time(picture.when, offset),
                      day = clock_day(picture.when, offset);
    const std::string says = escaped(series.heading) + ", " + day + " " + time;
    std::string out =
        fmt::format("<figure data-at=\"{:.3f}\" data-low=\"{:g}\" data-high=\"{:g}\">",
                    seconds_between(Instant{}, picture.when), picture.low, picture.high);
    out += image(picture.common.empty() ? "" : " class=\"each\"", says, picture.png);
    if (!picture.common.empty()) out += image(" class=\"common\"", says, picture.common);
    out += fmt::format("<figcaption><b>{}</b> {}, {} solar", time, day,
                       format_solar_time(prepared.world.site, picture.when));
    if (!series.unit.empty()) {
        out +=
            fmt::format("<br>{:.3g} to {:.3g} {}", picture.low, picture.high, escaped(series.unit));
    }
    return out + "</figcaption></figure>\n";
}

/// What the two scales are called, and which is chosen to begin with.
std::string choice(std::size_t number) {
    constexpr std::pair<const char*, const char*> scales[] = {
        {"each", "own scale for each picture"}, {"one", "one scale for all"}};
    std::string out;
    for (const auto& [name, says] : scales) {
        out += fmt::format(
            "<input class=\"pick {0}\" type=\"radio\" name=\"scale{1}\" id=\"{0}{1}\"{2}>"
            "<label class=\"pick\" for=\"{0}{1}\"> {3}</label>\n",
            name, number, out.empty() ? " checked" : "", says);
    }
    return out;
}

std::string bar(const PictureSeries& series, const char* of, bool numbers, const char* says) {
    std::string out =
        fmt::format("<div class=\"scale {}\"><div class=\"bar {}\"></div><div class=\"ticks\">", of,
                    series.warm ? "warm" : "grey");
    for (int i = 0; i < ticks; ++i) {
        const double value = series.low + (series.high - series.low) * i / (ticks - 1);
        const char* end = i == 0 ? "lowest" : i == ticks - 1 ? "highest" : "";
        out += numbers ? fmt::format("<span>{:.3g}</span>", value)
                       : fmt::format("<span>{}</span>", end);
    }
    return out + fmt::format("</div><p>{}, {}</p></div>\n", escaped(series.unit), says);
}

}  // namespace

std::string picture_series(const PictureSeries& series, const Prepared& prepared,
                           std::size_t number) {
    std::string out =
        fmt::format("<section class=\"series\"><h3>{}</h3>\n", escaped(series.heading));
    if (!series.unit.empty()) out += choice(number);
    out += fmt::format(
        "<div class=\"player\" hidden><img class=\"big\" alt=\"\"><p class=\"now\"></p>\n"
        "<input type=\"range\" min=\"0\" max=\"{}\" step=\"1\" value=\"0\" aria-label=\"time\">"
        "<label class=\"together\"><input type=\"checkbox\" checked> move all series together"
        "</label></div>\n",
        series.picture.size() - 1);
    if (!series.unit.empty()) {
        out +=
            bar(series, "each", false, "scale of each picture; its limits are below the picture") +
            bar(series, "common", true, "scale of all pictures");
    }
    out += "<div class=\"sheet\">\n";
    for (const SeriesPicture& picture : series.picture) out += figure(series, picture, prepared);
    return out + "</div></section>\n";
}

}  // namespace diurna
