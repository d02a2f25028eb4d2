#include "scenes/products/report/page.hpp"

#include <fmt/format.h>

#include "render/picture/palette.hpp"
#include "scenes/charts/html.hpp"

namespace diurna {

namespace {

constexpr const char* style = R"(
*{box-sizing:border-box}
body{font:15px/1.5 system-ui,sans-serif;color:#1c2330;background:#fff;max-width:1180px;margin:1.5em auto;padding:0 1em;overflow-wrap:anywhere}
h1{font-size:1.6em;line-height:1.25;margin:.4em 0 .1em}h2{margin-top:2em;border-bottom:1px solid #d5dae3;padding-bottom:.2em}
h3{margin:1.6em 0 .5em}h4{margin:1.4em 0 .2em}nav{display:flex;flex-wrap:wrap;gap:.2em 1.2em;margin:.8em 0}a{color:#1f5fa8}
table{border-collapse:collapse;font-variant-numeric:tabular-nums}td,th{padding:.2em .8em;text-align:left;vertical-align:top;border-bottom:1px solid #e6e9ef}
td,th{overflow-wrap:normal}.facts td{overflow-wrap:anywhere}td.n,th.n{text-align:right;white-space:nowrap}td.key{min-width:9em}.key{color:#566}
.facts{width:100%}.hash{font:12px/1.7 ui-monospace,monospace;color:#566}
.wide{overflow-x:auto;margin:.6em 0}.wide img{display:block;max-width:none}
.figures td,.figures th{white-space:nowrap}.figures td:last-child{white-space:normal;min-width:13em}
svg.chart{display:block;max-width:100%;height:auto}.phone{display:none}
.sheet{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(46%,210px),1fr));gap:8px}
figure{margin:0;break-inside:avoid}.sheet img{width:100%;display:block;image-rendering:pixelated}
figcaption{font-size:.8em;line-height:1.35;color:#566;padding-top:.2em}figcaption b{color:#1c2330;font-size:1.15em}
figure.shown{outline:3px solid #1f77d0;outline-offset:1px}.playing figure{cursor:pointer}
label.pick{margin-right:.9em;display:inline-block}
.player{margin:.6em 0}.player .big{display:block;width:100%;max-width:640px;image-rendering:pixelated;background:#16161a}
.player .now{margin:.3em 0 0}.player .now b{font-size:1.3em}.player input[type=range]{width:100%;max-width:640px;display:block;margin:.4em 0;height:28px}
.scale{max-width:640px;margin:.5em 0 1em}.bar{height:14px;-webkit-print-color-adjust:exact;print-color-adjust:exact}
.ticks{display:flex;justify-content:space-between;font-size:.85em;font-variant-numeric:tabular-nums}.scale p{margin:0;font-size:.85em;color:#566}
input.each:checked~.scale.common,input.each:checked~.sheet .common,input.one:checked~.scale.each,input.one:checked~.sheet .each{display:none}
svg text{font:12px system-ui,sans-serif}svg .t{font-size:14px;font-weight:600}svg .e{text-anchor:end;fill:#566}
svg .m{text-anchor:middle;fill:#566}svg .g{stroke:#e3e7ee;fill:none}
@media(max-width:600px){body{margin:.5em auto;padding:0 .7em}h1{font-size:1.3em}td,th{padding:.2em .45em}td.key{min-width:6.5em}
.desk{display:none}.phone{display:block}
.stack td:first-child{color:#566}.stack tr,.stack td{display:block;border:0;padding:.05em .2em}.stack tr{border-bottom:1px solid #e6e9ef;padding:.4em 0}.stack tr:first-child{display:none}}
@media print{body{font-size:10pt;max-width:none;margin:0;padding:0}nav,.pick,.player{display:none!important}
.sheet{grid-template-columns:repeat(4,1fr)}figure.shown{outline:0}.wide{overflow:visible}.wide img{width:100%;height:auto}.figures{width:100%;font-size:8pt}.figures td,.figures th{white-space:normal;padding:.15em .3em}.figures td:last-child{min-width:0}
.scale.each .ticks{display:none}.desk{display:block}.phone{display:none}
h2,h3{break-after:avoid}tr,.chart{break-inside:avoid}a{color:inherit;text-decoration:none}}
)";

/// The colours of pictures from left to right, as CSS.
std::string bar_style(const char* name, Rgb (*colour)(double)) {
    constexpr int steps = 24;
    std::string stops;
    for (int i = 0; i <= steps; ++i) {
        const Rgb c = colour(double(i) / steps);
        stops += fmt::format(",#{:02x}{:02x}{:02x}", c[0], c[1], c[2]);
    }
    return fmt::format(".{}{{background:linear-gradient(to right{})}}\n", name, stops);
}

}  // namespace

const std::string& page_script() {
    static const std::string script = R"("use strict";
(() => {
  const players = [];
  for (const series of document.querySelectorAll(".series")) {
    const one = (what) => series.querySelector(what);
    const figures = [...series.querySelectorAll("figure")];
    const slider = one("input[type=range]"), big = one(".big"), now = one(".now");
    const each = one("input.each"), together = one(".together input");
    const ticks = [...series.querySelectorAll(".scale.each .ticks span")];
    const draw = () => {
      const figure = figures[Number(slider.value)];
      const picture = figure.querySelector(each && !each.checked ? "img.common" : "img");
      big.src = picture.src;
      big.alt = picture.alt;
      now.replaceChildren(...figure.querySelector("figcaption").cloneNode(true).childNodes);
      slider.setAttribute("aria-valuetext", figure.querySelector("b").textContent);
      for (const other of figures) other.classList.toggle("shown", other === figure);
      const low = Number(figure.dataset.low), high = Number(figure.dataset.high);
      ticks.forEach((tick, i) => {
        tick.textContent = Number((low + (high - low) * i / (ticks.length - 1)).toPrecision(3));
      });
    };
    const go = (i) => {
      slider.value = i;
      draw();
    };
    const chosen = (i) => {
      go(i);
      if (!together || !together.checked) return;
      const at = Number(figures[i].dataset.at);
      for (const player of players) {
        if (player.go === go || !player.together.checked) continue;
        let nearest = 0;
        player.at.forEach((t, k) => {
          if (Math.abs(t - at) < Math.abs(player.at[nearest] - at)) nearest = k;
        });
        player.go(nearest);
      }
    };
    slider.addEventListener("input", () => chosen(Number(slider.value)));
    figures.forEach((figure, i) => figure.addEventListener("click", () => chosen(i)));
    for (const radio of series.querySelectorAll("input.pick")) radio.addEventListener("change", draw);
    players.push({ go, together, at: figures.map((figure) => Number(figure.dataset.at)) });
    series.classList.add("playing");
    one(".player").hidden = false;
    draw();
  }
  if (players.length < 2) {
    for (const label of document.querySelectorAll(".together")) label.hidden = true;
  }
})();
)";
    return script;
}

const char* const page_script_digest = "Ln/rfRmaj9U1FRODD9lkEyvdcLSXW2iu58Gzme/UC0Q=";

std::string page_begin(const std::string& title,
                       const std::vector<std::pair<std::string, std::string>>& sections) {
    std::string links;
    for (const auto& [id, name] : sections) {
        links += fmt::format("<a href=\"#{}\">{}</a>\n", id, escaped(name));
    }
    return fmt::format(
        "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
        "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; img-src data:; "
        "style-src 'unsafe-inline'; script-src 'sha256-{}'; base-uri 'none'; form-action "
        "'none'\">\n"
        "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
        "<title>{}</title><style>{}{}{}</style></head>\n<body>\n<h1>{}</h1>\n<nav>\n{}</nav>\n",
        page_script_digest, escaped(title), style, bar_style("warm", warm_colour),
        bar_style("grey", grey_of_light), escaped(title), links);
}

std::string page_end() { return "<script>" + page_script() + "</script>\n</body></html>\n"; }

std::string wide(const std::string& inner) { return "<div class=\"wide\">" + inner + "</div>\n"; }

}  // namespace diurna
