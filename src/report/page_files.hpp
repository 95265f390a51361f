#pragma once

namespace hibi {

extern const char* const page_style;         ///< page.css
extern const char* const page_script;        ///< page.js
extern const char* const difference_style;   ///< difference.css, which follows page.css
extern const char* const difference_script;  ///< difference.js

}  // namespace hibi
