#include "render/picture/colour_png.hpp"

#include <fmt/format.h>
#include <png.h>

#include <cassert>
#include <stdexcept>

namespace diurna {

std::vector<std::byte> encode_rgba_png(int width, int height,
                                       std::span<const std::uint8_t> pixels) {
    assert(pixels.size() == 4 * std::size_t(width) * std::size_t(height));
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = static_cast<png_uint_32>(width);
    image.height = static_cast<png_uint_32>(height);
    image.format = PNG_FORMAT_RGBA;
    std::vector<std::byte> bytes(PNG_IMAGE_PNG_SIZE_MAX(image));
    png_alloc_size_t size = bytes.size();
    if (!png_image_write_to_memory(&image, bytes.data(), &size, 0, pixels.data(), 0, nullptr)) {
        throw std::runtime_error(fmt::format("PNG cannot be encoded: {}", image.message));
    }
    bytes.resize(size);
    return bytes;
}

}  // namespace diurna
