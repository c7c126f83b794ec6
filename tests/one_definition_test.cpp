// No two classes share a name. Where they did, an optimised program would mostly be right by chance, and
// another would call one's functions for the other's objects. `make check-odr` has the linker look, too.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

namespace hbr {
namespace {

namespace fs = std::filesystem;

// Without comments, texts and preprocessor lines.
std::string bare(const std::string& source) {
  std::string code;
  for (std::size_t at = 0; at < source.size();) {
    const auto skip_to = [&](const std::string& end) {
      const std::size_t found = source.find(end, at + 1);
      at = found == std::string::npos ? source.size() : found + end.size();
      code += ' ';
    };
    const char c = source[at];
    const std::size_t line = code.find_last_not_of(" \t");
    if (source.compare(at, 2, "//") == 0 || (c == '#' && (line == std::string::npos || code[line] == '\n'))) {
      at = std::min(source.find('\n', at), source.size());
    } else if (source.compare(at, 2, "R\"") == 0) {
      std::string end = ")";
      end.append(source, at + 2, source.find('(', at) - at - 2);
      skip_to(end += '"');
    } else if (c == '"' ||
               (c == '\'' && (at == 0 || !std::isalnum(static_cast<unsigned char>(source[at - 1]))))) {
      for (++at; at < source.size() && source[at] != c; ++at) at += source[at] == '\\';
      ++at;
      code += ' ';
    } else {
      code += c;
      ++at;
    }
  }
  return code;
}

// The qualified names of the classes that a source defines where other files see them.
std::set<std::string> classes_of(const std::string& source) {
  // A word, or what ends one and begins another.
  static const std::regex kToken(R"(\w+(?:::\w+)*|[{};()<>:=,])");
  std::set<std::string> found;
  std::vector<std::string> scopes;  // "": one that nobody else sees
  std::vector<std::string> words;   // since the last statement or brace
  const std::string text = bare(source);
  for (std::sregex_iterator token(text.begin(), text.end(), kToken), end; token != end; ++token) {
    const std::string word = token->str();
    if (word == "}") {
      if (!scopes.empty()) scopes.pop_back();
      words.clear();
    } else if (word == ";") {
      words.clear();
    } else if (word != "{") {
      words.push_back(word);
    } else {
      std::string scope;
      const bool seen = std::ranges::find(scopes, "") == scopes.end();
      if (words.size() == 2 && words[0] == "namespace") scope = words[1];
      // An inline namespace's names are those of the one around it.
      if (words.size() == 3 && words[0] == "namespace" && words[1] == "hbr::inline") scope = "hbr";
      const bool is_template = !words.empty() && words[0] == "template";
      for (std::size_t i = 0; seen && !is_template && i + 1 < words.size() && scope.empty(); ++i) {
        if (words[i] == "(" || words[i] == "=") break;
        if (words[i] != "class" && words[i] != "struct" && words[i] != "enum" && words[i] != "union")
          continue;
        const bool scoped = words[i] == "enum" && (words[i + 1] == "class" || words[i + 1] == "struct");
        if (i + 1 + scoped >= words.size()) break;
        std::string name;
        for (const std::string& outer : scopes) name += outer + "::";
        found.insert(name + words[i + 1 + scoped]);
        break;
      }
      scopes.push_back(scope);
      words.clear();
    }
  }
  return found;
}

TEST(OneDefinition, TheTestFindsWhatItLooksFor) {
  const std::set<std::string> found = classes_of(R"code(
#define NO struct Macro {
namespace hbr {  // struct Comment {
struct A { struct Inner { int x; }; int f() { struct Local {}; return 0; } };
class B final : public A {};
enum class C : int { one };
namespace inner { struct A {}; }
namespace { struct Hidden {}; class B {}; }
struct Declared;
std::string text = "struct Text {";
template <class T> struct Template {};
void function(struct Declared& d) { struct Local2 {}; }
struct A::Outside { int y; };
}
namespace hbr::inline part { struct D {}; }
)code");
  EXPECT_EQ(found, (std::set<std::string>{"hbr::A", "hbr::B", "hbr::C", "hbr::inner::A", "hbr::A::Outside",
                                          "hbr::D"}));
}

TEST(OneDefinition, NoTwoFilesDefineAClassOfOneName) {
  std::map<std::string, std::set<std::string>> files;
  for (const char* part : {"pipeline", "models", "reports", "stages", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(fs::path(HBR_SOURCE_DIR) / part)) {
      if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
      std::ifstream stream(entry.path());
      const std::string source{std::istreambuf_iterator<char>(stream), {}};
      for (const std::string& name : classes_of(source))
        files[name].insert(entry.path().lexically_relative(HBR_SOURCE_DIR).string());
    }
  EXPECT_GT(files.size(), 300u);
  for (const auto& [name, where] : files) {
    std::string list;
    for (const std::string& file : where) list += " " + file;
    EXPECT_EQ(where.size(), 1u) << name << " is defined in" << list;
  }
}

}  // namespace
}  // namespace hbr
