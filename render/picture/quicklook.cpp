#include "render/picture/quicklook.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <span>
#include <stdexcept>

#include "materials/base/files.hpp"
#include "render/picture/bitmap_font.hpp"
#include "render/picture/palette.hpp"

namespace diurna {

namespace {

constexpr int colours = 250;
constexpr std::uint8_t background = 250, ink = 251, no_data = 252;
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

/// Width of a text in pixels.
int width_of(std::string_view text, int scale) {
    return static_cast<int>(glyphs_of(text).size()) * scale * glyph_advance;
}

void draw_scale(Canvas& canvas, int x, int y, int height, const ColourScale& scale,
                std::string_view unit) {
    constexpr int bar = 18;
    for (int j = 0; j < height; ++j) {
        const double t = 1.0 - (j + 0.5) / height;
        canvas.rectangle(x, y + j, bar, 1,
                         static_cast<std::uint8_t>(std::min(colours - 1., t * colours)));
    }
    const double span = scale.high - scale.low;
    const double step = tick_step(span, std::max(2, height / 48));
    const double longest = std::max(std::abs(scale.low), std::abs(scale.high));
    const int room = canvas.width() - (x + bar + 10);
    const int size = width_of(fmt::format("{:.6g}", longest), 2) > room ||
                             width_of(fmt::format("{:.6g}", step), 2) > room
                         ? 1
                         : 2;
    for (double tick = std::ceil(scale.low / step - 1e-9) * step; tick <= scale.high + 1e-9 * span;
         tick += step) {
        const int row =
            y + static_cast<int>(std::lround((scale.high - tick) / span * (height - 1)));
        canvas.rectangle(x + bar, row, 6, 1, ink);
        const double number = std::abs(tick) < 1e-9 * step ? 0.0 : tick;
        canvas.text(x + bar + 10, std::clamp(row - 7, y - 7, y + height - 9), size,
                    fmt::format("{:.6g}", number));
    }
    canvas.text(x, y - 24, unit.size() > 4 ? 1 : 2, unit);
}

/// Observer, band and instant.
std::array<std::string, 3> title_of(const Frame& frame, const Plane& plane) {
    std::string_view what = plane.name;
    for (const std::string_view quantity : {"apparent_temperature.", "radiance."}) {
        if (what.starts_with(quantity)) what.remove_prefix(quantity.size());
    }
    // Bands without a name are called by their ends in µm.
    const bool ends = !what.empty() && what.find_first_not_of("0123456789.-") == what.npos;
    return {frame.observer, fmt::format("{}{}", what, ends ? " µm" : ""),
            format_instant(frame.instant)};
}

/// The title in one line, large or small, or in a line for each part; what does not fit is
/// omitted, as it is in the file's name.
void draw_title(Canvas& canvas, int x, int room, const std::array<std::string, 3>& part) {
    const std::string line = fmt::format("{}", fmt::join(part, "  "));
    for (const int scale : {2, 1}) {
        if (width_of(line, scale) <= room) return canvas.text(x, scale == 2 ? 12 : 16, scale, line);
    }
    constexpr int line_height = 12;
    int y = 4;
    for (const std::string& one : part) {
        const std::string short_one = one == part.back() ? one.substr(one.find('T') + 1) : one;
        for (const std::string& text : {one, short_one}) {
            if (width_of(text, 1) > room) continue;
            canvas.text(x, y, 1, text);
            break;
        }
        y += line_height;
    }
}

std::uint8_t colour_of(double value, const ColourScale& scale) {
    if (!std::isfinite(value)) return no_data;
    const double t = (value - scale.low) / (scale.high - scale.low);
    return static_cast<std::uint8_t>(std::clamp(t, 0.0, 1.0 - 1e-9) * colours);
}

std::vector<std::byte> encode_png(const Canvas& canvas, bool temperature) {
    std::array<std::uint8_t, 3 * 256> map{};
    for (int i = 0; i < colours; ++i) {
        const double t = double(i) / (colours - 1);
        const Rgb c = temperature ? warm_colour(t) : grey_of_light(t);
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

std::string shown_plane(const Band& band) {
    const bool sunlight = 0.5 * (band.from_um() + band.to_um()) < 3.0;
    return (sunlight ? "radiance." : "apparent_temperature.") + band.name;
}

void write_quicklook(const std::filesystem::path& path, const Frame& frame,
                     const std::string& plane_name) {
    const Plane& plane = frame[plane_name];
    const ColourScale scale = colour_scale(frame, plane_name);

    constexpr int margin = 10, top = 42, scale_width = 110;
    const int picture_width = std::max(frame.width, 64);
    Canvas canvas(picture_width + scale_width + 2 * margin,
                  std::max(frame.height, 64) + top + margin);
    draw_title(canvas, margin, picture_width + margin, title_of(frame, plane));
    for (int y = 0; y < frame.height; ++y) {
        for (int x = 0; x < frame.width; ++x) {
            const std::size_t at = std::size_t(y) * std::size_t(frame.width) + std::size_t(x);
            canvas.set(margin + x, top + y,
                       colour_of(in_colour_unit(plane, plane.pixel[at]), scale));
        }
    }
    draw_scale(canvas, margin + picture_width + 14, top, std::max(frame.height, 64), scale,
               colour_unit(plane));
    write_whole_file(path, encode_png(canvas, is_temperature(plane)));
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
                    const float value =
                        plane.pixel[std::size_t(j) * std::size_t(frame.width) + std::size_t(i)];
                    if (!std::isfinite(value)) continue;
                    sum += in_colour_unit(plane, value);
                    ++count;
                }
            }
            canvas.set(x, y, colour_of(count > 0 ? sum / count : std::nan(""), scale));
        }
    }
    return encode_png(canvas, is_temperature(plane));
}

}  // namespace diurna
