#include <fmt/format.h>
#include <png.h>

#include <catch2/catch.hpp>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "materials/base/files.hpp"
#include "scenes/charts/html.hpp"
#include "scenes/job/input/scene_file.hpp"
#include "scenes/job/run/job.hpp"
#include "scenes/job/store/digest.hpp"
#include "scenes/products/report/page.hpp"
#include "tests/support/browser.hpp"
#include "tests/support/passed_over.hpp"
#include "tests/support/ran.hpp"
#include "tests/support/small_scene.hpp"

// A run's page in a browser, from a file: what it says to the console, what its sliders do, how it
// looks on a desk, a phone and paper.

using namespace diurna;

namespace {

namespace fs = std::filesystem;

const PrivateTempFolder temp;

// Names that would be read as HTML, as an attribute's end, as a script's end.
const std::string hostile =
    R"(\"'><script>window.pwned=1</script><img src=x onerror=\"window.pwned=1\">)";

/// What studies might have left: a crossover whose plot holds a script, one in a folder of its own
/// that is no JSON, one of a kind that the page has no table for.
void leave_studies(const fs::path& out) {
    const std::string plot =
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"300\" height=\"100\"><script>"
        "window.pwned=1;parent.pwned=1</script><rect width=\"300\" height=\"100\"/></svg>";
    const std::string head =
        R"({"study": "crossover", "name": ")" + hostile + R"(", "first": "pond",
 "second": "meadow", "observer": "east", "threshold_K": 1.0, "bands": [{"band_um": "8-12",
 "hours": 24.0, "hours_below_threshold": 2.5, "least_contrast_K": 0.0, "crossings": [)";
    write_text(out / "pond.json", head + R"({"time": "2026-07-15T10:30:29-04:00", "kind": "crosses",
 "warmer_after": "meadow", "sigma_s": 924.0, "least_K": 0.0}]}]})");
    fs::create_directories(out / "contrast");
    write_text(out / "contrast/broken.json", "{\"study\": \"contrast\", ");
    write_text(out / "odd.json", R"({"study": "oddity", "name": "odd", "made_from": {"scene":
 "other.toml", "settings": ["time.spin_up=steady"], "heat_sha256": "0"}})");
    for (const char* name : {"pond.svg", "contrast/broken.svg", "odd.svg"}) {
        write_text(out / name, plot);
    }
}

/// The page of a run that has been made once.
const fs::path& page() {
    static const ScratchFolder folder("page");
    static const fs::path file = [] {
        const fs::path scene = folder.path / "scene.toml";
        const std::string quoted = fmt::format("\"{}\"", hostile);
        std::string text = with(small_scene(), "name = \"small\"\n",
                                fmt::format("name = \"small\"\ntitle = {}\n", quoted));
        text = with(text, "\"concrete_wall\"", quoted);
        write_text(
            scene,
            text + fmt::format("[output]\nfluxes = true\n[material.{}]\nlike = \"concrete_wall\"\n",
                               quoted));
        const JobOptions options{.out = folder.path / "out", .settings = {}, .resume = true};
        run_job(read_scene(scene), options);
        leave_studies(options.out);
        run_job(read_scene(scene), options);
        return folder.path / "out/report.html";
    }();
    return file;
}

bool no_browser() {
    if (!Browser::program().empty()) return false;
    pass_over("no chromium");
    return true;
}

struct Picture {
    std::uint32_t width = 0, height = 0;
    std::vector<std::uint32_t> pixel;  // RGBA
    std::size_t colours() const { return std::set(pixel.begin(), pixel.end()).size(); }
};

std::vector<std::uint8_t> bytes_of(const std::string& base64) {
    std::vector<std::uint8_t> bytes;
    std::uint32_t block = 0;
    int bits = 0;
    for (const char c : base64) {
        const std::size_t digit =
            std::string("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/").find(c);
        if (digit == std::string::npos) break;
        block = block << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits >= 8) bytes.push_back(static_cast<std::uint8_t>(block >> (bits -= 8)));
    }
    return bytes;
}

/// What is to be seen of an element, or of the first `height` pixels of the page.
Picture shot(Browser& browser, const std::string& element = "", int height = 1600) {
    Browser::Json clip{{"x", 0}, {"y", 0}, {"scale", 1}};
    if (element.empty()) {
        clip["width"] = browser.evaluate("document.documentElement.clientWidth");
        clip["height"] = height;
    } else {
        const auto box = browser.evaluate(
            "(() => { const b = document.querySelector('" + element +
            "').getBoundingClientRect(); return [b.x + scrollX, b.y + scrollY, b.width, b.height]; "
            "})()");
        clip = {{"x", box[0]}, {"y", box[1]}, {"width", box[2]}, {"height", box[3]}, {"scale", 1}};
    }
    const std::string data =
        browser.call("Page.captureScreenshot",
                     {{"format", "png"}, {"captureBeyondViewport", true}, {"clip", clip}})["data"];
    const std::vector<std::uint8_t> png = bytes_of(data);
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, png.data(), png.size()));
    image.format = PNG_FORMAT_RGBA;
    Picture picture{image.width, image.height,
                    std::vector<std::uint32_t>(image.width * image.height)};
    REQUIRE(png_image_finish_read(&image, nullptr, picture.pixel.data(), 0, nullptr));
    return picture;
}

