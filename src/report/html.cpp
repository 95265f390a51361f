#include "report/html.hpp"

#include <fmt/format.h>

#include "base/base64.hpp"
#include "report/page_files.hpp"

namespace hibi {

std::string escaped(const std::string& text) {
    std::string result;
    for (const char c : text) switch (c) {
            case '&':
                result += "&amp;";
                break;
            case '<':
                result += "&lt;";
                break;
            case '>':
                result += "&gt;";
                break;
            case '"':
                result += "&quot;";
                break;
            default:
                result += c;
        }
    return result;
}

std::string data_uri(const std::string& type, const std::string& bytes) {
    return fmt::format("data:{};base64,{}", type, base64(bytes));
}

std::string page_head(const std::string& title, const Provenance& provenance,
                      const std::string& extra_style) {
    std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
    page += fmt::format("<title>{}</title>\n", escaped(title));
    page += to_html_comment(provenance);  // `hibi reproduce` looks for it at the beginning of the file
    page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    page += fmt::format("<meta name=\"generator\" content=\"hibi {}\">\n", escaped(provenance.version));
    page += "<link rel=\"icon\" href=\"data:,\">\n";  // or a browser asks for one
    page += fmt::format(
        "<script>document.documentElement.dataset.theme = "
        "matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';</script>\n"
        "<style>\n{}{}</style>\n</head>\n<body>\n",
        page_style, extra_style);
    return page;
}

std::string theme_button() {
    return "<button id=\"theme\" type=\"button\" aria-label=\"Light or dark\">◐</button>";
}

std::string chart_in_both_themes(const Chart& chart, double width_mm, ChartPlace* place) {
    FigureStyle style{.theme = "light", .width_mm = width_mm, .text_pt = 9};
    std::vector<ChartPlace> places;
    const auto svg_of = [&](const char* theme) {
        style.theme = theme;
        places.clear();
        const std::string svg = chart_svg({chart}, style, &places);
        return svg.substr(svg.find("<svg"));
    };
    const std::string text = fmt::format("<div class=\"light\">{}</div><div class=\"dark\">{}</div>",
                                         svg_of("light"), svg_of("dark"));
    if (place) *place = places[0];
    return text;
}

}  // namespace hibi
