#include "render/picture/exr.hpp"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfIO.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfPartType.h>
#include <ImfStandardAttributes.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <memory>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "materials/base/error.hpp"
#include "materials/base/files.hpp"
#include "materials/base/made_by.hpp"

namespace diurna {

namespace {

/// OpenEXR does not report every failure to write the last bytes of a file; memory does not fail.
class MemoryOut : public OPENEXR_IMF_NAMESPACE::OStream {
 public:
    /// - expected: bytes, about
    explicit MemoryOut(std::size_t expected) : OStream("memory") { grow(expected); }
    void write(const char from[], int n) override {
        const std::size_t end = place_ + static_cast<std::size_t>(n);
        if (end > room_) grow(std::max(end, 2 * room_));
        std::memcpy(bytes_.get() + place_, from, static_cast<std::size_t>(n));
        place_ = end;
        size_ = std::max(size_, end);
    }
    std::uint64_t tellp() override { return place_; }
    void seekp(std::uint64_t place) override { place_ = place; }
    std::span<const std::byte> bytes() const { return {bytes_.get(), size_}; }

 private:
    void grow(std::size_t room) {
        auto more = std::make_unique_for_overwrite<std::byte[]>(room);
        if (size_ > 0) std::memcpy(more.get(), bytes_.get(), size_);
        bytes_ = std::move(more);
        room_ = room;
    }
    std::unique_ptr<std::byte[]> bytes_{};
    std::size_t room_ = 0, size_ = 0, place_ = 0;
};

/// A file that is larger than what is wanted of it.
class FileIn : public OPENEXR_IMF_NAMESPACE::IStream {
 public:
    explicit FileIn(std::ifstream file) : IStream("picture"), file_(std::move(file)) {}
    bool read(char to[], int n) override {
        if (n < 0 || !file_.read(to, n)) throw std::runtime_error("is truncated");
        return file_.peek() != std::ifstream::traits_type::eof();
    }
    std::uint64_t tellg() override { return static_cast<std::uint64_t>(file_.tellg()); }
    void seekg(std::uint64_t place) override {
        file_.clear();
        file_.seekg(static_cast<std::streamoff>(place));
    }
    void clear() override { file_.clear(); }

 private:
    std::ifstream file_;
};

Imf::Compression openexr(ExrCompression compression) {
    switch (compression) {
        case ExrCompression::none:
            return Imf::NO_COMPRESSION;
        case ExrCompression::zips:
            return Imf::ZIPS_COMPRESSION;
        case ExrCompression::zip:
            return Imf::ZIP_COMPRESSION;
        case ExrCompression::piz:
            return Imf::PIZ_COMPRESSION;
    }
    return Imf::NO_COMPRESSION;
}

/// OpenEXR's matrices are for rows, p' = p M.
Imath::M44f for_rows(const Eigen::Matrix4d& m) {
    Imath::M44f rows;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) rows[i][j] = static_cast<float>(m(j, i));
    }
    return rows;
}

Eigen::Matrix4d of_rows(const Imath::M44f& rows) {
    Eigen::Matrix4d m;
    for (int i = 0; i < 4; ++i) {
        for (int j = 0; j < 4; ++j) m(j, i) = double{rows[i][j]};
    }
    return m;
}

void add_tags(Imf::Header& header, const CameraTags& camera) {
    Imf::addWorldToCamera(header, for_rows(camera.world_to_camera));
    if (camera.world_to_ndc) Imf::addWorldToNDC(header, for_rows(*camera.world_to_ndc));
    Imf::addCapDate(header, camera.cap_date);
    Imf::addUtcOffset(header, static_cast<float>(camera.utc_offset));
    Imf::addLongitude(header, static_cast<float>(camera.longitude));
    Imf::addLatitude(header, static_cast<float>(camera.latitude));
    Imf::addAltitude(header, static_cast<float>(camera.altitude));
    Imf::addFocus(header, static_cast<float>(camera.focus));
    if (camera.exposure > 0.0) Imf::addExpTime(header, static_cast<float>(camera.exposure));
    if (camera.window_width > 0.0) {
        header.screenWindowWidth() = static_cast<float>(camera.window_width);
    }
}

/// A slice over a plane's pixels; OpenEXR asks for mutable bytes even where it only reads them.
Imf::Slice slice(const float* pixel, int width) {
    return Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(const_cast<float*>(pixel)), sizeof(float),
                      sizeof(float) * static_cast<std::size_t>(width));
}

