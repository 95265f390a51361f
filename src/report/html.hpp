#pragma once
#include <string>

#include "image/chart.hpp"
#include "record/provenance.hpp"

namespace hibi {

/// Text as HTML shows it, in an element or between the quotes of an attribute.
std::string escaped(const std::string& text);

/// Bytes within the page.
std::string data_uri(const std::string& type, const std::string& bytes);

/// A page up to <body>: title, where it is from (`hibi reproduce` finds it), style, and the theme that the
/// system prefers. It asks nothing of a network.
std::string page_head(const std::string& title, const Provenance& provenance,
                      const std::string& extra_style = {});

/// The button of the page's corner that changes the theme.
std::string theme_button();

/// A chart as SVG in both themes, of which the style shows one.
std::string chart_in_both_themes(const Chart& chart, double width_mm, ChartPlace* place = nullptr);

}  // namespace hibi
