// Manifests, slices and the cache of hashes, damaged in every place: one line or made again, never a crash.
#include <gmock/gmock.h>

#include <tuple>

#include "pipeline/artifact/json_file.h"
#include "pipeline/artifact/status.h"
#include "pipeline/core/check.h"
#include "tests/support/damaged_json.h"
#include "tests/support/temporary_folder.h"

namespace hbr {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

// What reading says; "" where the text is accepted. Any other exception fails the test.
template <class Read>
std::string complaint(Read&& read) {
  try {
    read();
  } catch (const InputError& error) {
    EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
    return error.what();
  }
  return "";
}

TEST(JsonFile, TellsWhereAndWhat) {
  for (const auto& [text, told] : {std::pair(R"({"a": {"b": 1, "b": 2}})", "f: the key \"b\" stands twice"),
                                   {"{\"a\": 1,\n\"b\": }", "f: not JSON: at line 2, column 6: "},
                                   {"[1e999]", "f: not JSON: number overflow parsing '1e999'"},
                                   {"[NaN]", "f: not JSON: at line 1, column 2: "},
                                   {"[1] 2", "f: not JSON: at line 1, column 5: "},
                                   {"\"\xff\"", "f: not JSON: at line 1, column 2: "},
                                   {"", "f: not JSON: at line 1, column 1: "}})
    EXPECT_THAT(complaint([&, json_text = text] { parse_json(json_text, "f"); }), StartsWith(told));
  // The same key in two tables is no fault.
  EXPECT_EQ(parse_json(R"({"a": {"b": 1}, "c": [{"b": 2}, {"b": 3}]})", "f").size(), 2u);
}

TEST(JsonFile, ASealIsOfTheOtherValues) {
  const json table = {{"a", 1}, {"b", {{"c", "d"}}}};
  EXPECT_EQ(unsealed(sealed(table), "f"), table);
  EXPECT_EQ(sealed(sealed(table)), sealed(table));
  json edited = sealed(table);
  edited["b"]["c"] = "e";
  EXPECT_THAT(complaint([&] { unsealed(edited, "f"); }), StartsWith("f: edited or damaged since"));
  EXPECT_THAT(complaint([&] { unsealed(table, "f"); }),
              StartsWith("f: expected a table with the key 'seal'"));
}

// One artifact, a.h5, and what made it.
class Damaged : public testing::Test {
 protected:
  Damaged() {
    node_.program = "program";
    node_.stage = "a";
    node_.output = "a.h5";
    node_.settings = {{"number", 1.5}, {"list", {1, 2}}};
    node_.sources = {(out() / "source").string()};
    for (const char* name : {"program", "source"}) write_file(out() / name, name);
    write_file(out() / "a.h5", "artifact");
    Manifest manifest;
    manifest.made_from = freshness().ingredients;
    manifest.key = manifest.made_from.key();
    manifest.content = content_of(out() / "a.h5");
    manifest.fingerprint = fingerprint(out() / "a.h5");
    manifest.run = {{"seconds", 1.5}, {"host", "here"}, {"threads", 2}, {"later", "?"}};
    write_manifest(manifest_file(), manifest);
  }
  fs::path out() const { return folder_.path(); }
  fs::path manifest_file() const { return out() / "a.json"; }
  Workspace workspace() const { return {out(), out(), out()}; }
  Freshness freshness() const { return freshness_of(workspace(), Graph{node_})[0]; }
  std::size_t refused() const { return audit(workspace(), {node_}).problems.size(); }

  // audit, status and make agree; where they refuse, the reason names the manifest.
  void expect_agreement(const std::string& what, bool must_be_refused) const {
    const std::size_t problems = refused();
    const Freshness found = freshness();
    if (problems > 0) {
      EXPECT_NE(found.state, State::fresh) << what;
    }
    if (!must_be_refused) return;
    EXPECT_EQ(problems, 1u) << what;
    EXPECT_EQ(found.state, State::damaged) << what;
    EXPECT_THAT(found.why, StartsWith("its manifest is damaged: " + manifest_file().string() + ": ")) << what;
    EXPECT_THAT(found.why, Not(HasSubstr("\n"))) << what;
  }

