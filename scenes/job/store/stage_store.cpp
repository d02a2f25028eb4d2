#include "scenes/job/store/stage_store.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <span>
#include <utility>

#include "materials/base/unfinished.hpp"
#include "scenes/job/store/digest.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

constexpr const char* extension = ".stage";

/// What stands before the content: whose it is, so that a file under another's name is none, and
/// its digest.
std::string header_of(std::string_view stage, const std::string& key,
                      std::span<const std::string_view> content) {
    return fmt::format("{}-{}\n{}\n", stage, key, sha256(content));
}

std::string text_of(const char* variable) {
    const char* value = std::getenv(variable);
    return value == nullptr ? "" : value;
}

}  // namespace

std::uintmax_t StageContent::size() const {
    std::uintmax_t sum = 0;
    for (const std::string_view of : piece) sum += of.size();
    return sum;
}

StageStore::StageStore(fs::path folder) : StageStore(std::move(folder), Limits{}) {}

StageStore::StageStore(fs::path folder, Limits limits)
    : folder_(std::move(folder)), limits_(limits) {}

std::shared_ptr<const StageStore> StageStore::in_memory() {
    return std::make_shared<const StageStore>(
        fs::path(), Limits{.least_seconds = 0.0, .most_bytes = 2'000'000'000});
}

std::shared_ptr<const StageStore> StageStore::of_user() {
    const std::string said = text_of("DIURNA_STAGES");
    if (said == "off") return nullptr;
    if (!said.empty()) return std::make_shared<const StageStore>(said);
    const fs::path cache = text_of("XDG_CACHE_HOME"), home = text_of("HOME");
    if (cache.is_absolute()) return std::make_shared<const StageStore>(cache / "diurna");
    if (!home.is_absolute()) return nullptr;
    return std::make_shared<const StageStore>(home / ".cache" / "diurna");
}

fs::path StageStore::file(std::string_view stage, const std::string& key) const {
    return folder_ / fmt::format("{}-{}{}", stage, key, extension);
}

std::optional<std::string> StageStore::find(std::string_view stage, const std::string& key) const {
    if (folder_.empty()) {
        const std::lock_guard lock(telling_);
        const auto held = held_.find(fmt::format("{}-{}", stage, key));
        return held == held_.end() ? std::nullopt : std::optional(held->second);
    }
    const fs::path path = file(stage, key);
    std::error_code ignored;
    if (!fs::is_regular_file(fs::symlink_status(path, ignored))) return std::nullopt;
    const std::uintmax_t size = fs::file_size(path, ignored);
    std::string header = header_of(stage, key, {});
    if (ignored || size < header.size() || size > limits_.most_bytes) return std::nullopt;
    std::string content(size - header.size(), '\0');
    std::ifstream stream(path, std::ios::binary);
    stream.read(header.data(), std::streamsize(header.size()));
    stream.read(content.data(), std::streamsize(content.size()));
    const std::string_view whole = content;
    if (!stream || header != header_of(stage, key, {&whole, 1})) return std::nullopt;
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);  // asked for now
    return content;
}

void StageStore::note_taken(std::string_view stage, const std::string& key) const {
    const std::lock_guard lock(telling_);
    if (std::find(own_.begin(), own_.end(), file(stage, key).string()) != own_.end()) return;
    if (std::find(taken_.begin(), taken_.end(), stage) == taken_.end()) taken_.emplace_back(stage);
}

void StageStore::keep(std::string_view stage, const std::string& key,
                      const StageContent& content) const {
    const std::uintmax_t size = content.size();
    if (size > limits_.most_bytes / 4) return;
    if (folder_.empty()) {
        const std::lock_guard lock(telling_);
        std::uintmax_t sum = size;
        for (const auto& [name, bytes] : held_) sum += bytes.size();
        if (sum > limits_.most_bytes) return;
        std::string whole;
        whole.reserve(size);
        for (const std::string_view piece : content.piece) whole += piece;
        held_.insert_or_assign(fmt::format("{}-{}", stage, key), std::move(whole));
        return;
    }
    try {
        if (fs::create_directories(folder_)) {
            fs::permissions(folder_, fs::perms::owner_all);
        }
        UnfinishedFile whole(file(stage, key));
        const std::string header = header_of(stage, key, content.piece);
        whole.write(std::as_bytes(std::span(header)));
        for (const std::string_view piece : content.piece) {
            whole.write(std::as_bytes(std::span(piece)));
        }
        whole.rename();
        {
            const std::lock_guard lock(telling_);
            own_.push_back(file(stage, key).string());
        }
        make_room();
    } catch (const std::exception&) {
        // A full disk, a folder of somebody else's: the run goes on without.
    }
}

void StageStore::make_room() const {
    struct File {
        fs::file_time_type asked;
        std::uintmax_t size;
        fs::path path;
    };
    std::vector<File> files;
    std::uintmax_t sum = 0;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(folder_, ignored)) {
        if (is_left_over(entry.path())) fs::remove(entry.path(), ignored);
        if (entry.path().extension() != extension) continue;
        files.push_back({entry.last_write_time(ignored), entry.file_size(ignored), entry.path()});
        sum += files.back().size;
    }
    std::sort(files.begin(), files.end(),
              [](const File& a, const File& b) { return a.asked < b.asked; });
    for (const File& file : files) {
        if (sum <= limits_.most_bytes) return;
        fs::remove(file.path, ignored);
        sum -= file.size;
    }
}

std::vector<std::string> StageStore::taken() const {
    const std::lock_guard lock(telling_);
    return taken_;
}

std::string taken_reported(const StageStore* store) {
    const std::vector<std::string> taken =
        store == nullptr ? std::vector<std::string>{} : store->taken();
    if (taken.empty()) return "";
    return fmt::format("from cache ({}): {}; --fresh recomputes everything",
                       store->folder().string(), fmt::join(taken, ", "));
}

}  // namespace diurna