constexpr std::uintmax_t most_exr_bytes = std::uintmax_t{1} << 36;

constexpr std::string_view instant_key = "diurna.instant", observer_key = "diurna.observer",
                           software_key = "software", libraries_key = "diurna.libraries",
                           unit_prefix = "unit.", note_prefix = "note.";

std::size_t pixels_of(const Imf::Header& header, int& width, int& height) {
    const auto& window = header.dataWindow();
    const auto w = std::int64_t{window.max.x} - window.min.x + 1;
    const auto h = std::int64_t{window.max.y} - window.min.y + 1;
    if (w < 1 || h < 1 || w > 65536 || h > 65536) throw std::runtime_error("has no valid size");
    width = static_cast<int>(w);
    height = static_cast<int>(h);
    return static_cast<std::size_t>(w * h);
}

/// Whether a line is stored as its planes' values, one after the other in the order of their names.
bool is_plain(const Imf::Header& header) {
    bool plain = header.compression() == Imf::NO_COMPRESSION &&
                 (!header.hasType() || header.type() == Imf::SCANLINEIMAGE);
    plain = plain && !header.hasTileDescription();
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        const Imf::Channel& channel = c.channel();
        plain =
            plain && channel.type == Imf::FLOAT && channel.xSampling == 1 && channel.ySampling == 1;
    }
    return plain && std::endian::native == std::endian::little;
}

/// Copies the planes of a frame from the lines of such a file: OpenEXR takes them value by value.
void read_plain(Imf::InputFile& file, Frame& frame) {
    const auto& window = file.header().dataWindow();
    const std::size_t line = sizeof(float) * static_cast<std::size_t>(frame.width);
    std::vector<std::pair<std::size_t, float*>> parts;  // of a line: where it begins, and its plane
    std::size_t start = 0;
    for (auto c = file.header().channels().begin(); c != file.header().channels().end(); ++c) {
        const auto plane = std::find_if(frame.planes.begin(), frame.planes.end(),
                                        [&](const Plane& p) { return p.name == c.name(); });
        if (plane != frame.planes.end()) parts.emplace_back(start, plane->pixel.data());
        start += line;
    }
    for (int y = window.min.y; y <= window.max.y; ++y) {
        const char* bytes = nullptr;
        int size = 0;
        file.rawPixelData(y, bytes, size);
        if (size < 0 || static_cast<std::size_t>(size) != start) {
            throw std::runtime_error("has lines of another length");
        }
        const auto row = static_cast<std::size_t>(y - window.min.y) * std::size_t(frame.width);
        for (const auto& [from, plane] : parts) std::memcpy(plane + row, bytes + from, line);
    }
}

/// - wanted: null: every plane
Frame read_planes(const std::filesystem::path& path, const std::span<const std::string>* wanted);

}  // namespace

void write_exr(const std::filesystem::path& path, const Frame& frame, ExrCompression compression,
               const CameraTags* camera) {
    constexpr std::size_t header_bytes = 1 << 16;
    MemoryOut memory(header_bytes + frame.planes.size() * frame.pixels() * sizeof(float));
    try {
        Imf::Header header(frame.width, frame.height);
        header.compression() = openexr(compression);
        // Level 1 packs floats as well as level 9 to a few per cent, in a third of the time.
        header.zipCompressionLevel() = 1;
        header.insert(std::string(software_key), Imf::StringAttribute(made_by()));
        header.insert(std::string(libraries_key), Imf::StringAttribute(made_with()));
        header.insert(std::string(instant_key),
                      Imf::StringAttribute(format_instant(frame.instant)));
        header.insert(std::string(observer_key), Imf::StringAttribute(frame.observer));
        for (const auto& [name, text] : frame.notes) {
            header.insert(std::string(note_prefix) + name, Imf::StringAttribute(text));
        }
        for (const auto& [name, text] : frame.attributes) {
            header.insert(name, Imf::StringAttribute(text));
        }
        if (camera != nullptr) add_tags(header, *camera);
        Imf::FrameBuffer buffer;
        for (const Plane& plane : frame.planes) {
            if (plane.pixel.size() != frame.pixels()) {
                throw std::runtime_error("plane " + plane.name + " has another size");
            }
            header.channels().insert(plane.name, Imf::Channel(Imf::FLOAT));
            header.insert(std::string(unit_prefix) + plane.name, Imf::StringAttribute(plane.unit));
            buffer.insert(plane.name, slice(plane.pixel.data(), frame.width));
        }
        // No threads of its own: frames are written side by side.
        Imf::OutputFile file(memory, header, 0);
        file.setFrameBuffer(buffer);
        file.writePixels(frame.height);
    } catch (const std::exception& problem) {
        throw std::runtime_error(fmt::format("{}: {}", path.string(), problem.what()));
    }
    write_whole_file(path, memory.bytes());
}

