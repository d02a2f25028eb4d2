// Writes what each harness begins with: seeds FOLDER

#include <array>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>

#include "tests/corpus/yard.hpp"
#include "tests/support/tape7_text.hpp"

namespace {

namespace fs = std::filesystem;

fs::path root;

void put(const std::string& harness, const std::string& name, const std::string& text) {
    fs::create_directories(root / harness);
    std::ofstream(root / harness / name, std::ios::binary) << text;
}

template <class T>
std::string bytes(T value) {
    std::string text(sizeof value, '\0');
    std::memcpy(text.data(), &value, sizeof value);
    return text;
}

std::string binary_stl() {
    std::string text(80, ' ');
    text += bytes(std::uint32_t{1});
    for (const float number : {0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f, 0.f, 0.f, 1.f, 0.f}) {
        text += bytes(number);
    }
    return text + std::string(2, '\0');
}

const std::string gltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"name":"n",
"children":[1],"translation":[0,0,1]},{"name":"m","scale":[1,1,1]}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]}],
"materials":[{"name":"paint"}],
"buffers":[{"byteLength":44,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIAAAA="}],
"bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},{"buffer":0,"byteOffset":36,"byteLength":6}],
"accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]},
{"bufferView":1,"componentType":5123,"count":3,"type":"SCALAR"}]})";

/// A glTF's JSON as the first chunk of a GLB.
std::string glb(std::string json) {
    json.resize((json.size() + 3) / 4 * 4, ' ');
    return "glTF" + bytes(std::uint32_t{2}) + bytes(std::uint32_t(20 + json.size())) +
           bytes(std::uint32_t(json.size())) + "JSON" + json;
}

void put_meshes() {
    const std::string ply =
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    const std::string stl =
        "solid s\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
        "endloop\nendfacet\nendsolid s\n";
    const std::array<std::string, 6> seeds{
        std::string(1, '\0') + "mtllib a.mtl\nusemtl a\ng part\n" + yard::crate,
        std::string(1, '\1') + ply,
        std::string(1, '\2') + stl,
        std::string(1, '\2') + binary_stl(),
        std::string(1, '\3') + gltf,
        std::string(1, '\4') + glb(gltf)};
    for (std::size_t i = 0; i < seeds.size(); ++i) put("mesh", std::to_string(i), seeds[i]);
}

void put_weather() {
    const auto seed = [](char kind, const std::string& name, const std::string& text) {
        put("weather", name, std::string(1, kind) + text);
    };
    seed(0, "csv", yard::weather());
    seed(1, "epw",
         "LOCATION,Town,ST,USA,TMY3,725300,41.98,-87.92,-6.0,201.0\nDESIGN CONDITIONS,0\n"
         "TYPICAL/EXTREME PERIODS,0\nGROUND TEMPERATURES,0\nHOLIDAYS/DAYLIGHT SAVINGS,No,0,0,0\n"
         "COMMENTS 1,a\nCOMMENTS 2,b\nDATA PERIODS,1,1,Data,Sunday,1/1,12/31\n"
         "1999,1,1,1,0,?9?9?9,-12.2,-16.1,73,99500,0,1415,167,0,0,0,0,0,0,0,270,3.6,0,0,16.0,"
         "77777,9,999999999,60,0.1,0,88,0.0,0.0,1.0\n"
         "1999,1,1,2,0,?9?9?9,-12.2,-16.7,69,99500,0,1415,165,0,0,0,0,0,0,0,270,3.6,0,0,16.0,"
         "77777,9,999999999,60,0.1,0,88,0.0,0.0,1.0\n");
    seed(2, "surfrad",
         " Bondville\n   40.05  -88.37  213 m version 1\n"
         " 1995 135  5 15  0  0  0.000  95.10     0.0 0    -2.0 0     0.0 0    -1.0 0     0.0 0"
         "   330.0 0   288.0 0   288.0 0   350.0 0   288.0 0   288.0 0     0.0 0     0.0 0"
         "   -20.0 0   -20.0 0    15.0 0    80.0 0     3.0 0   180.0 0   990.0 0\n");
    seed(3, "bsrn",
         "*C0001\n 30  6 2026 1\n*C0004\n*U0100\n  1    0   0   -1.0 -9.9   -9   -9   320 -9.9 "
         "  -9   -9\n             15.0  80.0  990\n");
    seed(0, "tmy3",
         "722780,\"PHOENIX\",AZ,-7.0,33.450,-111.983,337\nDate (MM/DD/YYYY),Time (HH:MM),GHI "
         "(W/m^2),DNI (W/m^2),DHI (W/m^2),Dry-bulb (C),RHum (%),Pressure (mbar),Wspd (m/s)\n"
         "01/01/1988,01:00,0,0,0,10.0,50,975,2.1\n01/01/1988,02:00,0,0,0,9.0,52,975,2.1\n");
}

}  // namespace

int main(int count, char** argument) {
    if (count != 2) return 2;
    root = argument[1];
    put("scene", "yard", yard::scene);
    put("column", "yard", yard::column);
    put("spectrum", "yard", yard::spectrum);
    put("spectrum", "band", yard::response);
    put("sonde", "csv",
        "height_m,pressure_hPa,temperature_C,relative_humidity_percent\n200,990,25,60\n"
        "1500,850,14,50\n5500,500,-15,20\n");
    put("sonde", "wyoming",
        "-----------------------------------------------------------------------------\n"
        "   PRES   HGHT   TEMP   DWPT   RELH   MIXR   DRCT   SKNT   THTA   THTE   THTV\n"
        "    hPa     m      C      C      %    g/kg    deg   knot     K      K      K \n"
        "-----------------------------------------------------------------------------\n"
        " 1000.0    113   20.0   15.0     73   10.9    180      5  293.1  323.9  295.1\n"
        "  850.0   1500   10.0    5.0     71    6.5    200     15  292.5  311.9  293.7\n"
        "  500.0   5600  -15.0  -25.0     42    1.0    250     40  314.7  318.3  314.9\n");
    diurna::PathSpectrum spectrum;
    spectrum.transmittance.assign(4, 0.5);
    spectrum.radiance.assign(4, 1.0);
    const diurna::AskedPath level{.from_km = 0.0, .to_km = 1.0, .range_km = 5.0};
    put("tape7", "run", diurna::tape7_run(level, spectrum, {100, 104}));
    put("tape7", "convolved", diurna::convolved_run(level, spectrum, {100, 104}));
    put_meshes();
    put_weather();
}
