#include "models/dataset/dataset.h"

#include <gmock/gmock.h>

#include "models/dataset/idx.h"
#include "pipeline/core/check.h"
#include "tests/models/dataset/idx_fixture.h"

namespace hbr {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class DatasetTest : public IdxFolder {
 protected:
  Dataset read_all(const std::vector<std::string>& sha256 = {}) {
    return read_idx_folder("made", folder_, sha256);
  }
  // What the error says; it must be one line that names the file.
  std::string complaint(const std::string& file, const std::vector<std::string>& sha256 = {}) {
    try {
      read_all(sha256);
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr((folder_ / file).string()));
      EXPECT_THAT(error.what(), ::testing::Not(HasSubstr("\n")));
      return error.what();
    }
    ADD_FAILURE() << "no complaint about " << file;
    return "";
  }
};

TEST_F(DatasetTest, ReadsWhatWasWritten) {
  const Dataset dataset = read_all();
  EXPECT_EQ(dataset.name, "made");
  EXPECT_EQ(dataset.train.images, train_.images);
  EXPECT_EQ(dataset.train.labels, train_.labels);
  EXPECT_EQ(dataset.test.images, test_.images);
  EXPECT_EQ(dataset.test.labels, test_.labels);
}

TEST_F(DatasetTest, ReadsGzippedFiles) {
  for (const char* file : kIdxFiles) pack(file);
  const Dataset dataset = read_all();
  EXPECT_EQ(dataset.train.images, train_.images);
  EXPECT_EQ(dataset.test.labels, test_.labels);
}

TEST_F(DatasetTest, SurvivesItsArtifact) {
  const auto path = folder_ / "dataset.h5";
  {
    Hdf5Writer file(path);
    write_dataset(file, read_all());
    file.close();
  }
  const Dataset dataset = read_dataset(path);
  EXPECT_EQ(dataset.name, "made");
  EXPECT_EQ(dataset.train.images, train_.images);
  EXPECT_EQ(dataset.train.labels, train_.labels);
  EXPECT_EQ(dataset.test.images, test_.images);
  EXPECT_EQ(dataset.test.labels, test_.labels);
}

TEST_F(DatasetTest, RefusesAnArtifactOfAnotherShape) {
  const auto path = folder_ / "dataset.h5";
  {
    Hdf5Writer file(path);
    file.attribute("name", std::string("small"));
    for (const std::string part : {"train", "test"}) {
      file.write(part + "/images", {3, 14, 14}, Bytes(3 * 14 * 14).data());
      file.write(part + "/labels", Bytes(3));
    }
    file.close();
  }
  EXPECT_THROW(read_dataset(path), InputError);
}

TEST_F(DatasetTest, RefusesAMissingFile) {
  std::filesystem::remove(folder_ / kIdxFiles[3]);
  EXPECT_THAT(complaint(kIdxFiles[3]), HasSubstr("missing"));
}

TEST_F(DatasetTest, ChecksHashesOfTheUnpackedContent) {
  // FIPS 180-4's own example.
  write(kIdxFiles[1], {'a', 'b', 'c'});
  const std::string abc = "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad";
  pack(kIdxFiles[1]);
  EXPECT_THAT(complaint(kIdxFiles[1], {"", abc, "", ""}), HasSubstr("too short"));
  const std::string other = "00" + abc.substr(2);
  EXPECT_THAT(complaint(kIdxFiles[1], {"", other, "", ""}), AllOf(HasSubstr(abc), HasSubstr(other)));
  EXPECT_THROW(read_all({abc}), InputError);
}

TEST_F(DatasetTest, RefusesAFileThatIsTooShort) {
  Bytes bytes = read(kIdxFiles[0]);
  bytes.pop_back();
  write(kIdxFiles[0], bytes);
  EXPECT_THAT(complaint(kIdxFiles[0]),
              AllOf(HasSubstr("30 x 28 x 28"), HasSubstr("23519"), HasSubstr("fetch it again")));
  write(kIdxFiles[0], {0, 0, 8});
  EXPECT_THAT(complaint(kIdxFiles[0]),
              HasSubstr("too short: expected a header of 16 bytes, found 3 bytes in all; fetch it again"));
  write(kIdxFiles[0], {});
  EXPECT_THAT(complaint(kIdxFiles[0]), HasSubstr("too short"));
}

