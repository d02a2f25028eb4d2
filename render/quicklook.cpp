#include "render/quicklook.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <numbers>
#include <span>
#include <stdexcept>

#include "materials/error.hpp"
#include "materials/files.hpp"
#include "materials/units.hpp"
#include "render/bitmap_font.hpp"

namespace diurna {

namespace {

constexpr int colours = 250;
constexpr std::uint8_t background = 250, ink = 251, no_data = 252;

using Rgb = std::array<std::uint8_t, 3>;

/// CIE L*C*h (D65) to sRGB components before rounding; outside [0, 1] where it cannot be shown.
std::array<double, 3> srgb(double lightness, double chroma, double hue_deg) {
    const double fy = (lightness + 16.0) / 116.0;
    const double fx = fy + chroma * std::cos(radians(hue_deg)) / 500.0;
    const double fz = fy - chroma * std::sin(radians(hue_deg)) / 200.0;
    const auto unfold = [](double f) {
        return f > 6.0 / 29.0 ? f * f * f : (f - 4.0 / 29.0) * 3.0 * 36.0 / 841.0;
    };
    const double x = 0.95047 * unfold(fx), y = unfold(fy), z = 1.08883 * unfold(fz);
    const std::array<double, 3> linear = {3.2404542 * x - 1.5371385 * y - 0.4985314 * z,
                                          -0.9692660 * x + 1.8760108 * y + 0.0415560 * z,
                                          0.0556434 * x - 0.2040259 * y + 1.0572252 * z};
    std::array<double, 3> shown{};
    for (std::size_t i = 0; i < 3; ++i) {
        const double v = linear[i];
        shown[i] = v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
    }
    return shown;
}

Rgb palette_colour(double t) {
    // Lightness rises evenly from night violet over red to warm white; as colourful as it can be.
    const double lightness = 8.0 + 87.0 * t;
    const double hue_deg = 285.0 + 165.0 * t;
    double chroma = 14.0 + 50.0 * std::sin(std::numbers::pi * std::min(1.0, 0.05 + 0.9 * t));
    std::array<double, 3> rgb{};
    for (;; chroma -= 0.5) {
        rgb = srgb(lightness, chroma, hue_deg);
        const auto [least, most] = std::minmax_element(rgb.begin(), rgb.end());
        if ((*least >= 0.0 && *most <= 1.0) || chroma <= 0.0) break;
    }
    Rgb colour{};
    for (std::size_t i = 0; i < 3; ++i) {
        colour[i] = static_cast<std::uint8_t>(std::lround(255.0 * std::clamp(rgb[i], 0.0, 1.0)));
    }
    return colour;
}

/// An 8-bit picture of palette indices to draw on.
class Canvas {
 public:
    Canvas(int width, int height)
        : width_(width),
          height_(height),
          pixel_(std::size_t(width) * std::size_t(height), background) {}

    void set(int x, int y, std::uint8_t colour) {
        if (x >= 0 && y >= 0 && x < width_ && y < height_) {
            pixel_[std::size_t(y) * std::size_t(width_) + std::size_t(x)] = colour;
        }
    }
    void rectangle(int x, int y, int w, int h, std::uint8_t colour) {
        for (int j = 0; j < h; ++j) {
            for (int i = 0; i < w; ++i) set(x + i, y + j, colour);
        }
    }
    void text(int x, int y, int scale, std::string_view line) {
        for (const Glyph& glyph : glyphs_of(line)) {
            for (int j = 0; j < glyph_height; ++j) {
                for (int i = 0; i < glyph_width; ++i) {
                    if (glyph[std::size_t(j)] >> (glyph_width - 1 - i) & 1) {
                        rectangle(x + i * scale, y + j * scale, scale, scale, ink);
                    }
                }
            }
            x += glyph_advance * scale;
        }
    }
    int width() const { return width_; }
    int height() const { return height_; }
    const std::uint8_t* data() const { return pixel_.data(); }

