#include "materials/matter/everyday_words.hpp"

namespace diurna {

const std::map<std::string, std::string>& everyday_words() {
    static const std::map<std::string, std::string> words{
        {"tarmac", "asphalt"},     {"blacktop", "asphalt"},    {"bitumen", "asphalt"},
        {"road", "asphalt"},       {"runway", "asphalt"},      {"cement", "concrete"},
        {"pavement", "concrete"},  {"apron", "concrete"},      {"lawn", "grass"},
        {"meadow", "grass"},       {"turf", "grass"},          {"vegetation", "grass"},
        {"hay", "dry_grass"},      {"earth", "bare_soil"},     {"dirt", "bare_soil"},
        {"soil", "bare_soil"},     {"mud", "wet_soil"},        {"desert", "semi_desert"},
        {"trees", "forest"},       {"woods", "forest"},        {"woodland", "forest"},
        {"stone", "rock"},         {"steel", "painted_sheet"}, {"metal", "painted_sheet"},
        {"iron", "steel_plate"},   {"armor", "steel_plate"},   {"armour", "steel_plate"},
        {"aluminum", "aluminium"}, {"tyre", "rubber"},         {"tire", "rubber"},
        {"timber", "wood"},        {"plywood", "wood"},        {"lake", "lake_water"},
        {"pond", "lake_water"},    {"sea", "sea_water"},       {"ocean", "sea_water"},
        {"window", "glass"},       {"tarpaulin", "canvas"},    {"cloth", "canvas"},
        {"net", "camouflage_net"}, {"tiles", "clay_tile"},     {"photovoltaic", "solar_panel"},
        {"person", "clothing"},    {"olive", "green_paint"},   {"paint", "green_paint"},
    };
    return words;
}

}  // namespace diurna
