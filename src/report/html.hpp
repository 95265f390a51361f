#pragma once
#include <string>

namespace hibi {

/// Text as it stands between tags or in an attribute.
std::string escaped(const std::string& text);

/// Bytes within the page.
std::string data_uri(const std::string& type, const std::string& bytes);

/// Beginning of a page in the style of all pages, `extra_style` included, up to the open body. `comment` must
/// not hold a '>'; it may be empty.
std::string page_head(const std::string& title, const std::string& comment, const std::string& version,
                      const std::string& extra_style = {});

}  // namespace hibi
