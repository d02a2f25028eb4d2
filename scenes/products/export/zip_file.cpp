#include "scenes/products/export/zip_file.hpp"

#include <boost/crc.hpp>
#include <cstdint>
#include <stdexcept>

namespace diurna {

namespace {

void put(std::string& out, std::uint32_t value, int bytes) {
    for (int k = 0; k < bytes; ++k) out += static_cast<char>(value >> (8 * k) & 0xFFu);
}

/// What the header of a file and its line in the directory have in common.
void put_facts(std::string& out, const ZipEntry& entry, std::uint32_t crc) {
    constexpr std::uint32_t version = 10, utf8_names = 1u << 11, stored = 0;
    constexpr std::uint32_t midnight = 0, first_of_1980 = 1u << 5 | 1u;
    for (const std::uint32_t value : {version, utf8_names, stored, midnight, first_of_1980}) {
        put(out, value, 2);
    }
    put(out, crc, 4);
    const auto size = static_cast<std::uint32_t>(entry.content.size());
    put(out, size, 4);
    put(out, size, 4);
    put(out, static_cast<std::uint32_t>(entry.name.size()), 2);
    put(out, 0, 2);  // no further fields
}

}  // namespace

std::string zip_archive(const std::vector<ZipEntry>& entries) {
    std::size_t whole = 22;
    for (const ZipEntry& entry : entries)
        whole += entry.content.size() + 2 * entry.name.size() + 76;
    if (whole > 0xFFFFFFFFu || entries.size() > 0xFFFFu) {
        throw std::runtime_error(
            "a ZIP archive over 4 GB or with more than 65535 files is not supported");
    }
    std::string out, directory;
    for (const ZipEntry& entry : entries) {
        boost::crc_32_type crc;
        crc.process_bytes(entry.content.data(), entry.content.size());
        const auto begin = static_cast<std::uint32_t>(out.size());
        put(out, 0x04034b50, 4);
        put_facts(out, entry, crc.checksum());
        out += entry.name;
        out += entry.content;
        put(directory, 0x02014b50, 4);
        put(directory, 10, 2);  // made by
        put_facts(directory, entry, crc.checksum());
        put(directory, 0, 2);  // no comment
        put(directory, 0, 2);  // the first disk
        put(directory, 0, 2);  // no text
        put(directory, 0, 4);  // no attributes
        put(directory, begin, 4);
        directory += entry.name;
    }
    const auto begin = static_cast<std::uint32_t>(out.size());
    const auto count = static_cast<std::uint32_t>(entries.size());
    out += directory;
    put(out, 0x06054b50, 4);
    put(out, 0, 2);
    put(out, 0, 2);
    put(out, count, 2);
    put(out, count, 2);
    put(out, static_cast<std::uint32_t>(directory.size()), 4);
    put(out, begin, 4);
    put(out, 0, 2);
    return out;
}

}  // namespace diurna
