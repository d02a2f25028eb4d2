#include "render/picture/grey_tiff.hpp"

#include <fmt/format.h>
#include <tiffio.h>

#include <algorithm>
#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <memory>
#include <stdexcept>

namespace diurna {

namespace {

/// A file in memory, as libtiff reads back and forth in it.
struct Memory {
    std::vector<std::byte> bytes;
    std::size_t at = 0;
};

Memory& of(thandle_t handle) { return *static_cast<Memory*>(handle); }

tmsize_t read(thandle_t handle, void* to, tmsize_t size) {
    Memory& file = of(handle);
    const std::size_t left = file.bytes.size() - std::min(file.at, file.bytes.size());
    const std::size_t taken = std::min(left, static_cast<std::size_t>(size));
    std::memcpy(to, file.bytes.data() + file.at, taken);
    file.at += taken;
    return static_cast<tmsize_t>(taken);
}

tmsize_t write(thandle_t handle, void* from, tmsize_t size) {
    Memory& file = of(handle);
    const auto count = static_cast<std::size_t>(size);
    file.bytes.resize(std::max(file.bytes.size(), file.at + count));
    std::memcpy(file.bytes.data() + file.at, from, count);
    file.at += count;
    return size;
}

toff_t seek(thandle_t handle, toff_t to, int from) {
    Memory& file = of(handle);
    const std::size_t base = from == SEEK_SET ? 0 : from == SEEK_CUR ? file.at : file.bytes.size();
    file.at = base + to;
    return file.at;
}

toff_t size(thandle_t handle) { return of(handle).bytes.size(); }
int close(thandle_t) { return 0; }

[[noreturn]] void fail() { throw std::runtime_error("TIFF cannot be encoded"); }

}  // namespace

std::vector<std::byte> grey_tiff(const GreyPicture& picture) {
    Memory file;
    {
        const std::unique_ptr<TIFF, decltype(&TIFFClose)> tiff(
            TIFFClientOpen("memory", "wl", &file, read, write, seek, close, size, nullptr, nullptr),
            &TIFFClose);
        if (!tiff) fail();
        TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, std::uint32_t(picture.width));
        TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, std::uint32_t(picture.height));
        TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, picture.bits);
        TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
        TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        TIFFSetField(tiff.get(), TIFFTAG_ORIENTATION, ORIENTATION_TOPLEFT);
        TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
        TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
        TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, TIFFDefaultStripSize(tiff.get(), 0));
        TIFFSetField(tiff.get(), TIFFTAG_IMAGEDESCRIPTION, picture.scale.c_str());
        const auto width = static_cast<std::size_t>(picture.width);
        std::vector<std::uint8_t> narrow(picture.bits == 8 ? width : 0);
        std::vector<std::uint16_t> line(width);  // the predictor works in place
        for (int row = 0; row < picture.height; ++row) {
            const auto from = picture.count.begin() + static_cast<std::ptrdiff_t>(width) * row;
            std::copy_n(from, width, line.begin());
            void* pixels = line.data();
            if (picture.bits == 8) {
                std::transform(line.begin(), line.end(), narrow.begin(),
                               [](std::uint16_t count) { return std::uint8_t(count); });
                pixels = narrow.data();
            }
            if (TIFFWriteScanline(tiff.get(), pixels, std::uint32_t(row)) != 1) fail();
        }
        if (TIFFFlush(tiff.get()) != 1) fail();
    }
    return std::move(file.bytes);
}

}  // namespace diurna
