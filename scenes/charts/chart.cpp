#include "scenes/charts/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "scenes/charts/chart_layout.hpp"
#include "scenes/charts/html.hpp"

namespace diurna {

namespace {

constexpr double leader = 14.0;  // [px] from a line's end to its name

/// Draws one chart, part by part.
class Drawing {
 public:
    explicit Drawing(const Chart& chart)
        : chart_(chart), at_(layout_of(chart)), span_(chart.x_last - chart.x_first) {
        if (!(span_ > 0.0)) span_ = 1.0;
    }

    std::string whole() {
        out_ = fmt::format(
            "<svg viewBox=\"0 0 {0} {1}\" width=\"{0}\" height=\"{1}\" role=\"img\" "
            "class=\"chart\" xmlns=\"http://www.w3.org/2000/svg\">\n"
            "{2}",
            chart_.width, at_.height,
            chart_.title.empty() ? ""
                                 : fmt::format("<text x=\"{}\" y=\"20\" class=\"t\">{}</text>\n",
                                               at_.left, escaped(chart_.title)));
        for (const Panel& panel : at_.panel) scale(panel);
        x_axis();
        for (const Panel& panel : at_.panel) lines(panel);
        for (const ChartMark& mark : chart_.marks) dot(mark);
        rows();
        return std::move(out_) + "</svg>\n";
    }

 private:
    double x(double value) const { return at_.left + at_.width * (value - chart_.x_first) / span_; }
    static double y(const Panel& panel, double value) {
        return panel.top + panel.height * (1.0 - (value - panel.low) / (panel.high - panel.low));
    }

    void scale(const Panel& panel) {
        const int steps = static_cast<int>(std::lround((panel.high - panel.low) / panel.step));
        for (int i = 0; i <= steps; ++i) {
            const double value = panel.low + i * panel.step;
            out_ += fmt::format(
                "<path class=\"g\" d=\"M{:.1f} {:.1f}h{:.1f}\"/><text class=\"e\" x=\"{:.1f}\" "
                "y=\"{:.1f}\">{:g}</text>\n",
                at_.left, y(panel, value), at_.width, at_.left - 6, y(panel, value) + 4,
                std::abs(value) < 1e-9 * panel.step ? 0.0 : value);
        }
        if (at_.panel.size() > 1 && &panel != &at_.panel.back()) {
            out_ += fmt::format(
                "<path stroke=\"#9aa3b2\" stroke-dasharray=\"2 3\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n",
                at_.left, panel.top + panel.height + 8.0, at_.width);
        }
    }

    void x_axis() {
        for (const auto& [t, says] : ticks_of(chart_, at_.width)) {
            for (const Panel& panel : at_.panel) {
                out_ += fmt::format("<path class=\"g\" d=\"M{:.1f} {:.1f}v{:.1f}\"/>", x(t),
                                    panel.top, panel.height);
            }
            if (!chart_.rows.empty()) {
                out_ += fmt::format("<path class=\"g\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>", x(t),
                                    at_.rows_top, at_.foot);
            }
            out_ += fmt::format("<text class=\"m\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>\n", x(t),
                                at_.foot + 17, escaped(says));
        }
        const Panel &first = at_.panel.front(), &last = at_.panel.back();
        out_ += fmt::format(
            "<text class=\"m\" x=\"{:.1f}\" y=\"{}\">{}</text>\n<text class=\"m\" "
            "transform=\"translate(16 {:.1f}) rotate(-90)\">{}</text>\n",
            chart_.narrow ? chart_.width / 2.0 : at_.left + at_.width / 2, at_.height - 8,
            escaped(chart_.x_title), (first.top + last.top + last.height) / 2,
            escaped(chart_.y_title));
    }

    void lines(const Panel& panel) {
        std::vector<const ChartLine*> named;
        std::vector<double> end;
        for (const std::size_t i : panel.line) {
            const ChartLine& line = chart_.lines[i];
            path(panel, thinned(line, chart_, at_.width));
            if (line.name.empty()) continue;
            named.push_back(&line);
            end.push_back(y(panel, line.y[last_of(line)]));
        }
        const std::vector<double> label =
            spread(end, label_gap, panel.top + 4, panel.top + panel.height);
        for (std::size_t k = 0; k < named.size(); ++k) {
            const double last = x(named[k]->x[last_of(*named[k])]);
            if (last < at_.left + at_.width - 3.0) {  // it ends before the frame does
                out_ += fmt::format(
                    "<path stroke=\"{}\" stroke-width=\"0.8\" stroke-dasharray=\"1 4\" "
                    "d=\"M{:.1f} {:.1f}H{:.1f}\"/>\n",
                    named[k]->colour, last, end[k], at_.left + at_.width);
            }
            name(named[k]->name, named[k]->colour, end[k], label[k]);
        }
    }

