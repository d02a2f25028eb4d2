#pragma once

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <set>
#include <string>

#include "materials/base/document.hpp"

/// Holds every document that a test of this program reads against scenes/KEYS.md: a key that a
/// reader asks for and the page does not have fails the test, unless the test has the tag
/// [own_keys]. To be included by whatever reads scenes, columns or materials.
class KeysOfPage : public Catch::TestEventListenerBase {
 public:
    explicit KeysOfPage(const Catch::ReporterConfig& config) : TestEventListenerBase(config) {
        read_page();
    }
    void testCaseStarting(const Catch::TestCaseInfo& test) override {
        TestEventListenerBase::testCaseStarting(test);
        if (std::count(test.tags.begin(), test.tags.end(), "own_keys") > 0) return;
        diurna::Document::watch([this](std::span<const diurna::Key> keys) {
            for (const diurna::Key& key : keys) {
                std::string path = key.path;
                for (auto at = path.find("[]"); at != path.npos; at = path.find("[]")) {
                    path.erase(at, 2);
                }
                if (known_.contains(path)) continue;
                INFO("a reader asks for "
                     << path
                     << ", which scenes/KEYS.md does not have; let a "
                        "specimen reach it (scenes/job/keys/specimens.cpp) and print "
                        "the page again: diurna keys > scenes/KEYS.md");
                CHECK(known_.contains(path));
            }
        });
    }
    void testCaseEnded(const Catch::TestCaseStats& stats) override {
        TestEventListenerBase::testCaseEnded(stats);
        diurna::Document::watch({});
    }

 private:
    void read_page() {
        std::ifstream page(DIURNA_SOURCE_DIR "/scenes/KEYS.md");
        std::string line, table;
        bool material = false;
        const auto add = [&](const std::string& path) {
            if (!material) {
                known_.insert(path);
                for (const std::string of_part_file :
                     {"part", "contact", "enclosure", "lump", "link", "stream", "jet"}) {
                    const std::string in_scene = "object." + of_part_file;
                    if (path == in_scene || path.starts_with(in_scene + ".")) {
                        known_.insert(path.substr(std::string("object.").size()));
                    }
                }
            } else {  // the same keys in scenes, columns and libraries
                for (const char* within : {"material.NAME.", "material.", "NAME."}) {
                    known_.insert(within + path);
                }
            }
        };
        while (std::getline(page, line)) {
            if (line.rfind("## ", 0) == 0) {
                material = line == "## Materials";
                table.clear();
            } else if (line.rfind("### `", 0) == 0) {
                const auto begin = line.find_first_not_of("[", 5);
                table = line.substr(begin, line.find(']') - begin);
                if (material) table = table.substr(std::string("NAME.").size());
                add(table);
            } else if (line.rfind("| `", 0) == 0) {
                const std::string key = line.substr(3, line.find('`', 3) - 3);
                add(table.empty() ? key : table + "." + key);
            }
        }
        known_.insert("NAME");  // a library's table
    }

    std::set<std::string> known_;
};

CATCH_REGISTER_LISTENER(KeysOfPage)