Frame read_exr(const std::filesystem::path& path) { return read_planes(path, nullptr); }

Frame read_exr(const std::filesystem::path& path, std::span<const std::string> wanted) {
    return read_planes(path, &wanted);
}

namespace {

Frame read_planes(const std::filesystem::path& path, const std::span<const std::string>* wanted) {
    try {
        FileIn opened(open_file(path, most_exr_bytes));
        Imf::InputFile file(opened, 0);
        const Imf::Header& header = file.header();
        Frame frame;
        const std::size_t pixels = pixels_of(header, frame.width, frame.height);
        if (!file.isComplete()) throw std::runtime_error("is incomplete");
        for (auto it = header.begin(); it != header.end(); ++it) {
            const auto* text = dynamic_cast<const Imf::StringAttribute*>(&it.attribute());
            const std::string_view name = it.name();
            if (!text) continue;
            if (name == instant_key) frame.instant = parse_instant(text->value(), path.string());
            if (name == observer_key) frame.observer = text->value();
            if (name.starts_with(note_prefix)) {
                frame.notes.emplace(name.substr(note_prefix.size()), text->value());
            } else if (name != instant_key && name != observer_key && name != software_key &&
                       name != libraries_key && name != "capDate" &&
                       !name.starts_with(unit_prefix)) {
                frame.attributes.emplace(name, text->value());
            }
        }
        Imf::FrameBuffer buffer;
        std::size_t left = most_exr_values / pixels;  // planes
        for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
            if (wanted && std::find(wanted->begin(), wanted->end(), c.name()) == wanted->end()) {
                continue;
            }
            if (left-- == 0) throw std::runtime_error("is larger than 2^28 values");
            const auto* unit = header.findTypedAttribute<Imf::StringAttribute>(
                std::string(unit_prefix) + c.name());
            frame.planes.push_back({.name = c.name(),
                                    .unit = unit ? unit->value() : "",
                                    .pixel = std::vector<float>(frame.pixels())});
        }
        if (frame.planes.empty()) return frame;  // none of those wanted: OpenEXR refuses to read
        if (is_plain(header)) {
            read_plain(file, frame);
            return frame;
        }
        const auto corner = header.dataWindow().min;
        for (const Plane& plane : frame.planes) {
            const std::ptrdiff_t offset =
                std::ptrdiff_t{corner.x} + std::ptrdiff_t{corner.y} * frame.width;
            buffer.insert(plane.name, slice(plane.pixel.data() - offset, frame.width));
        }
        file.setFrameBuffer(buffer);
        file.readPixels(header.dataWindow().min.y, header.dataWindow().max.y);
        return frame;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& problem) {
        throw InputError(path.string(),
                         fmt::format("is not a readable OpenEXR picture: {}", problem.what()));
    }
}

}  // namespace

std::optional<CameraTags> read_camera_tags(const std::filesystem::path& path) {
    try {
        FileIn opened(open_file(path, most_exr_bytes));
        const Imf::InputFile file(opened, 0);
        const Imf::Header& header = file.header();
        if (!Imf::hasWorldToCamera(header) || !Imf::hasCapDate(header)) return std::nullopt;
        CameraTags camera{.world_to_camera = of_rows(Imf::worldToCamera(header)),
                          .cap_date = Imf::capDate(header),
                          .window_width = double{header.screenWindowWidth()}};
        if (Imf::hasWorldToNDC(header)) camera.world_to_ndc = of_rows(Imf::worldToNDC(header));
        if (Imf::hasUtcOffset(header)) camera.utc_offset = double{Imf::utcOffset(header)};
        if (Imf::hasLongitude(header)) camera.longitude = double{Imf::longitude(header)};
        if (Imf::hasLatitude(header)) camera.latitude = double{Imf::latitude(header)};
        if (Imf::hasAltitude(header)) camera.altitude = double{Imf::altitude(header)};
        if (Imf::hasFocus(header)) camera.focus = double{Imf::focus(header)};
        if (Imf::hasExpTime(header)) camera.exposure = double{Imf::expTime(header)};
        return camera;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& problem) {
        throw InputError(path.string(), problem.what());
    }
}

}  // namespace diurna
