// The page's own texts, from page.html, page.css and scripts/*.js, compiled in: a report needs no path.
#pragma once

namespace hbr::inline reports {

extern const char* const kPageHtml;
extern const char* const kPageCss;
extern const char* const kPageJs;
extern const char* const kRobots3dHtml;

}  // namespace hbr::inline reports
