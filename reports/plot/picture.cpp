#include "reports/plot/picture.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "pipeline/core/check.h"
#include "reports/text/html.h"

namespace hbr::inline reports {

void InkSheet::place(std::span<const std::uint8_t> image, double x, double y, int side) {
  HBR_CHECK(image.size() == kImageSide * kImageSide && side > 0, "{} pixels", image.size());
  cv::Mat digit(kImageSide, kImageSide, CV_8UC1);
  std::copy(image.begin(), image.end(), digit.begin<std::uint8_t>());
  cv::Mat scaled;
  cv::resize(digit, scaled, cv::Size(side, side), 0, 0, side < kImageSide ? cv::INTER_AREA : cv::INTER_CUBIC);
  const cv::Rect wanted(cvRound(x - side / 2.0), cvRound(y - side / 2.0), side, side);
  const cv::Rect inside = wanted & cv::Rect(0, 0, ink_.cols, ink_.rows);
  if (inside.empty()) return;
  cv::Mat target = ink_(inside);
  cv::max(target, scaled(inside - wanted.tl()), target);
}

std::string InkSheet::svg_image(double x, double y, double width, double height) const {
  cv::Mat pixels;
  const cv::Mat black(ink_.size(), CV_8UC1, cv::Scalar(0));
  cv::merge(std::vector<cv::Mat>{black, black, black, ink_}, pixels);
  return hbr::svg_image(encode_png(pixels), x, y, width, height, "ink");
}

std::string encode_png(const cv::Mat& pixels) {
  std::vector<std::uint8_t> bytes;
  if (!cv::imencode(".png", pixels, bytes, {cv::IMWRITE_PNG_COMPRESSION, 5}))
    throw InputError("OpenCV cannot write a PNG: is it built with libpng?");
  return {bytes.begin(), bytes.end()};
}

std::string svg_image(const std::string& png, double x, double y, double width, double height,
                      const char* css_class) {
  return fmt::format("<image class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" xlink:href=\"{}\"/>\n",
                     css_class, x, y, width, height, data_uri(png, "image/png"));
}

Drawing picture_file(const std::filesystem::path& png, double width) {
  std::ifstream file(png, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  const std::vector<char> buffer(bytes.begin(), bytes.end());
  const cv::Mat pixels = buffer.empty() ? cv::Mat() : cv::imdecode(buffer, cv::IMREAD_UNCHANGED);
  if (pixels.empty())
    throw InputError("{} is missing or no PNG; delete its folder and give the same make again", png.string());
  const double height = width * pixels.rows / pixels.cols;
  return {width, height, svg_image(bytes, 0, 0, width, height, "photo")};
}

std::string square_axes(double x, double y, double side) {
  std::string body = fmt::format(
      "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"none\" stroke=\"{}\"/>\n",
      x + 0.5, y + 0.5, side - 1, side - 1, hex(Colour::faint));
  for (const auto& [label, share] : {std::pair{"−1", 0.0}, std::pair{"0", 0.5}, std::pair{"1", 1.0}}) {
    const Align along = share == 0 ? Align::left : share == 1 ? Align::right : Align::centre;
    body += svg_text(label, x + share * side, y + side + 16, 13, Colour::grey, along);
    body += svg_text(label, x - 5, y + 12 + (1 - share) * (side - 12), 13, Colour::grey, Align::right);
  }
  return body;
}

std::string svg_text(const std::string& text, double x, double y, double size, Colour colour, Align align) {
  const char* anchor = align == Align::left ? "start" : align == Align::centre ? "middle" : "end";
  return fmt::format(
      "<text x=\"{:.1f}\" y=\"{:.1f}\" font-family=\"sans-serif\" font-size=\"{}\" text-anchor=\"{}\" "
      "fill=\"{}\">{}</text>\n",
      x, y, size, anchor, hex_of_words(colour), escape_html(text));
}

}  // namespace hbr::inline reports
