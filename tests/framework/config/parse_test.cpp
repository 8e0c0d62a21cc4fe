#include "framework/config/parse.hpp"

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>

#include "framework/config/yaml_text.hpp"
#include "tests/framework/config/toy.hpp"

using namespace tack;
using toy::message_of;
namespace fs = std::filesystem;

namespace {

// A folder of small files that is removed at the end of the test.
struct Folder {
  fs::path root;

  Folder() {
    std::string name = (fs::temp_directory_path() / "tack_parse_XXXXXX").string();
    root = mkdtemp(name.data());
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { fs::remove_all(root); }

  std::string write(const std::string& name, const std::string& text) const {
    const fs::path path = root / name;
    fs::create_directories(path.parent_path());
    std::ofstream(path) << text;
    return path.string();
  }
};

std::string parse_error(const std::string& yaml) {
  return message_of([&] { parse_string(yaml, "s.yaml"); });
}

}  // namespace

TEST_CASE("a parsed tree keeps order, texts and places") {
  const Value v = parse_string("b: 1\na: [x, \"2 3\", ~]\nc:\n  d: \"null\"\n  e:\n", "s.yaml");
  REQUIRE(v.is_map());
  REQUIRE(v.entries.size() == 3);
  CHECK(v.entries[0].key == "b");
  CHECK(v.find("b")->text == "1");
  const Value& a = *v.find("a");
  REQUIRE(a.items.size() == 3);
  CHECK(a.items[1].text == "2 3");
  CHECK(a.items[1].mark.text() == "s.yaml:2:8");
  CHECK(a.items[2].is_null());
  CHECK(v.entries[2].mark.text() == "s.yaml:3:1");
  CHECK(v.find("c")->find("d")->is_scalar());
  CHECK(v.find("c")->find("e")->is_null());
  CHECK(v.find("c")->find("e")->mark.text() == "s.yaml:5:3");
  CHECK(v.find("x") == nullptr);
  CHECK(parse_string("", "s.yaml").is_map());
}

TEST_CASE("aliases are copies") {
  const Value v = parse_string("a: &x {k: 1}\nb: *x\n", "s.yaml");
  CHECK(v.find("b")->find("k")->text == "1");
  CHECK(parse_error("a: &x [*x]\n") == "s.yaml:1:8: an alias may not refer to what encloses it");
  std::string bomb = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int i = 1; i < 12; ++i) {
    const std::string alias = "*a" + std::to_string(i - 1);
    bomb += "a" + std::to_string(i) + ": &a" + std::to_string(i) + " [";
    for (int k = 0; k < 10; ++k) bomb += alias + " , ";
    bomb += "]\n";
  }
  CHECK_THAT(parse_error(bomb), Catch::Contains("more than 1000000 values"));
}

TEST_CASE("YAML errors say where") {
  CHECK(parse_error("a: 1\nb: 2\na: 3\n") == "s.yaml:3:1: duplicate key 'a'; keep one of them");
  CHECK_THAT(parse_error("a: [1, 2\n"), Catch::StartsWith("s.yaml:2:1: not valid YAML: "));
  CHECK(parse_error("a: !!int 3\n") ==
        "s.yaml:1:4: the YAML tag 'tag:yaml.org,2002:int' is not supported; remove it");
  CHECK(parse_error("? [a]\n: 1\n") == "s.yaml:1:3: a key must be a text");
  CHECK(parse_error("a: 1\n---\nb: 1\n") == "s.yaml: holds several documents ('---'); keep one");
  CHECK(message_of([] { parse_file("/nowhere/s.yaml"); }) ==
        "/nowhere/s.yaml: cannot read this file: there is none; check the path");
}

TEST_CASE("included files are merged under the including one") {
  const Folder folder;
  folder.write("base/solid.yaml", "solid: {young: 1, list: [1, 2], law: {type: a, x: 1}}\nk: 1\n");
  folder.write("base/more.yaml", "include: solid.yaml\nk: 2\nextra: {deep: {p: 1, q: 2}}\n");
  folder.write("other.yaml", "k: 3\n");
  const std::string path = folder.write("scene.yaml",
                                        "include: [base/more.yaml, other.yaml]\n"
                                        "solid: {list: [3], law: {type: b}}\n"
                                        "extra: {deep: {q: 5 mm}}\n");
  const Value v = parse_file(path);
  CHECK(inline_text(v) ==
        "{solid: {young: 1, list: [3], law: {type: b}}, k: 3, extra: {deep: {p: 1, q: \"5 mm\"}}}");
  // Every value remembers its own file.
  CHECK(v.find("solid")->find("young")->mark.text() ==
        (folder.root / "base/solid.yaml").string() + ":1:16");
  CHECK(v.find("extra")->find("deep")->find("q")->mark.text() == path + ":3:19");
}

