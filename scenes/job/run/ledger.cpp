#include "scenes/job/run/ledger.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "materials/base/files.hpp"
#include "scenes/job/store/digest.hpp"

namespace diurna {

namespace fs = std::filesystem;

namespace {

using OrderedJson = nlohmann::ordered_json;

/// The lines that are whole: the last of a run that was killed may not be.
std::vector<OrderedJson> read_lines(const fs::path& folder) {
    std::vector<OrderedJson> lines;
    std::ifstream file(folder / ledger_file);
    for (std::string line; std::getline(file, line);) {
        OrderedJson json = OrderedJson::parse(line, nullptr, false);
        if (json.is_object()) lines.push_back(std::move(json));
    }
    return lines;
}

std::map<std::string, std::string> texts_of(const OrderedJson& json, const char* key) {
    std::map<std::string, std::string> texts;
    if (!json.contains(key) || !json[key].is_object()) return texts;
    for (const auto& [name, text] : json[key].items()) {
        if (text.is_string()) texts[name] = text.get<std::string>();
    }
    return texts;
}

Messages messages_of(const OrderedJson& json) {
    Messages reported;
    if (!json.contains("told") || !json["told"].is_array()) return reported;
    for (const OrderedJson& pair : json["told"]) {
        if (pair.is_array() && pair.size() == 2 && pair[0].is_string() && pair[1].is_string()) {
            reported.emplace_back(pair[0].get<std::string>(), pair[1].get<std::string>());
        }
    }
    return reported;
}

/// A regular file of that content, not a link to one.
bool is_whole(const fs::path& file, const std::string& digest) {
    std::error_code ignored;
    return fs::is_regular_file(fs::symlink_status(file, ignored)) && sha256_of_file(file) == digest;
}

void append(const fs::path& path, const std::string& text) {
    const int file = ::open(path.c_str(), O_WRONLY | O_APPEND | O_NOFOLLOW | O_CLOEXEC);
    const bool written =
        file >= 0 && ::write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
    const std::string reason = std::strerror(errno);
    if (file >= 0) ::close(file);
    if (!written) throw std::runtime_error(path.string() + ": cannot be written: " + reason);
}

}  // namespace

Ledger::Ledger(fs::path folder, const std::string& key, bool keep)
    : folder_(std::move(folder)), key_(key) {
    const std::vector<OrderedJson> lines = read_lines(folder_);
    const bool same =
        keep && !lines.empty() && lines.front().value("key", OrderedJson()) == OrderedJson(key);
    for (std::size_t i = 1; same && i < lines.size(); ++i) {
        Entry entry{texts_of(lines[i], "files"), messages_of(lines[i])};
        bool whole = !entry.digest.empty();
        for (const auto& [name, digest] : entry.digest) {
            if (is_whole(folder_ / name, digest)) continue;
            whole = false;
            changed_.push_back(name);
        }
        if (!whole) continue;
        const std::string first = entry.digest.begin()->first;
        for (const auto& [name, digest] : entry.digest) entry_of_[name] = first;
        entry_[first] = std::move(entry);
    }
}

bool Ledger::has(const std::vector<std::string>& files) const {
    const std::lock_guard lock(adding_);
    for (const std::string& file : files) {
        if (!entry_of_.contains(file)) return false;
    }
    return true;
}

void Ledger::add(const std::vector<std::string>& files, Messages reported) {
    Entry entry{{}, std::move(reported)};
    for (const std::string& file : files) entry.digest[file] = sha256_of_file(folder_ / file);
    const std::lock_guard lock(adding_);
    if (files.empty()) return;
    append(folder_ / ledger_file, line(entry));
    const std::string first = entry.digest.begin()->first;
    for (const std::string& file : files) entry_of_[file] = first;
    entry_[first] = std::move(entry);
}

void Ledger::take(const Ledger& other) {
    const std::scoped_lock lock(adding_, other.adding_);
    for (const auto& [first, entry] : other.entry_) {
        Messages& reported =
            entry_.try_emplace(first, Entry{entry.digest, {}}).first->second.reported;
        for (const auto& one : entry.reported) {
            if (std::find(reported.begin(), reported.end(), one) == reported.end())
                reported.push_back(one);
        }
        for (const auto& [name, digest] : entry.digest) entry_of_[name] = first;
    }
}

Messages Ledger::reported(const std::string& file) const {
    const std::lock_guard lock(adding_);
    const auto found = entry_of_.find(file);
    return found == entry_of_.end() ? Messages{} : entry_.at(found->second).reported;
}

std::map<std::string, std::string> Ledger::digests() const {
    const std::lock_guard lock(adding_);
    std::map<std::string, std::string> digests;
    for (const auto& [first, entry] : entry_) {
        digests.insert(entry.digest.begin(), entry.digest.end());
    }
    return digests;
}

void Ledger::write(const std::vector<std::string>& expected) const {
    const std::lock_guard lock(adding_);
    OrderedJson first{{"program", "diurna " DIURNA_VERSION}, {"key", key_}};
    if (!expected.empty()) first["expected"] = expected;
    std::string text = first.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
    for (const auto& [name, entry] : entry_) text += line(entry);
    write_whole_file(folder_ / ledger_file, text);
}

std::string Ledger::line(const Entry& entry) const {
    OrderedJson json{{"files", entry.digest}};
    for (const auto& [name, text] : entry.reported) json["told"].push_back({name, text});
    return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
}

std::vector<std::string> ledger_names(const fs::path& folder) {
    std::vector<std::string> names;
    for (const OrderedJson& line : read_lines(folder)) {
        for (const auto& [name, digest] : texts_of(line, "files")) names.push_back(name);
        for (const OrderedJson& name : line.value("expected", OrderedJson::array())) {
            if (name.is_string()) names.push_back(name.get<std::string>());
        }
    }
    return names;
}

std::string ledger_key(const fs::path& folder) {
    const std::vector<OrderedJson> lines = read_lines(folder);
    if (lines.empty() || !lines.front().contains("key") || !lines.front()["key"].is_string())
        return "";
    return lines.front()["key"].get<std::string>();
}

std::map<std::string, std::string> ledger_digests(const fs::path& folder) {
    std::map<std::string, std::string> digests;
    for (const OrderedJson& line : read_lines(folder)) digests.merge(texts_of(line, "files"));
    return digests;
}

}  // namespace diurna