  TemporaryFolder folder_;
  Node node_;
};

TEST_F(Damaged, ManifestsAreRefusedByAuditMakeAndStatusAlike) {
  ASSERT_EQ(freshness().state, State::fresh) << freshness().why;
  ASSERT_EQ(refused(), 0u);
  const std::string good = read_whole(manifest_file());
  for (const auto& [what, text] : damages_of(good)) {
    write_file(manifest_file(), text);
    expect_agreement(what, what != " lacks seal");  // as manifests were before there were seals
  }
  // Without the seal, and with one that fits: types and names are still checked.
  json unsealed_manifest = json::parse(good);
  unsealed_manifest.erase("seal");
  for (const auto& [what, text] : damages_of(unsealed_manifest.dump())) {
    write_file(manifest_file(), text);
    expect_agreement(what, false);
    json table;
    if (!complaint([&, &json_text = text] { table = parse_json(json_text, "f"); }).empty() ||
        !table.is_object())
      continue;
    write_file(manifest_file(), sealed(table).dump());
    expect_agreement("sealed " + what, false);
  }
  for (const auto& [what, told] : {std::pair("bytes", "bytes: expected a whole number"),
                                   {"run", "run: expected a table"},
                                   {"slice", "slice: expected a table"},
                                   {"sources", "sources: expected a list"}}) {
    json wrong = unsealed_manifest;
    wrong[what] = "x";
    write_file(manifest_file(), wrong.dump());
    EXPECT_THAT(freshness().why, HasSubstr(told));
  }
  for (const auto& [place, value, told] :
       {std::tuple("/program", json(sha256_of_text("other")), "key: expected "),
        {"/slice/settings/number", json(2.5), "key: expected "},
        {"/run/seconds", json("x"), "run.seconds: expected a number from 0, found \"x\""},
        {"/run/host", json(3), "run.host: expected a text, found 3"}}) {
    json wrong = unsealed_manifest;
    wrong[json::json_pointer(place)] = value;
    write_file(manifest_file(), sealed(wrong).dump());
    expect_agreement(place, true);
    EXPECT_THAT(freshness().why, HasSubstr(told));
  }
}

TEST_F(Damaged, AnEditedHashIsToldFromADamagedArtifact) {
  json edited = json::parse(read_whole(manifest_file()));
  edited["sha256"] = sha256_of_text("other");
  write_file(manifest_file(), edited.dump());
  EXPECT_THAT(audit(workspace(), {node_}).problems[0], HasSubstr("a.json: edited or damaged since"));
}

TEST_F(Damaged, WhatAuditFindsBehindAnUnchangedSignIsMadeAgain) {
  // As a disk does it that decays: other bytes, and nothing else has changed.
  Manifest manifest = read_manifest(manifest_file());
  write_file(out() / "a.h5", "artefact");
  manifest.fingerprint = fingerprint(out() / "a.h5");
  write_manifest(manifest_file(), manifest);
  EXPECT_EQ(freshness().state, State::fresh);
  EXPECT_EQ(refused(), 1u);
  EXPECT_EQ(freshness().state, State::damaged);
  EXPECT_THAT(freshness().why, StartsWith("damaged: expected sha256"));
}

TEST_F(Damaged, OtherThingsInTheirPlacesAreToldAndMadeAgain) {
  const fs::path artifact = out() / "a.h5";
  const auto expect_damaged = [&](const std::string& why) {
    EXPECT_EQ(freshness().state, State::damaged) << why;
    EXPECT_THAT(freshness().why, HasSubstr(why));
    EXPECT_EQ(refused(), 1u) << why;
  };
  for (const fs::path& place : {artifact, manifest_file()}) {
    fs::rename(place, out() / "kept");
    ASSERT_EQ(::mkfifo(place.c_str(), 0600), 0);
    expect_damaged("expected a file or a folder, found something else");
    fs::remove(place);
    fs::create_directory(place);
    expect_damaged(place == artifact ? "damaged: expected sha256" : "Is a directory");
    fs::remove(place);
    fs::create_symlink(place.filename(), place);
    expect_damaged("Too many levels of symbolic links; its symbolic links lead back to themselves");
    fs::remove(place);
    fs::create_symlink("kept", place);  // moved elsewhere: as good as itself
    EXPECT_EQ(freshness().state, State::fresh) << freshness().why;
    fs::remove(place);
    fs::rename(out() / "kept", place);
  }
  write_file(artifact, "another");
  EXPECT_THAT(audit(workspace(), {node_}).problems[0],
              StartsWith(artifact.string() + ": damaged: expected sha256"));
  write_file(artifact, "artifact");
  fs::remove(manifest_file());
  expect_damaged("its manifest is missing");
  fs::rename(artifact, out() / "kept");
  fs::create_symlink("nowhere", artifact);
  EXPECT_EQ(freshness().state, State::missing);
}

TEST_F(Damaged, ACacheOfHashesIsOnlyACache) {
  Workspace cached = workspace();
  cached.remember = true;
  fs::create_directories(out() / ".plan");
  const fs::path file = out() / ".plan/hashes.json";
  HashCache hashes(cached);
  const std::string program = hashes.program("program"), source = hashes.source("source");
  EXPECT_EQ(source, sha256_of_text("source"));
  hashes.save();
  for (const auto& [what, text] : damages_of(read_whole(file))) {
    write_file(file, text);
    HashCache again(cached);
    EXPECT_EQ(again.program("program"), program) << what;
    EXPECT_EQ(again.source("source"), source) << what;
  }
}

TEST_F(Damaged, SlicesAreRefusedInOneLine) {
  write_slice(out(), node_);
  const fs::path file = slice_path(out(), node_);
  EXPECT_EQ(read_slice(file).settings, node_.settings);
  std::size_t refusals = 0;
  const std::vector<Damage> all = damages_of(read_whole(file));
  for (const auto& [what, text] : all) {
    write_file(file, text);
    const std::string told = complaint([&] { read_slice(file); });
    refusals += !told.empty();
    if (!told.empty()) {
      EXPECT_THAT(told, StartsWith(file.string() + ": ")) << what;
    }
    complaint([&, &damaged = text] { slice_from_json(parse_json(damaged, "f"), "f"); });
  }
  EXPECT_GT(refusals, all.size() / 2);  // the others are other texts, and other settings
}

}  // namespace
}  // namespace hbr
