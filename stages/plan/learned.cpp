// The dataset, and what is learned from it: the judge and the descriptors.
#include <cstdlib>

#include "models/onnx/file/weights.h"
#include "pipeline/core/utf8.h"
#include "stages/plan/plan.h"

namespace hbr::inline stages {
namespace {

constexpr const char *kMnist = "mnist", *kMnistFolder = ".cache/mnist";

// The four files of a dataset, gzipped where they are not there plain.
std::vector<std::string> idx_files(const std::filesystem::path& folder) {
  std::vector<std::string> files;
  for (const char* name : {"train-images-idx3-ubyte", "train-labels-idx1-ubyte", "t10k-images-idx3-ubyte",
                           "t10k-labels-idx1-ubyte"}) {
    const std::filesystem::path plain = folder / name, gzipped = plain.string() + ".gz";
    files.push_back(!exists(plain) && exists(gzipped) ? gzipped : plain);
  }
  return files;
}

void plan_network(Plan& plan, int replication) {
  const std::string autoencoder = plan.descriptor(replication).second;
  plan.add("autoencoder", "autoencoder", replication,
           with(plan.run(replication), settings_to_json(plan.profile().autoencoder)),
           {{"dataset", "dataset.h5"}});
  plan.add({"onnx",
            "onnx",
            replication,
            fmt::format("onnx/{:02}", replication),
            nlohmann::json::object(),
            {{"autoencoder", autoencoder}},
            {}});
}

}  // namespace

void plan_learned(Plan& plan) {
  const Profile& p = plan.profile();
  if (p.replications.digits == 0) return;
  DatasetSettings dataset = p.dataset;
  const char* folder = std::getenv("MNIST_DIR");
  if (folder && *folder && dataset.name == kMnist) dataset.folder = folder;
  if (dataset.name != kMnist && dataset.folder == kMnistFolder)
    plan.fail(fmt::format("dataset.folder: '{}' is that of '{}'; expected another of the dataset '{}'{}",
                          kMnistFolder, kMnist, dataset.name,
                          folder && *folder ? fmt::format(" (MNIST_DIR names that of '{}')", kMnist) : ""));
  if (!is_utf8(dataset.folder))
    plan.fail(fmt::format("the dataset's folder '{}' is not UTF-8, as the texts in manifests are; rename it",
                          as_utf8(dataset.folder)));
  plan.add("dataset", "dataset", -1, settings_to_json(dataset), {}, idx_files(dataset.folder));
  plan.add("judge", "judge", -1,
           {{"seed", p.seed},
            {"judge", settings_to_json(p.judge)},
            {"random_strokes", settings_to_json(p.random_strokes)}},
           {{"dataset", "dataset.h5"}});
  if (plan.own_networks()) {
    for (int r = 0; r < p.replications.digits; ++r) plan_network(plan, r);
    return;
  }
  DescriptorSlice slice{p.descriptor, p.autoencoder.latent_size};
  std::vector<std::string> sources;
  if (slice.kind == "onnx") {
    sources.push_back(slice.file);
    for (const std::filesystem::path& file : weight_files(slice.file)) sources.push_back(file.string());
  }
  plan.add("descriptor", "descriptor", -1, settings_to_json(slice), {{"dataset", "dataset.h5"}}, sources);
}

}  // namespace hbr::inline stages