TEST_CASE("the same file may be included twice but not by itself") {
  const Folder folder;
  folder.write("leaf.yaml", "x: 1\n");
  folder.write("left.yaml", "include: leaf.yaml\n");
  folder.write("right.yaml", "include: leaf.yaml\n");
  CHECK_NOTHROW(parse_file(folder.write("diamond.yaml", "include: [left.yaml, right.yaml]\n")));
  const std::string a = folder.write("a.yaml", "x: 1\ninclude: sub/../b.yaml\n");
  const std::string b = folder.write("b.yaml", "include: a.yaml\n");
  CHECK(message_of([&] { parse_file(a); }) ==
        b + ":1:10: include: files include each other: " + a + " -> " + b + " -> " + a);
}

TEST_CASE("a wrong include is reported where it stands") {
  const Folder folder;
  const std::string gone = folder.write("gone.yaml", "x: 1\ninclude: none.yaml\n");
  CHECK(message_of([&] { parse_file(gone); }) ==
        gone + ":2:10: include: " + (folder.root / "none.yaml").string() + ": cannot read this file: there is none; check the path");
  const std::string folder_itself = folder.write("folder.yaml", "include: .\n");
  CHECK_THAT(message_of([&] { parse_file(folder_itself); }), Catch::Contains("cannot read"));
  CHECK(parse_error("include: {a: b}\n") ==
        "s.yaml:1:10: include: expects a file name or a list of them, got a map");
}

TEST_CASE("paths are relative to the file they stand in") {
  const Folder folder;
  folder.write("sub/part.yaml", "mesh: meshes/cube.obj\n");
  const Value v = parse_file(folder.write("scene.yaml", "include: sub/part.yaml\n"));
  const Value& mesh = *v.find("mesh");
  CHECK(resolve_path(mesh.mark, mesh.text) == (folder.root / "sub/meshes/cube.obj").string());
  CHECK(resolve_path(mesh.mark, "../x.obj") == (folder.root / "x.obj").string());
  CHECK(resolve_path(mesh.mark, "/abs/x.obj") == "/abs/x.obj");
  CHECK(resolve_path(mesh.mark, "") == "");
  Value root = Value::map();
  apply_override(root, "dir/mesh=x.obj");
  const Value& set = root.entries[0].value;
  CHECK(resolve_path(set.mark, set.text) == (fs::current_path() / "x.obj").string());
}

TEST_CASE("files that are included again and again are read once") {
  const Folder folder;
  folder.write("f0.yaml", "a: 1\nlist: [{name: x, b: 2}]\n");
  for (int i = 1; i <= 30; ++i) folder.write("f" + std::to_string(i) + ".yaml", "include: [f" + std::to_string(i - 1) + ".yaml, f" + std::to_string(i - 1) + ".yaml]\n");
  const Value v = parse_file((folder.root / "f30.yaml").string());  // 2^30 times, one by one
  CHECK(v.find("a")->text == "1");
  CHECK(v.find("list")->items.size() == 1);
}

TEST_CASE("a character beyond U+FFFF may be one escape or JSON's two") {
  const std::string smile = "\xf0\x9f\x98\x80";
  for (const char* text : {"\"\\ud83d\\ude00\"", "\"\\uD83D\\uDE00\"", "\"\\U0001f600\"", "\"\xf0\x9f\x98\x80\""}) {
    INFO(text);
    CHECK(parse_string("a: " + std::string(text), "s.yaml").find("a")->text == smile);
  }
  CHECK(parse_string("a: \"\\\\ud83d\\\\ude00\"", "s.yaml").find("a")->text == "\\ud83d\\ude00");  // backslashes
  CHECK(parse_string("a: \"x\\u00e9\"", "s.yaml").find("a")->text == "x\xc3\xa9");
  CHECK(parse_error("a: \"\\ud83d\"").find("s.yaml:1:") == 0);
}
