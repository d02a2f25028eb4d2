#include "scenes/products/report/swatch_chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "materials/matter/net_optics.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/products/report/material_figures.hpp"

namespace diurna {

namespace {

constexpr double row_height = 34.0, top = 44.0, swatch = 26.0;             // [px]
constexpr double at_swatch = 12.0, at_name = 46.0, at_spectrum = 236.0;    // left edges
constexpr double spectrum_width = 330.0, at_bars = 590.0, bar_width = 80;  // of each of four
constexpr double bar_step = 130.0, width = at_bars + 4 * bar_step + 96.0;
constexpr double first_um = 0.3, last_um = 20.0;

double x_of(double um) {
    return at_spectrum + spectrum_width * std::log(um / first_um) / std::log(last_um / first_um);
}

/// Reflectance as an sRGB screen shows it (IEC 61966-2-1).
std::string colour_of(const std::array<double, 3>& rgb) {
    const auto level = [](double linear) {
        const double x = std::clamp(linear, 0.0, 1.0);
        const double shown = x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1.0 / 2.4) - 0.055;
        return static_cast<int>(std::lround(255.0 * shown));
    };
    return fmt::format("#{:02x}{:02x}{:02x}", level(rgb[0]), level(rgb[1]), level(rgb[2]));
}

/// A curve of 0 to 1 over a row, closed along its foot.
std::string curve(const Spectrum& s, double foot, const char* style) {
    std::string path = fmt::format("<path {} d=\"M{:.1f} {:.1f}", style, x_of(first_um), foot);
    const auto point = [&](double um) {
        path += fmt::format("L{:.1f} {:.1f}", x_of(um), foot - swatch * s.at(um));
    };
    point(first_um);
    for (const double um : s.wavelength_um) {
        if (um > first_um && um < last_um) point(um);
    }
    point(last_um);
    return path + fmt::format("L{:.1f} {:.1f}z\"/>\n", x_of(last_um), foot);
}

/// One of the four bars, filled to a share, its figure behind it.
std::string swatch_bar(int column, double foot, double share, const char* colour,
                       const std::string& figure) {
    const double left = at_bars + column * bar_step;
    return fmt::format(
        "<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{2:.1f}\" height=\"12\" fill=\"#eeeeee\"/>"
        "<rect x=\"{0:.1f}\" y=\"{1:.1f}\" width=\"{3:.1f}\" height=\"12\" fill=\"{4}\"/>"
        "<text x=\"{5:.1f}\" y=\"{6:.1f}\">{7}</text>\n",
        left, foot - 20.0, bar_width, bar_width * std::clamp(share, 0.0, 1.0), colour,
        left + bar_width + 5.0, foot - 10.0, figure);
}

std::string swatch_row(const Material& given, double foot) {
    Material material = given;
    take_strips(material);  // of a net
    const MaterialFigures f = material_figures(material);
    std::string out = fmt::format(
        "<rect x=\"{}\" y=\"{:.1f}\" width=\"26\" height=\"26\" fill=\"{}\" stroke=\"#999999\"/>"
        "<text x=\"{}\" y=\"{:.1f}\" class=\"n\">{}</text>\n",
        at_swatch, foot - swatch, colour_of(f.visible), at_name, foot - 9.0,
        escaped(material.name));
    out += curve(material.reflectance, foot, "fill=\"#c9d4e3\" stroke=\"#2b4a77\"");
    if (!material.transmittance.empty()) {
        out += curve(material.transmittance, foot,
                     "fill=\"none\" stroke=\"#b5651d\" stroke-dasharray=\"3 2\"");
    }
    out += swatch_bar(0, foot, f.albedo, "#d9a400", fmt::format("{:.2f}", f.albedo));
    out += swatch_bar(1, foot, f.mwir, "#c2452d", fmt::format("{:.3f}", f.mwir));
    out += swatch_bar(2, foot, f.lwir, "#8e1f4f", fmt::format("{:.3f}", f.lwir));
    // Inertia from 30 to 30 000, by decades.
    out += swatch_bar(3, foot, std::log10(f.inertia / 30.0) / 3.0, "#4d7f4d",
                      fmt::format("{:.0f}, {:.3g}", f.inertia, 1e6 * f.diffusivity));
    return out;
}

std::string swatch_head(double height) {
    std::string out = fmt::format(
        "<svg viewBox=\"0 0 {0:.0f} {1:.0f}\" width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" "
        "xmlns=\"http://www.w3.org/2000/svg\">\n<style>text{{font:11px sans-serif;fill:#333}}"
        ".n{{font-size:13px}}.h{{font-weight:bold}}.u{{text-anchor:middle;fill:#777}}</style>\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"#ffffff\"/>\n",
        width, height);
    const auto title = [&](double x, const char* text) {
        out += fmt::format("<text x=\"{:.1f}\" y=\"16\" class=\"h\">{}</text>\n", x, text);
    };
    title(at_name, "material");
    title(at_spectrum, "reflectance (dashed: transmittance), 0 to 1, over µm");
    title(at_bars, "albedo");
    title(at_bars + bar_step, "ε 3-5 µm");
    title(at_bars + 2 * bar_step, "ε 8-12 µm");
    title(at_bars + 3 * bar_step, "inertia J/m²K√s, diffusivity mm²/s");
    for (const double um : {0.4, 0.7, 1.0, 1.5, 2.0, 3.0, 5.0, 8.0, 12.0, 20.0}) {
        out += fmt::format(
            "<path d=\"M{0:.1f} 36V{1:.1f}\" stroke=\"#dddddd\"/><text x=\"{0:.1f}\" y=\"32\" "
            "class=\"u\">{2:g}</text>\n",
            x_of(um), height - 8.0, um);
    }
    return out;
}

}  // namespace

std::string swatch_chart(const MaterialLibrary& library) {
    const std::vector<std::string> names = library.names();
    std::string out = swatch_head(top + row_height * double(names.size()) + 12.0);
    double foot = top + swatch;
    for (const std::string& name : names) {
        out += swatch_row(library[library.find(name)], foot);
        foot += row_height;
    }
    return out + "</svg>\n";
}

}  // namespace diurna
