// Settings that several kinds of layers share, each described once.
#pragma once

#include <string>

#include "pipeline/core/settings.h"
#include "pipeline/drawing/draw.h"
#include "pipeline/hierarchy/coordinate.h"

namespace hbr::inline hierarchy {

template <class Fields>
void describe_half_side(Fields& f, double& half_side) {
  f.number("half_side", half_side, Range{1e-3, 100}, "L: half the side of the drawing area, m");
}
template <class Fields>
void describe_longest_line(Fields& f, double& longest_line) {
  f.number("longest_line", longest_line, Range{1e-3, 100}, "rho: longest displacement of a line, m");
}
template <class Fields>
void describe_samples(Fields& f, int& samples) {
  f.number("samples", samples, Range{1, 1e5}, "N: starts of the stochastic descriptor");
}
template <class Fields>
void describe_length_rate(Fields& f, double& length_rate) {
  f.number("length_rate", length_rate, Range{0, 1}, "probability that a block of genes is added or removed");
}

// How what the pen did becomes an image.
struct PencilSettings {
  std::string framing;
  double thinnest_px = 0, thickest_px = 0;
  // Of a gene in [0, 1], pixels.
  double width(float gene) const { return thinnest_px + gene * (thickest_px - thinnest_px); }
};
inline Coordinate pen_width(const PencilSettings& pencil) {
  return {"pen width", "px", pencil.width(0), pencil.width(1)};
}
template <class Fields>
void describe(Fields& f, PencilSettings& s) {
  f.choice("framing", s.framing, {"box", "workspace"}, "which part of the plane the image shows");
  f.number("thinnest_px", s.thinnest_px, Range{0.5, 14}, "pen width of gene 0, pixels");
  f.number("thickest_px", s.thickest_px, Range{0.5, 14}, "pen width of gene 1, pixels");
}

}  // namespace hbr::inline hierarchy
