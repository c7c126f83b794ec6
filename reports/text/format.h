// Numbers as a reader wants them: three significant digits, narrow no-break spaces between thousands, a true
// minus sign, powers of ten as 7.1·10⁻¹⁸. All texts are UTF-8 without markup.
#pragma once

#include <string>

namespace hbr::inline reports {

// Never rounds away the integer part: 1397 -> "1 397", 0.02962 -> "0.0296", 6.5e-5 -> "6.50·10⁻⁵".
// Not finite -> "–".
std::string format_number(double value, int digits = 3);

// As few significant digits as give the number itself, at most nine: 0.71 -> 2.
int exact_digits(double value);

// The number and its unit, a narrow no-break space between. Units are those of the statistics: "m^2" is
// typeset, and words ("elites", "fitness") are left out, because sentences and table heads say them.
std::string format_quantity(double value, const std::string& unit, int digits = 3);

// "1 397 [1 335; 1 520]", the unit behind: median, first and third quartile.
std::string format_quartiles(double median, double q1, double q3, const std::string& unit);

// "10⁻⁴"
std::string power_of_ten(int exponent);

// A p-value to two digits: "0.034", "7.1·10⁻¹⁸"; 0 (underflow) -> "< 10⁻³⁰⁰".
std::string format_p(double p);

}  // namespace hbr::inline reports
