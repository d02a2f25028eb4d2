#include "scenes/charts/chart_figure.hpp"

#include <fmt/format.h>

#include "scenes/charts/chart.hpp"
#include "scenes/charts/html.hpp"

namespace diurna {

std::string chart_figure(const Chart& chart) {
    constexpr int phone = 336;  // [px]
    Chart drawn = chart;
    drawn.title.clear();
    std::string out = fmt::format("<h4>{}</h4>\n<div class=\"desk\">{}</div>\n",
                                  escaped(chart.title), svg(drawn));
    drawn.narrow = true;
    drawn.width = phone;
    return out + fmt::format("<div class=\"phone\">{}</div>\n", svg(drawn));
}

}  // namespace diurna
