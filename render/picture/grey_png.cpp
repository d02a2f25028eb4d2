#include "render/picture/grey_png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "materials/base/units.hpp"
#include "render/picture/colour_scale.hpp"

namespace diurna {

namespace {

/// A full scale holds at least this [W m-2 sr-1], about what starlit ground sends back: darker
/// nights are black.
constexpr double least_light = 1e-6;

/// The finest of 1, 2, 5 times a power of ten that is at least `step`.
double even_step(double step) {
    const double decade = std::pow(10.0, std::floor(std::log10(step)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * decade >= step) return factor * decade;
    }
    return 10.0 * decade;
}

/// Counts row by row, those of 16 bits with the high byte first, as PNG has them.
std::vector<png_byte> counts_of(const Plane& plane, const GreyScale& scale, int bits) {
    const double most = bits == 16 ? 65535.0 : 255.0;
    std::vector<png_byte> bytes;
    bytes.reserve(plane.pixel.size() * std::size_t(bits) / 8);
    for (const float value : plane.pixel) {
        const double count = std::round((double{value} - scale.zero) / scale.step);
        const auto whole =
            static_cast<unsigned>(std::isfinite(count) ? std::clamp(count, 0.0, most) : 0.0);
        if (bits == 16) bytes.push_back(static_cast<png_byte>(whole >> 8));
        bytes.push_back(static_cast<png_byte>(whole & 255u));
    }
    return bytes;
}

void append(png_structp png, png_bytep data, png_size_t size) {
    auto* to = static_cast<std::vector<std::byte>*>(png_get_io_ptr(png));
    const auto bytes = std::as_bytes(std::span(data, size));
    to->insert(to->end(), bytes.begin(), bytes.end());
}

[[noreturn]] void refuse(png_structp, png_const_charp message) {
    throw std::runtime_error(fmt::format("PNG cannot be encoded: {}", message));
}

/// libpng's memory of a picture that is being written.
class Writer {
 public:
    Writer() : png_(png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, refuse, nullptr)) {
        if (png_ != nullptr) info_ = png_create_info_struct(png_);
        if (info_ == nullptr) throw std::runtime_error("PNG cannot be encoded");
    }
    Writer(const Writer&) = delete;
    Writer& operator=(const Writer&) = delete;
    ~Writer() { png_destroy_write_struct(&png_, &info_); }
    png_structp png() const { return png_; }
    png_infop info() const { return info_; }

 private:
    png_structp png_;
    png_infop info_ = nullptr;
};

std::vector<std::byte> encoded(const Frame& frame, std::vector<png_byte>& counts, int bits,
                               std::string says) {
    Writer writer;
    std::vector<std::byte> bytes;
    png_set_write_fn(writer.png(), &bytes, append, nullptr);
    png_set_IHDR(writer.png(), writer.info(), png_uint_32(frame.width), png_uint_32(frame.height),
                 bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    // Differences to the left, packed lightly: counts of noise pack no better for more time.
    png_set_filter(writer.png(), 0, PNG_FILTER_SUB);
    png_set_compression_level(writer.png(), 1);
    std::string key = "Scale";
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key.data();
    text.text = says.data();
    text.text_length = says.size();
    png_set_text(writer.png(), writer.info(), &text, 1);
    png_write_info(writer.png(), writer.info());
    const std::size_t stride = std::size_t(frame.width) * std::size_t(bits) / 8;
    for (int row = 0; row < frame.height; ++row) {
        png_write_row(writer.png(), counts.data() + std::size_t(row) * stride);
    }
    png_write_end(writer.png(), nullptr);
    return bytes;
}

}  // namespace

GreyScale grey_scale(const Frame& frame, const std::string& name, int bits) {
    const Plane& plane = frame[name];
    if (bits == 8) {
        const ColourScale ends = colour_scale(frame, name);
        const double zero = is_temperature(plane) ? kelvin(ends.low) : ends.low;
        return {zero, (ends.high - ends.low) / 255.0};
    }
    if (is_temperature(plane)) return {0.0, 0.01};
    double greatest = least_light;
    for (const float value : plane.pixel) {
        if (std::isfinite(value)) greatest = std::max(greatest, double{value});
    }
    return {0.0, even_step(greatest / 65535.0)};
}

GreyScale write_grey_png(const std::filesystem::path& path, const Frame& frame,
                         const std::string& name, int bits) {
    const Plane& plane = frame[name];
    const GreyScale scale = grey_scale(frame, name, bits);
    std::vector<png_byte> counts = counts_of(plane, scale, bits);
    std::string says = fmt::format("{} = {:g} + {:g} count", plane.unit, scale.zero, scale.step);
    write_whole_file(path, encoded(frame, counts, bits, std::move(says)));
    return scale;
}

}  // namespace diurna
