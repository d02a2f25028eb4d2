#include "materials/base/files.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <sstream>

#include "materials/base/error.hpp"
#include "materials/base/files_read.hpp"

namespace diurna {

namespace fs = std::filesystem;

std::string read_text(const fs::path& path, std::size_t limit) {
    std::error_code code;
    const fs::file_status status = fs::status(path, code);
    if (!fs::exists(status)) throw InputError(path.string(), "no such file");
    if (!fs::is_regular_file(status)) throw InputError(path.string(), "not a regular file");
    const std::uintmax_t size = fs::file_size(path, code);
    if (code || size > limit) {
        throw InputError(path.string(), "file has " + std::to_string(size) +
                                            " bytes, expected at most " + std::to_string(limit));
    }
    note_file_read(path);
    std::ifstream file(path, std::ios::binary);
    std::ostringstream text;
    text << file.rdbuf();
    if (!file) throw InputError(path.string(), "cannot be read");
    return std::move(text).str();
}

void write_whole_file(const fs::path& path, std::span<const std::byte> bytes) {
    const fs::path temporary = path.string() + ".part";
    const auto fail = [&](const char* what) {
        const std::string reason = std::strerror(errno);
        ::unlink(temporary.c_str());
        throw std::runtime_error(path.string() + ": " + what + ": " + reason);
    };
    const int file = ::open(temporary.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644);
    if (file < 0) fail("cannot create");
    for (std::size_t done = 0; done < bytes.size();) {
        const ssize_t written = ::write(file, bytes.data() + done, bytes.size() - done);
        if (written < 0) {
            ::close(file);
            fail("cannot write");
        }
        done += static_cast<std::size_t>(written);
    }
    if (::fsync(file) != 0) {
        ::close(file);
        fail("cannot flush");
    }
    if (::close(file) != 0) fail("cannot close");
    if (::rename(temporary.c_str(), path.c_str()) != 0) fail("cannot rename into place");
}

void write_whole_file(const fs::path& path, std::string_view text) {
    write_whole_file(path, std::as_bytes(std::span(text.data(), text.size())));
}

bool is_temporary_name(const std::string& name) { return name.ends_with(".part"); }

fs::path data_folder() {
    const char* named = std::getenv("DIURNA_DATA");
    return named != nullptr ? fs::path(named) : fs::path(DIURNA_SOURCE_DIR) / "materials";
}

}  // namespace diurna