 private:
    int width_, height_;
    std::vector<std::uint8_t> pixel_;
};

/// 1, 2 or 5 times a power of ten such that `span` holds at most `most` steps.
double tick_step(double span, int most) {
    const double rough = span / most;
    const double decade = std::pow(10.0, std::floor(std::log10(rough)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * decade >= rough * (1.0 - 1e-9)) return factor * decade;
    }
    return 10.0 * decade;
}

void draw_scale(Canvas& canvas, int x, int y, int height, const ColourScale& scale) {
    constexpr int bar = 18;
    for (int j = 0; j < height; ++j) {
        const double t = 1.0 - (j + 0.5) / height;
        canvas.rectangle(x, y + j, bar, 1,
                         static_cast<std::uint8_t>(std::min(colours - 1., t * colours)));
    }
    const double span = scale.high_C - scale.low_C;
    const double step = tick_step(span, std::max(2, height / 48));
    const int decimals = step < 0.1 ? 2 : step < 1.0 ? 1 : 0;
    for (double tick = std::ceil(scale.low_C / step - 1e-9) * step;
         tick <= scale.high_C + 1e-9 * span; tick += step) {
        const int row =
            y + static_cast<int>(std::lround((scale.high_C - tick) / span * (height - 1)));
        canvas.rectangle(x + bar, row, 6, 1, ink);
        const double shown = std::abs(tick) < 1e-9 * step ? 0.0 : tick;
        canvas.text(x + bar + 10, std::clamp(row - 7, y - 7, y + height - 9), 2,
                    fmt::format("{:.{}f}", shown, decimals));
    }
    canvas.text(x, y - 24, 2, "°C");
}

std::string default_title(const Frame& frame, const Plane& plane) {
    constexpr std::string_view apparent = "apparent_temperature.";
    const std::string what =
        plane.name.starts_with(apparent) ? plane.name.substr(apparent.size()) + " µm" : plane.name;
    return fmt::format("{}  {}  {}", frame.observer, what, format_instant(frame.instant));
}

std::uint8_t colour_of(float kelvins, const ColourScale& scale) {
    if (!std::isfinite(kelvins)) return no_data;
    const double t = (celsius(double{kelvins}) - scale.low_C) / (scale.high_C - scale.low_C);
    return static_cast<std::uint8_t>(std::clamp(t, 0.0, 1.0 - 1e-9) * colours);
}

std::vector<std::byte> encode_png(const Canvas& canvas) {
    std::array<std::uint8_t, 3 * 256> map{};
    for (int i = 0; i < colours; ++i) {
        const Rgb c = palette_colour(double(i) / (colours - 1));
        std::copy(c.begin(), c.end(), map.begin() + 3 * i);
    }
    const auto name = [&](std::uint8_t colour, Rgb rgb) {
        std::copy(rgb.begin(), rgb.end(), map.begin() + 3 * colour);
    };
    name(background, {22, 22, 26});
    name(ink, {232, 232, 228});
    name(no_data, {96, 96, 100});

    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(canvas.width());
    image.height = static_cast<png_uint_32>(canvas.height());
    image.format = PNG_FORMAT_RGB_COLORMAP;
    image.flags = PNG_IMAGE_FLAG_FAST;
    image.colormap_entries = 256;
    std::vector<std::byte> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, canvas.data(), 0, map.data())) {
        throw std::runtime_error(fmt::format("PNG cannot be encoded: {}", image.message));
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace

ColourScale colour_scale(const Frame& frame, const std::string& plane) {
    const Plane* solid = frame.find("temperature");
    if (!solid) return colour_scale(frame[plane]);
    Plane seen = frame[plane];
    for (std::size_t p = 0; p < seen.pixel.size(); ++p) {
        if (!std::isfinite(solid->pixel[p])) seen.pixel[p] = std::nanf("");
    }
    return colour_scale(seen);
}

ColourScale colour_scale(const Plane& plane) {
    std::vector<float> value;
    for (const float v : plane.pixel) {
        if (std::isfinite(v) && v > 0.0f) value.push_back(v);
    }
    if (value.empty()) return {0.0, 1.0};
    const auto percentile = [&](double share) {
        const auto place = static_cast<std::ptrdiff_t>(share * double(value.size() - 1));
        std::nth_element(value.begin(), value.begin() + place, value.end());
        return celsius(double{value[static_cast<std::size_t>(place)]});
    };
    const double low = std::floor(percentile(0.01));
    return {low, std::max(low + 1.0, std::ceil(percentile(0.99)))};
}

void write_quicklook(const std::filesystem::path& path, const Frame& frame,
                     const std::string& plane_name, const QuicklookOptions& options) {
    const Plane& plane = frame[plane_name];
    ColourScale scale = colour_scale(frame, plane_name);
    if (options.low_C) scale.low_C = *options.low_C;
    if (options.high_C) scale.high_C = *options.high_C;
    if (!(scale.high_C > scale.low_C)) {
        throw InputError("quick-look", fmt::format("the colour scale runs from {} to {} °C",
                                                   scale.low_C, scale.high_C));
    }
    const std::string title = options.title.empty() ? default_title(frame, plane) : options.title;

    constexpr int margin = 10, top = 42, scale_width = 110;
    const int picture_width = std::max(frame.width, 64);
    Canvas canvas(picture_width + scale_width + 2 * margin,
                  std::max(frame.height, 64) + top + margin);
    const int room = canvas.width() - scale_width - margin;
    const bool large = static_cast<int>(glyphs_of(title).size()) * 2 * glyph_advance <= room;
    canvas.text(margin, large ? 12 : 16, large ? 2 : 1, title);
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t at = std::size_t(y) * std::size_t(frame.width) + std::size_t(x);
            canvas.set(margin + x, top + y, colour_of(plane.pixel[at], scale));
        }
    }
    draw_scale(canvas, margin + picture_width + 14, top, std::max(frame.height, 64), scale);
    write_whole_file(path, encode_png(canvas));
}

std::vector<std::byte> encode_thumbnail(const Frame& frame, const std::string& plane_name,
                                        const ColourScale& scale, int shrink) {
    const Plane& plane = frame[plane_name];
    Canvas canvas(std::max(1, frame.width / shrink), std::max(1, frame.height / shrink));
    for (int y = 0; y < canvas.height(); ++y) {
        for (int x = 0; x < canvas.width(); ++x) {
            double sum = 0.0;
            int count = 0;
            for (int j = y * shrink; j < std::min(frame.height, (y + 1) * shrink); ++j) {
                for (int i = x * shrink; i < std::min(frame.width, (x + 1) * shrink); ++i) {
                    const float kelvins =
                        plane.pixel[std::size_t(j) * std::size_t(frame.width) + std::size_t(i)];
                    if (!std::isfinite(kelvins)) continue;
                    sum += kelvins;
                    ++count;
                }
            }
            const auto mean = static_cast<float>(count > 0 ? sum / count : std::nan(""));
            canvas.set(x, y, colour_of(mean, scale));
        }
    }
    return encode_png(canvas);
}

}  // namespace diurna
