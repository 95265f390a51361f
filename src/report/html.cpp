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

std::string page_head(const std::string& title, const std::string& comment, const std::string& version,
                      const std::string& extra_style) {
    std::string page = "<!doctype html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n";
    page += fmt::format("<title>{}</title>\n", escaped(title));
    if (!comment.empty()) page += "<!-- " + comment + " -->\n";
    page += "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n";
    page += fmt::format("<meta name=\"generator\" content=\"hibi {}\">\n", escaped(version));
    page += "<link rel=\"icon\" href=\"data:,\">\n";  // or a browser asks for one
    page += fmt::format(
        "<script>document.documentElement.dataset.theme = "
        "matchMedia('(prefers-color-scheme: dark)').matches ? 'dark' : 'light';</script>\n"
        "<style>\n{}{}</style>\n</head>\n<body>\n",
        page_style, extra_style);
    return page;
}

}  // namespace hibi
