// The page's own texts, from *.html, *.css and scripts/*.js, compiled in: a report needs no path.
#pragma once

namespace hbr::inline reports {

extern const char* const kPageHtml;
extern const char* const kPageCss;
extern const char* const kPageJs;
extern const char* const kRobots3dHtml;
extern const char* const kRobotPageHtml;
extern const char* const kRobotPageJs;

}  // namespace hbr::inline reports
