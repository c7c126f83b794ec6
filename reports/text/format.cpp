#include "reports/text/format.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace hbr::inline reports {
namespace {

constexpr const char* kNarrowSpace = "\u202f";

// From "-1234.5" to "−1 234.5"; four digits and more are grouped.
std::string typeset(const std::string& plain) {
  const bool negative = plain.starts_with('-');
  const std::string digits = negative ? plain.substr(1) : plain;
  const std::size_t whole = std::min(digits.find('.'), digits.size());
  std::string text = negative ? "−" : "";
  for (std::size_t i = 0; i < digits.size(); ++i) {
    if (i > 0 && i < whole && (whole - i) % 3 == 0) text += kNarrowSpace;
    text += digits[i];
  }
  return text;
}

std::string scientific(double value, int digits) {
  const std::string text = fmt::format("{:.{}e}", value, digits - 1);
  const std::size_t e = text.find('e');
  return typeset(text.substr(0, e)) + "·" + power_of_ten(std::stoi(text.substr(e + 1)));
}

std::string unit_suffix(const std::string& unit) {
  static const std::map<std::string, std::string> kSymbols = {
      {"%", "%"},     {"m", "m"},        {"mm", "mm"}, {"m^2", "m²"},
      {"rad", "rad"}, {"rad^2", "rad²"}, {"s", "s"},   {"°", "°"}};
  const auto symbol = kSymbols.find(unit);
  return symbol == kSymbols.end() ? "" : kNarrowSpace + symbol->second;
}

}  // namespace

std::string power_of_ten(int exponent) {
  static const char* const kDigits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = "10";
  for (const char c : std::to_string(exponent)) text += c == '-' ? "⁻" : kDigits[c - '0'];
  return text;
}

std::string format_number(double value, int digits) {
  if (!std::isfinite(value)) return "–";
  if (value == 0) return "0";
  const double size = std::abs(value);
  if (size < 1e-3 || size >= 1e9) return scientific(value, digits);
  if (std::abs(value - std::round(value)) < 1e-9 * size) return typeset(fmt::format("{:.0f}", value));
  // The place of the first digit after rounding: 9.996 is 10.0, not 10.00.
  const std::string rounded = fmt::format("{:.{}e}", size, digits - 1);
  const int exponent = std::stoi(rounded.substr(rounded.find('e') + 1));
  return typeset(fmt::format("{:.{}f}", value, std::max(0, digits - 1 - exponent)));
}

int exact_digits(double value) {
  int digits = 1;
  while (digits < 9 &&
         std::abs(std::stod(fmt::format("{:.{}e}", value, digits - 1)) - value) > 1e-9 * std::abs(value))
    ++digits;
  return digits;
}

std::string format_quantity(double value, const std::string& unit, int digits) {
  return format_number(value, digits) + unit_suffix(unit);
}

std::string format_quartiles(double median, double q1, double q3, const std::string& unit) {
  return fmt::format("{} [{}; {}]{}", format_number(median), format_number(q1), format_number(q3),
                     unit_suffix(unit));
}

std::string format_p(double p) {
  if (!std::isfinite(p)) return "–";
  if (p < 1e-300) return "< " + power_of_ten(-300);
  if (p < 1e-3) return scientific(p, 2);
  return typeset(fmt::format("{:.{}f}", p, p < 0.01 ? 4 : p < 0.1 ? 3 : 2));
}

}  // namespace hbr::inline reports
