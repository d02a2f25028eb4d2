#include "render/picture/grey_png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace diurna {

namespace {

/// Rows as PNG has them: counts of 16 bits with the high byte first.
std::vector<png_byte> bytes_of(const GreyPicture& picture) {
    std::vector<png_byte> bytes;
    bytes.reserve(picture.count.size() * std::size_t(picture.bits) / 8);
    for (const unsigned count : picture.count) {
        if (picture.bits == 16) bytes.push_back(static_cast<png_byte>(count >> 8));
        bytes.push_back(static_cast<png_byte>(count & 255u));
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

}  // namespace

std::vector<std::byte> grey_png(const GreyPicture& picture) {
    Writer writer;
    std::vector<png_byte> rows = bytes_of(picture);
    std::vector<std::byte> bytes;
    png_set_write_fn(writer.png(), &bytes, append, nullptr);
    png_set_IHDR(writer.png(), writer.info(), png_uint_32(picture.width),
                 png_uint_32(picture.height), picture.bits, PNG_COLOR_TYPE_GRAY, PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    // Differences to the left, packed lightly: counts of noise pack no better for more time.
    png_set_filter(writer.png(), 0, PNG_FILTER_SUB);
    png_set_compression_level(writer.png(), 1);
    std::string key = "Scale", says = picture.scale;
    png_text text{};
    text.compression = PNG_TEXT_COMPRESSION_NONE;
    text.key = key.data();
    text.text = says.data();
    text.text_length = says.size();
    png_set_text(writer.png(), writer.info(), &text, 1);
    png_write_info(writer.png(), writer.info());
    const std::size_t stride = std::size_t(picture.width) * std::size_t(picture.bits) / 8;
    for (int row = 0; row < picture.height; ++row) {
        png_write_row(writer.png(), rows.data() + std::size_t(row) * stride);
    }
    png_write_end(writer.png(), nullptr);
    return bytes;
}

}  // namespace diurna