void slide(Browser& browser, int to) {
    browser.evaluate(
        fmt::format("(() => {{ const s = document.querySelector('.series input[type=range]'); "
                    "s.value = {}; s.dispatchEvent(new Event('input', {{ bubbles: true }})); }})()",
                    to));
}

const std::string big = "document.querySelector('.series .big')";

}  // namespace

TEST_CASE("a page's script is the one that the page allows", "[scenes][report]") {
    const std::string hex = sha256(page_script());
    std::vector<std::byte> bytes;
    for (std::size_t i = 0; i < hex.size(); i += 2) {
        bytes.push_back(static_cast<std::byte>(std::stoi(hex.substr(i, 2), nullptr, 16)));
    }
    CHECK(base64(bytes) == page_script_digest);
}

TEST_CASE("a run's page says nothing to the console and fits a phone",
          "[scenes][report][browser]") {
    if (no_browser()) return;
    Browser browser;
    for (const int width : {1280, 360}) {
        CAPTURE(width);
        browser.open(page(), width);
        CHECK(browser.complaints == std::vector<std::string>{});
        CHECK(browser.evaluate("document.documentElement.scrollWidth") <= width);
        CHECK(browser.evaluate("[...document.images].every((i) => !i.src || i.naturalWidth > 0)") ==
              true);
        // Letters of at least 11 pixels.
        CHECK(browser.evaluate("Math.min(...[...document.querySelectorAll('body *')].filter((e) => "
                               "!e.closest('svg')).map((e) => "
                               "parseFloat(getComputedStyle(e).fontSize)))") >= 11.0);
        CHECK(shot(browser).colours() > 100);
        CHECK(shot(browser, ".series .sheet").colours() > 50);
        // No two words of a chart lie on each other.
        CHECK(browser.evaluate(R"(
[...document.querySelectorAll('svg.chart')].flatMap((chart) => {
  const words = [...chart.querySelectorAll('text')].map((t) => [t.textContent, t.getBoundingClientRect()]);
  return words.flatMap(([a, p], i) => words.slice(i + 1).filter(([b, q]) =>
    p.left < q.right - 1 && q.left < p.right - 1 && p.top < q.bottom - 3 && q.top < p.bottom - 3)
    .map(([b]) => a + ' / ' + b));
}))") == Browser::Json::array());
        CHECK(browser.evaluate("document.querySelectorAll('svg.chart circle').length") > 1);
        // A name is text: it neither runs nor breaks out.
        CHECK(browser.evaluate("typeof window.pwned") == "undefined");
        CHECK(browser.evaluate("document.title").get<std::string>().find("<script>window.pwned") !=
              std::string::npos);
    }
}

TEST_CASE("a page's slider moves through the day, together with the others",
          "[scenes][report][browser]") {
    if (no_browser()) return;
    Browser browser;
    browser.open(page(), 1280);
    const Picture midnight = shot(browser, ".series .big");
    CHECK(midnight.colours() > 30);
    slide(browser, 2);
    CHECK(browser.evaluate(big + ".src === document.querySelectorAll('.series')[0]"
                                 ".querySelectorAll('figure')[2].querySelector('img').src") ==
          true);
    CHECK(browser.evaluate("document.querySelector('.series .now b').textContent") == "12:00");
    CHECK(browser.evaluate("document.querySelectorAll('.series')[1].querySelector('.now b')"
                           ".textContent") == "12:00");
    CHECK(shot(browser, ".series .big").pixel != midnight.pixel);
    CHECK(browser.evaluate("document.querySelectorAll('figure.shown').length") == 2);
    // The ends of its own scale; then of all pictures', on which it looks otherwise.
    const std::string ends =
        "[...document.querySelector('.series').querySelectorAll('.scale')].filter((s) => "
        "s.offsetHeight > 0).map((s) => [s.querySelector('.ticks').firstChild.textContent, "
        "s.querySelector('.ticks').lastChild.textContent].map(Number))";
    const auto own = browser.evaluate(ends);
    REQUIRE(own.size() == 1);
    const auto data = browser.evaluate(
        "(() => { const d = document.querySelector('figure.shown').dataset; return [[+d.low, "
        "+d.high]]; })()");
    CHECK(own == data);
    const Picture on_its_own = shot(browser, ".series .big");
    browser.evaluate("document.querySelector('.series input.one').click()");
    const auto common = browser.evaluate(ends);
    REQUIRE(common.size() == 1);
    CHECK(common[0][0] <= own[0][0]);
    CHECK(common[0][1].get<double>() - common[0][0].get<double>() >
          own[0][1].get<double>() - own[0][0].get<double>());
    CHECK(shot(browser, ".series .big").pixel != on_its_own.pixel);
    // A picture of the sheet is a place of the slider.
    browser.evaluate("document.querySelectorAll('.series figure')[3].click()");
    CHECK(browser.evaluate("document.querySelector('.series input[type=range]').value") == "3");
    CHECK(browser.complaints == std::vector<std::string>{});
}

TEST_CASE("a page has all sections, studies left in its folder too", "[scenes][report]") {
    const std::string text = read_text(page());
    std::size_t at = 0;
    for (const char* title :
         {"What was computed", "Pictures", "Temperatures over the day", "Heat balance over the day",
          "Studies", "Known errors", "Time of this run", "Plan: computed and skipped", "Notes",
          "Inputs"}) {
        CAPTURE(title);
        const std::size_t found = text.find(fmt::format("<h2>{}</h2>", title));
        REQUIRE(found != std::string::npos);
        CHECK(found > at);
        at = found;
    }
    // 924 s are 15.4 min.
    CHECK(text.find("<td>2026-07-15 10:30</td><td>crosses</td><td>meadow</td><td>15.4</td><td>2.5 "
                    "of 24</td>") != std::string::npos);
    CHECK(text.find("contrast/broken.json is not shown: ") != std::string::npos);
    CHECK(text.find("<h3>oddity odd</h3>") != std::string::npos);
    CHECK(text.find("<b>Another scene or other settings</b>: computed from other.toml with "
                    "time.spin_up=steady") != std::string::npos);
    CHECK(text.find("<script>window") == std::string::npos);
    // What a run was made of, with what it held.
    const std::string scene = read_text(page().parent_path().parent_path() / "scene.toml");
    CHECK(text.find(sha256(scene)) != std::string::npos);
    // Of the balance's terms nothing is left over: their sum is reported with each chart.
    CHECK(text.find("The terms add up to zero within ") != std::string::npos);
}

TEST_CASE("without scripts and on paper a page is whole", "[scenes][report][browser]") {
    if (no_browser()) return;
    Browser browser;
    browser.call("Emulation.setScriptExecutionDisabled", {{"value", true}});
    browser.open(page(), 1280);
    CHECK(browser.complaints == std::vector<std::string>{});
    CHECK(browser.evaluate("document.querySelector('.player').offsetHeight") == 0);
    const std::string shown =
        "[...document.querySelectorAll('.series figure')].every((f) => [...f.querySelectorAll("
        "'img')].filter((i) => i.offsetHeight > 0).length === 1)";
    CHECK(browser.evaluate(shown) == true);
    const Picture own = shot(browser, ".series .sheet");
    browser.evaluate("document.querySelector('.series input.one').click()");
    CHECK(browser.evaluate(shown) == true);
    CHECK(shot(browser, ".series .sheet").pixel != own.pixel);
    browser.call("Emulation.setScriptExecutionDisabled", {{"value", false}});
    browser.open(page(), 1280);
    browser.call("Emulation.setEmulatedMedia", {{"media", "print"}});
    CHECK(browser.evaluate("document.querySelector('.player').offsetHeight") == 0);
    CHECK(browser.evaluate(shown) == true);
    // A4 between margins of 1 cm is 718 pixels wide.
    browser.call("Emulation.setDeviceMetricsOverride",
                 {{"width", 718}, {"height", 1000}, {"deviceScaleFactor", 1}, {"mobile", false}});
    CHECK(browser.evaluate("document.documentElement.scrollWidth") <= 718);
    const std::string pdf = browser.call("Page.printToPDF", {{"printBackground", false}})["data"];
    CHECK(bytes_of(pdf).size() > 20000);
}

// Even where a name were not spelt out, the page's policy lets no other script run.
TEST_CASE("a script that got into a page does not run", "[scenes][report][browser]") {
    if (no_browser()) return;
    const ScratchFolder folder("pwned");
    const std::string text =
        with(read_text(page()), "<h2>Pictures</h2>",
             "<script>window.pwned=1</script><p id=\"bait\" onclick=\"window.pwned=1\">x</p>"
             "<img src=\"file:///etc/hostname\"><h2>Pictures</h2>");
    write_text(folder.path / "report.html", text);
    Browser browser;
    browser.open(folder.path / "report.html", 1280);
    browser.evaluate("document.querySelector('#bait').click()");
    CHECK(browser.evaluate("typeof window.pwned") == "undefined");
    CHECK(browser.complaints.size() >= 3);
    slide(browser, 1);
    CHECK(browser.evaluate("document.querySelector('.series .now b').textContent") == "06:00");
}
