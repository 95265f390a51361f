#pragma once
#include <string>
#include <vector>

#include "image/axes.hpp"
#include "image/chart.hpp"
#include "image/chart_axis.hpp"
#include "image/flags.hpp"
#include "image/free_places.hpp"

namespace hibi {

/// One chart of a figure, measured and then drawn. All lengths in points. Keeps references to what it is
/// given.
class ChartDrawing {
 public:
    ChartDrawing(const Chart& chart, double left, double width, const FigureStyle& style,
                 const Typesetter& type);

    double head() const { return head_; }  ///< above the axes
    double height_from_axes() const { return axes_.height + foot_; }
    /// Where the axes begin: charts beside each other share it.
    void place(double axes_top) { axes_.y = axes_top; }

    ChartPlace place() const;
    void draw(Ink& ink) const;

 private:
    struct Name {  ///< of a line, in the legend or at its end
        const ChartLine* line;
        double x, y;  ///< of the legend's sample, from its top; the line's end as share of the axis' height
    };
    void lay_out_flags();
    bool name_lines_at_their_ends(const std::vector<const ChartLine*>& named);
    void lay_out_legend(const std::vector<const ChartLine*>& named);
    TextStyle plain(const Rgb& colour, Align align = Align::left) const;
    TextStyle mark_style() const;
    Stroke stroke_of(const ChartLine& line) const;
    Point point(double x, double y) const;
    std::vector<Polyline> visible(const ChartLine& line) const;
    Polyline dots(const ChartLine& line) const;
    void draw_dots(Ink& ink, const Polyline& at, double radius, const Rgb& colour) const;
    void draw_flags(Ink& ink) const;
    void draw_legend(Ink& ink) const;
    void draw_names_at_ends(Ink& ink) const;
    void draw_dot_marks(Ink& ink, FreePlaces& free) const;

    const Chart& chart_;
    const Theme& colours_;
    const Typesetter& type_;
    AxesStyle look_;
    double text_, left_, width_;
    ChartScale x_, y_;
    PixelRect axes_;
    std::vector<ChartScale::Number> x_numbers_, y_numbers_;
    std::vector<Name> legend_, ends_;
    std::vector<Flag> flags_;  ///< of the upright marks, above the axes
    std::vector<std::string> flag_words_;
    int title_row_ = 0;  ///< of the vertical axis, among the flags
    double legend_height_ = 0, above_ = 0, head_ = 0, foot_ = 0;
    std::vector<std::string> note_;
};

}  // namespace hibi
