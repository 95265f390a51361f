#pragma once
#include <string>

#include "image/canvas.hpp"
#include "image/text.hpp"

namespace hibi {

struct Stroke {
    Rgb colour{};
    double width = 1;
    bool round = false;  ///< ends; a path without length becomes a dot
    double dash = 0;     ///< length of a dash, two thirds of it the gap; 0: none
};

/// Lines and text on a Cairo surface, or the same as elements of an SVG picture: paths alone, so that it
/// needs no font, and without names, so that many fit into one page. Coordinates are the pen's.
class Ink {
 public:
    Ink(cairo_t* pen, const Typesetter& type) : pen_(pen), type_(type) {}
    /// Appends to the text, lengths rounded to hundredths.
    Ink(std::string& svg, const Typesetter& type);

    cairo_t* path() const { return pen_; }  ///< where to build the path that is painted next
    void stroke(const Stroke& stroke);
    void fill(const Rgb& colour);
    void line(double x0, double y0, double x1, double y1, const Stroke& how);
    void text(const std::string& words, double x, double y, const TextStyle& style);
    const Typesetter& type() const { return type_; }

 private:
    std::string take_path();

    cairo_t* pen_;
    const Typesetter& type_;
    std::string* svg_ = nullptr;
    CairoSurface scratch_;
    CairoPen scratch_pen_;
};

/// Text as it may stand between tags and in attributes.
std::string xml_escaped(const std::string& text);

}  // namespace hibi
