// The report's colours. A picture names a colour by a fixed RGB value; `recolour` replaces these values, so
// that one drawing serves the page (CSS variables: light and dark) and a file of its own (fixed values).
// The hues are Okabe and Ito's (2008), which colour-blind readers tell apart.
#pragma once

#include <string>
#include <string_view>

namespace hbr::inline reports {

enum class Colour { ink, faint, blue, orange, green, vermilion, purple, sky, grey };

// "#0072b2": for gnuplot and hand-drawn SVG alike.
std::string hex(Colour colour);
// The same for words: most are darker there, or they could not be read on white.
std::string hex_of_words(Colour colour);

// Every "rgb(r, g, b)" and "#rrggbb" of `svg` that is one of the colours becomes the CSS variable
// "var(--ink)", "var(--blue)", ...
std::string recolour_for_page(std::string_view svg);
// ... or the value that suits white paper: ink and faint differ from their names.
std::string recolour_for_paper(std::string_view svg);

}  // namespace hbr::inline reports
