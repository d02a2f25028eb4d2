#include "scenes/job/input/read_copies.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <string>
#include <utility>

#include "materials/base/csv.hpp"
#include "materials/base/error.hpp"

namespace diurna {

namespace {

constexpr std::size_t most_copies = 60000;  // objects have numbers of 16 bits

/// Where a copy stands and where that is said.
struct Stand {
    Eigen::Vector2d place;  // east, north [m]
    double heading_deg;
    std::string where;
};

void check_heading(const Stand& stand) {
    if (std::abs(stand.heading_deg) <= 360.0) return;
    throw InputError(stand.where, fmt::format("found heading_deg {:g}, expected -360 to 360",
                                              stand.heading_deg));
}

void check_columns(const CsvTable& table) {
    const std::vector<std::string> known{"east_m", "north_m", "latitude_deg", "longitude_deg",
                                         "heading_deg"};
    for (const std::string& name : table.header) {
        const bool twice = std::count(table.header.begin(), table.header.end(), name) > 1;
        if (twice) {
            throw InputError(table.path.string(), fmt::format("has column '{}' twice", name));
        }
        if (std::find(known.begin(), known.end(), name) != known.end()) continue;
        throw InputError(
            table.path.string(),
            fmt::format("unknown column '{}', expected {}", name, fmt::join(known, ", ")),
            did_you_mean(name, known));
    }
    if (table.has("latitude_deg") && (table.has("east_m") || table.has("north_m"))) {
        throw InputError(
            table.path.string(),
            "has columns 'latitude_deg' and 'east_m' or 'north_m', expected only one pair");
    }
}

/// No two in one place: the one would be inside the other.
void check_places(std::vector<Stand> stands) {
    const auto by_place = [](const Stand& a, const Stand& b) {
        return std::pair(a.place.x(), a.place.y()) < std::pair(b.place.x(), b.place.y());
    };
    std::stable_sort(stands.begin(), stands.end(), by_place);
    const auto twice =
        std::adjacent_find(stands.begin(), stands.end(),
                           [](const Stand& a, const Stand& b) { return a.place == b.place; });
    if (twice == stands.end()) return;
    throw InputError(std::next(twice)->where,
                     fmt::format("two copies have the place east {:g} m, north {:g} m",
                                 twice->place.x(), twice->place.y()));
}

/// Where a row's copy stands.
Eigen::Vector2d place_in(const CsvTable& table, std::size_t row, const Section& section,
                         const ScenePlaces& places) {
    if (!table.has("latitude_deg") && !table.has("longitude_deg")) {
        const std::size_t east = table.column("east_m"), north = table.column("north_m");
        return {table.number(row, east), table.number(row, north)};
    }
    const std::size_t north = table.column("latitude_deg"), east = table.column("longitude_deg");
    const Geodetic at{table.number(row, north), table.number(row, east), 0.0};
    if (!(std::abs(at.latitude_deg) <= 90.0 && std::abs(at.longitude_deg) <= 360.0)) {
        throw InputError(table.where(row, north),
                         fmt::format("latitude {:g}, longitude {:g} is not a place",
                                     at.latitude_deg, at.longitude_deg));
    }
    return places.at(section, "copies_file", at);
}

std::vector<Stand> stands_of_file(const std::filesystem::path& file, const Section& section,
                                  const ScenePlaces& places) {
    const CsvTable table = read_csv(file);
    check_columns(table);
    std::vector<Stand> stands;
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
        const Eigen::Vector2d place = place_in(table, row, section, places);
        const std::size_t heading = table.column("heading_deg");
        stands.push_back({place, table.number(row, heading), table.where(row, heading)});
        check_heading(stands.back());
    }
    if (stands.empty()) {
        throw InputError(file.string(), "has no rows, expected the place of a copy in each row");
    }
    return stands;
}

std::vector<Stand> read_stands(const Section& section, const ScenePlaces& places,
                               ObjectInput& object) {
    std::vector<Stand> stands;
    if (section.has("copies")) {
        for (const std::vector<double>& row :
             section.rows("copies",
                          "places of identical objects: [east, north, heading] of each (m, m, "
                          "degrees clockwise from north), instead of place_m and heading_deg; "
                          "their names are NAME_0001 and so on",
                          3)) {
            stands.push_back({{row[0], row[1]}, row[2], section.where("copies")});
        }
    }
    const std::string file =
        section.text_or("copies_file",
                        "CSV file of the places of copies, with columns east_m, north_m or "
                        "latitude_deg, longitude_deg, and heading_deg",
                        "");
    try {
        for (const Stand& stand : stands) check_heading(stand);
        if (section.has("copies_file")) {
            object.copies_file = section.file_named("copies_file", file);
            if (object.copies_file.empty()) return {};
            stands = stands_of_file(object.copies_file, section, places);
        }
        check_places(stands);
    } catch (const InputError& error) {
        const Mistake& first = error.mistakes().front();
        const bool filed = section.has("copies_file");
        section.mistake(filed ? "copies_file" : "copies",
                        filed ? first.where + ": " + first.problem : first.problem, first.hint);
        return {};
    }
    return stands;
}

/// What copies cannot have.
void check_keys(const Section& section, const ObjectInput& object, const char* key) {
    if (section.has("copies") && section.has("copies_file")) {
        section.mistake("copies", "cannot be combined with copies_file");
    }
    for (const char* other : {"place_m", "place", "heading_deg", "trajectory"}) {
        if (section.has(other)) {
            section.mistake(other,
                            fmt::format("cannot be combined with {}, which gives the places", key));
        }
    }
    if (section.has("texture"))
        section.mistake("texture", "not available for an object with copies");
    const bool on_ground =
        std::any_of(object.target.contact.begin(), object.target.contact.end(),
                    [](const ContactInput& contact) { return contact.on == ground_name; });
    if (on_ground) {
        section.mistake(key,
                        "not available for an object in contact with the ground, whose "
                        "temperatures differ below each copy");
    }
}

}  // namespace