TEST_F(DatasetTest, RefusesAFileThatIsTooLong) {
  Bytes bytes = read(kIdxFiles[0]);
  bytes.push_back(0);
  write(kIdxFiles[0], bytes);
  EXPECT_THAT(complaint(kIdxFiles[0]), AllOf(HasSubstr("30 x 28 x 28"), HasSubstr("found more")));
  EXPECT_THAT(complaint(kIdxFiles[0], {"00", "00", "00", "00"}), HasSubstr("found more"));
}

// A few bytes that unpack to very many: no more of them is unpacked than the header promises. Damage behind
// that is never seen, so its complaint would tell that everything was read.
TEST_F(DatasetTest, UnpacksNoMoreThanTheHeaderPromises) {
  const std::string name = std::string(kIdxFiles[0]) + ".gz";
  write(kIdxFiles[0], idx_bytes({1, 28, 28}, Bytes(50'000'000)));
  pack(kIdxFiles[0]);
  Bytes bytes = read(name);
  EXPECT_LT(bytes.size(), 100'000u);
  bytes.back() ^= 1;  // the length that gzip notes at the end
  write(name, bytes);
  EXPECT_THAT(complaint(name), AllOf(HasSubstr("1 x 28 x 28"), HasSubstr("found more")));
  // Nor anything where the promise is none that a file could keep.
  write(kIdxFiles[0], idx_bytes({0xffffffff, 0xffffffff, 28}, Bytes(50'000'000)));
  std::filesystem::remove(folder_ / name);
  pack(kIdxFiles[0]);
  bytes = read(name);
  bytes.back() ^= 1;
  write(name, bytes);
  EXPECT_THAT(complaint(name), HasSubstr("no file has as many"));
}

TEST_F(DatasetTest, RefusesATruncatedGzip) {
  pack(kIdxFiles[0]);
  const std::string name = std::string(kIdxFiles[0]) + ".gz";
  Bytes bytes = read(name);
  bytes.resize(bytes.size() / 2);
  write(name, bytes);
  complaint(name);
}

TEST_F(DatasetTest, RefusesADamagedGzip) {
  pack(kIdxFiles[0]);
  const std::string name = std::string(kIdxFiles[0]) + ".gz";
  Bytes bytes = read(name);
  bytes[bytes.size() / 2] ^= 0x40;
  write(name, bytes);
  complaint(name);
}

TEST_F(DatasetTest, RefusesAnotherMagicNumber) {
  Bytes bytes = read(kIdxFiles[2]);
  bytes[2] = 0x0d;  // floats
  write(kIdxFiles[2], bytes);
  EXPECT_THAT(complaint(kIdxFiles[2]), AllOf(HasSubstr("0x00000803"), HasSubstr("0x00000d03")));
  std::filesystem::copy_file(folder_ / kIdxFiles[3], folder_ / kIdxFiles[2],
                             std::filesystem::copy_options::overwrite_existing);  // labels for images
  EXPECT_THAT(complaint(kIdxFiles[2]), HasSubstr("0x00000801"));
}

TEST_F(DatasetTest, RefusesSizesThatOverflow) {
  const std::uint32_t most = 0xffffffff;
  write(kIdxFiles[0], idx_bytes({most, most, most}, Bytes(100)));
  EXPECT_THAT(complaint(kIdxFiles[0]), HasSubstr("length"));
  write(kIdxFiles[0], idx_bytes({1u << 31, 1u << 31, 4}, {}));  // the product, 2^64, would wrap to 0
  EXPECT_THAT(complaint(kIdxFiles[0]), HasSubstr("length"));
}

TEST_F(DatasetTest, RefusesOtherImageSizes) {
  write(kIdxFiles[0], idx_bytes({30, 14, 14}, Bytes(30 * 14 * 14)));
  EXPECT_THAT(complaint(kIdxFiles[0]), HasSubstr("30 x 14 x 14"));
}

TEST_F(DatasetTest, RefusesAnEmptySet) {
  write(kIdxFiles[0], idx_bytes({0, 28, 28}, {}));
  write(kIdxFiles[1], idx_bytes({0}, {}));
  EXPECT_THAT(complaint(kIdxFiles[0]), HasSubstr("no image"));
}

TEST_F(DatasetTest, RefusesALabelAboveNine) {
  test_.labels[7] = 10;
  write_part(2, test_);
  EXPECT_THAT(complaint(kIdxFiles[3]), AllOf(HasSubstr("label 7"), HasSubstr("10")));
}

TEST_F(DatasetTest, RefusesCountsThatDisagree) {
  write(kIdxFiles[1], idx_bytes({29}, Bytes(29)));
  EXPECT_THAT(complaint(kIdxFiles[1]), AllOf(HasSubstr("30"), HasSubstr("29")));
}

}  // namespace
}  // namespace hbr