    /// The last place of a line that has a number.
    static std::size_t last_of(const ChartLine& line) {
        for (std::size_t k = line.y.size(); k-- > 0;) {
            if (std::isfinite(line.y[k])) return k;
        }
        return 0;
    }

    /// A gap where it has no number.
    void path(const Panel& panel, const ChartLine& line) {
        std::string d;
        bool pen_down = false;
        for (std::size_t k = 0; k < line.x.size(); ++k) {
            if (!std::isfinite(line.y[k])) {
                pen_down = false;
                continue;
            }
            d += fmt::format("{}{:.1f} {:.1f}", pen_down ? 'L' : 'M', x(line.x[k]),
                             y(panel, line.y[k]));
            pen_down = true;
        }
        out_ += fmt::format(
            "<path fill=\"none\" stroke=\"{}\" stroke-width=\"2\" stroke-linecap=\"round\"{} "
            "d=\"{}{}\"><title>{}</title></path>\n",
            line.colour, line.dashed ? " stroke-dasharray=\"5 4\"" : "", d,
            line.x.size() == 1 ? "h0" : "", escaped(line.name));
    }

    /// At the right, joined to where its line ends.
    void name(const std::string& text, const std::string& colour, double end, double label) {
        const double from = at_.left + at_.width;
        out_ += fmt::format(
            "<path fill=\"none\" stroke=\"{0}\" stroke-width=\"0.8\" d=\"M{1:.1f} {2:.1f}L{3:.1f} "
            "{4:.1f}\"/><text x=\"{5:.1f}\" y=\"{6:.1f}\" fill=\"{0}\">{7}{8}</text>\n",
            colour, from + 2, end, from + leader, label, from + leader + 4, label + 4,
            letters_of(text) > at_.letters ? "<title>" + escaped(text) + "</title>" : "",
            escaped(shortened(text, at_.letters)));
    }

    void dot(const ChartMark& mark) {
        for (const Panel& panel : at_.panel) {
            if (std::find(panel.line.begin(), panel.line.end(), mark.line) == panel.line.end())
                continue;
            out_ += fmt::format(
                "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#fff\" stroke=\"{}\" "
                "stroke-width=\"2\"><title>{}</title></circle>\n",
                x(mark.x), y(panel, mark.y), chart_.lines[mark.line].colour, escaped(mark.says));
            return;
        }
    }

    void rows() {
        if (chart_.rows.empty()) return;
        out_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"#566\">{}</text>\n", at_.left,
                            at_.rows_top - 8, escaped(chart_.rows_title));
        double top = at_.rows_top;
        for (const ChartRow& row : chart_.rows) {
            const double foot = top + at_.row_height;
            out_ += fmt::format("<path class=\"g\" d=\"M{:.1f} {:.1f}h{:.1f}\"/>\n", at_.left, foot,
                                at_.width);
            std::vector<double> at, width;
            for (const auto& [t, says] : row.event) {
                at.push_back(x(t));
                width.push_back(letter * double(letters_of(says)) + 12.0);
            }
            const std::vector<EventText> text = event_texts(at, width, at_.left + at_.width);
            for (std::size_t k = 0; k < at.size(); ++k) {
                const std::string says = escaped(row.event[k].second);
                // As high as the line of its text, so that it strikes no other through.
                const double from = top + (text[k].level == 1 ? 17.0 : 4.0);
                out_ += fmt::format(
                    "<path stroke=\"{}\" stroke-width=\"3\" d=\"M{:.1f} {:.1f}v{:.1f}\"><title>{} "
                    "{}</title></path>\n",
                    row.colour, at[k], from, text[k].level < 0 ? 24.0 : 11.0, escaped(row.name),
                    says);
                if (text[k].level < 0) continue;
                const bool leftward = text[k].leftward;
                out_ += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\"{}>{}</text>\n",
                                    at[k] + (leftward ? -5.0 : 5.0),
                                    text[k].level == 0 ? top + 14 : top + 27,
                                    leftward ? " text-anchor=\"end\"" : "", says);
            }
            name(row.name, row.colour, top + at_.row_height / 2, top + at_.row_height / 2);
            top = foot;
        }
    }

    const Chart& chart_;
    ChartLayout at_;
    double span_;
    std::string out_;
};

}  // namespace

std::string svg(const Chart& chart) { return Drawing(chart).whole(); }

int drawn_height(const Chart& chart) { return layout_of(chart).height; }

}  // namespace diurna