std::vector<ObjectInput> with_copies(const Section& section, ObjectInput object, Reading& reading) {
    const bool listed = section.has("copies"), filed = section.has("copies_file");
    std::vector<Stand> stands = read_stands(section, reading.places, object);
    const double within =
        section.number_or("copies_alike_K",
                          "copies share the temperatures of one representative if their different "
                          "light, sky and wind change the mean surface temperature by no more than "
                          "this at the worst hour; 0: each copy has its own temperatures",
                          0.5, {0.0, 20.0});
    if (!listed && !filed) {
        if (section.has("copies_alike_K")) {
            section.mistake("copies_alike_K", "needs copies or copies_file");
        }
        std::vector<ObjectInput> one;
        one.push_back(std::move(object));
        return one;
    }
    const char* key = filed ? "copies_file" : "copies";
    check_keys(section, object, key);
    if (stands.size() > most_copies) {
        section.mistake(
            key, fmt::format("found {} places, expected at most {}", stands.size(), most_copies));
        stands.resize(1);
    }
    if (stands.empty()) stands.push_back({object.place, 0.0, section.where(key)});
    object.copy_of = object.name;
    object.alike_within = within;
    std::vector<ObjectInput> all;
    for (std::size_t i = 0; i < stands.size(); ++i) {
        ObjectInput& one = all.emplace_back(object);
        one.name = fmt::format("{}_{:04}", object.name, i + 1);
        one.place = stands[i].place;
        one.placing.heading_deg = stands[i].heading_deg;
        one.where = stands[i].where;
        if (i > 0) one.notes.clear();  // reported once
        if (!reading.object_names.insert(one.name).second) {
            section.mistake(
                key, fmt::format("a copy would have the name \"{}\" of another object", one.name));
        }
    }
    return all;
}

}  // namespace diurna
