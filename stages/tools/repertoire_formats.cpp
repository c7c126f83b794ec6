#include "stages/tools/repertoire_formats.h"

#include <fmt/format.h>

#include <bit>
#include <iterator>
#include <limits>
#include <map>
#include <numeric>

#include "pipeline/artifact/content.h"
#include "pipeline/artifact/hdf5_file.h"
#include "pipeline/artifact/repertoire_file.h"
#include "pipeline/core/check.h"
#include "pipeline/qd/places.h"

namespace hbr::inline stages {
namespace {

static_assert(std::endian::native == std::endian::little, "the .npy files say so");

// Version 1.0 of NumPy's format: the header is padded so that the values begin at a multiple of 64 bytes.
std::string npy(const Rows& rows) {
  constexpr std::size_t kBefore = 10, kAlignment = 64;
  std::string header = fmt::format("{{'descr': '<f4', 'fortran_order': False, 'shape': ({}, {}), }}",
                                   rows.rows(), rows.cols());
  header.resize((kBefore + header.size()) / kAlignment * kAlignment + kAlignment - kBefore - 1, ' ');
  header += '\n';
  std::string bytes = "\x93NUMPY\x01";
  bytes += '\0';
  bytes += static_cast<char>(header.size() & 0xff);
  bytes += static_cast<char>(header.size() >> 8);
  bytes += header;
  bytes.append(reinterpret_cast<const char*>(rows.data()),
               static_cast<std::size_t>(rows.size()) * sizeof(float));
  return bytes;
}

void numbered(std::string& head, const char* name, Eigen::Index columns) {
  for (Eigen::Index c = 0; c < columns; ++c) fmt::format_to(std::back_inserter(head), "{}_{},", name, c);
}

}  // namespace

StoredRepertoire read_repertoire(const std::filesystem::path& path) {
  StoredRepertoire repertoire{read_elites(path), {}, {}};
  const Elites& elites = repertoire.elites;
  const Hdf5Reader file(path);
  if (!file.has("centroids")) {
    repertoire.centroids = elites.measures;
    repertoire.cell.resize(elites.id.size());
    std::iota(repertoire.cell.begin(), repertoire.cell.end(), 0);
    return repertoire;
  }
  const Array<float> centroids = file.read<float>("centroids");
  const auto d = static_cast<std::size_t>(elites.measures.cols());
  if (centroids.shape.size() != 2 || centroids.shape[0] == 0 || centroids.shape[1] != d)
    throw InputError("{}: centroids: expected cells x {} numbers, found [{}]", path.string(), d,
                     fmt::join(centroids.shape, ", "));
  repertoire.centroids = Eigen::Map<const Rows>(
      centroids.values.data(), static_cast<Eigen::Index>(centroids.shape[0]), static_cast<Eigen::Index>(d));
  Elites centres;
  centres.measures = repertoire.centroids;
  repertoire.cell = nearest_elites(elites.measures, centres).elite;
  std::map<std::int32_t, std::size_t> taken;
  for (std::size_t i = 0; i < repertoire.cell.size(); ++i)
    if (const auto [at, free] = taken.emplace(repertoire.cell[i], i); !free)
      throw InputError(
          "{}: measures: the elites {} and {} are nearest to centroid {}; expected one in a cell",
          path.string(), elites.id[at->second], elites.id[i], repertoire.cell[i]);
  return repertoire;
}

std::string pyribs_csv(const StoredRepertoire& repertoire) {
  const Elites& elites = repertoire.elites;
  std::string csv;
  numbered(csv, "solution", elites.solution.cols());
  csv += "objective,";
  numbered(csv, "measures", elites.measures.cols());
  csv += "id,parent,";
  if (!elites.length.empty()) csv += "length,";
  if (elites.uncertainty.size() > 0) csv += "uncertainty,";
  csv += "index\n";
  const auto add = [&](const auto& value) { fmt::format_to(std::back_inserter(csv), "{},", value); };
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    for (const float gene : elites.solution.row(i)) add(gene);
    add(elites.objective[i]);
    for (const float coordinate : elites.measures.row(i)) add(coordinate);
    const auto row = static_cast<std::size_t>(i);
    add(elites.id[row]);
    add(elites.parent[row]);
    if (!elites.length.empty()) add(elites.length[row]);
    if (elites.uncertainty.size() > 0) add(elites.uncertainty[i]);
    fmt::format_to(std::back_inserter(csv), "{}\n", repertoire.cell[row]);
  }
  return csv;
}

void write_qdax(const StoredRepertoire& repertoire, const std::filesystem::path& folder) {
  const Elites& elites = repertoire.elites;
  const Rows& centroids = repertoire.centroids;
  Rows genotypes = Rows::Zero(centroids.rows(), elites.solution.cols()),
       descriptors = Rows::Zero(centroids.rows(), centroids.cols()),
       fitnesses = Rows::Constant(centroids.rows(), 1, -std::numeric_limits<float>::infinity()),
       lengths = Rows::Zero(centroids.rows(), 1);
  for (Eigen::Index i = 0; i < elites.size(); ++i) {
    const Eigen::Index cell = repertoire.cell[static_cast<std::size_t>(i)];
    genotypes.row(cell) = elites.solution.row(i);
    descriptors.row(cell) = elites.measures.row(i);
    fitnesses(cell, 0) = elites.objective[i];
    lengths(cell, 0) = static_cast<float>(elites.genes(i));
  }
  std::filesystem::create_directories(folder);
  write_file(folder / "genotypes.npy", npy(genotypes));
  write_file(folder / "fitnesses.npy", npy(fitnesses));
  write_file(folder / "descriptors.npy", npy(descriptors));
  write_file(folder / "centroids.npy", npy(centroids));
  if (!elites.length.empty()) write_file(folder / "lengths.npy", npy(lengths));
}

}  // namespace hbr::inline stages
