#include "formats/pstrip/text/text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <random>

#include "formats/pstrip/payload/check.h"
#include "formats/pstrip/text/face_finder.h"
#include "tests/support/paths.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

constexpr std::string_view kExchanged =
    "which texture coordinates go with which of several faces on the same vertices";

std::string written(const ProgressiveStrips& strips) {
  const auto file = write_text(strips);
  EXPECT_TRUE(file) << file.error().message;
  return file ? std::string(as_text(file->bytes)) : std::string();
}

std::vector<std::string> dropped(const ProgressiveStrips& strips) {
  const auto file = write_text(strips);
  EXPECT_TRUE(file) << file.error().message;
  return file ? file->dropped : std::vector<std::string>();
}
bool is_dropped(const ProgressiveStrips& strips, std::string_view phrase) {
  return std::ranges::any_of(dropped(strips), [&](const auto& p) { return p == phrase; });
}

using Corner = std::vector<std::uint64_t>;  // bits of its numbers
using Soup = std::vector<std::array<Corner, 3>>;

/// All triangles as what their corners show, in an order that only depends on that.
Soup soup_of(const std::vector<Mesh>& meshes, bool texture) {
  Soup out;
  for (const Mesh& mesh : meshes) {
    const Attribute* uv = nullptr;
    for (const Attribute& a : mesh.wedge_attributes)
      if (texture && a.semantic == "TEXCOORD_0") uv = &a;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      std::array<Corner, 3> triangle;
      for (std::size_t k = 0; k < 3; ++k) {
        const Index wedge = mesh.face(f)[k];
        for (std::size_t c = 0; c < 3; ++c)
          triangle[k].push_back(
              std::bit_cast<std::uint64_t>(component(mesh.position, mesh.vertex_of(wedge), c)));
        for (std::size_t c = 0; uv != nullptr && c < 2; ++c)
          triangle[k].push_back(std::bit_cast<std::uint64_t>(component(*uv, wedge, c)));
      }
      std::ranges::rotate(triangle, std::ranges::min_element(triangle));
      out.push_back(triangle);
    }
  }
  std::ranges::sort(out);
  return out;
}

/// The triangles of the strips alone after `vsplits` records.
Mesh level_of(ProgressiveMesh mesh, std::size_t vsplits) {
  mesh.faces = {};
  return test::decode_slowly(mesh, vsplits);
}

/// The first lines with at most `vsplits` records, the header aside.
std::string cut_after(const std::string& text, std::size_t vsplits) {
  std::string out;
  for (std::size_t at = text.find('\n') + 1; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    if (text[at] == 's' && vsplits-- == 0) break;
    out += text.substr(at, end - at);
    at = end;
  }
  return out;
}

TEST(Text, CarriesTheTrianglesOfEveryLevel) {
  for (std::uint32_t seed = 0; seed < 200; ++seed) {
    SCOPED_TRACE(seed);
    test::ProgressiveOptions options;
    options.vsplits = 12;
    options.encoding = static_cast<MapEncoding>(seed & 1);
    options.placement = static_cast<Placement>(seed >> 1 & 1);
    options.single_wedges = (seed & 4) != 0;
    ProgressiveStrips strips = test::random_progressive(seed, options);
    const ProgressiveMesh& mesh = strips.meshes[0];
    const bool textured = std::ranges::find(mesh.wedge_attributes, "TEXCOORD_0",
                                            &Attribute::semantic) != mesh.wedge_attributes.end() &&
                          !is_dropped(strips, kExchanged);
    std::string text = written(strips);
    const std::string type(name_of(mesh.position.type));
    for (std::size_t k = 0; k <= mesh.vsplits.size(); ++k) {
      SCOPED_TRACE(k);
      // The type must go with the lines, the counts must not.
      const std::string cut =
          "# pstrips text 1.0 vertices=" + std::to_string(mesh.base_vertices + k) +
          " faces=" + std::to_string(level_of(mesh, k).face_count()) +
          " vsplits=" + std::to_string(k) + " position=" + type + "\n" + cut_after(text, k);
      const auto read = read_text(as_bytes(cut));
      ASSERT_TRUE(read) << read.error().message << " " << read.error().path << "\n" << cut;
      EXPECT_EQ(find_inconsistency(read->mesh), "");
      EXPECT_EQ(read->mesh.position.data, level_of(mesh, k).position.data);
      EXPECT_EQ(soup_of({read->mesh}, textured), soup_of({level_of(mesh, k)}, textured)) << cut;
    }
  }
}

TEST(Text, CarriesCollapsesAndWhereVerticesMove) {
  for (std::uint32_t seed = 0; seed < 50; ++seed) {
    SCOPED_TRACE(seed);
    const Placement placement = seed % 2 == 0 ? Placement::optimal : Placement::subset;
    const ProgressiveStrips strips = test::random_progressive(seed, {.placement = placement});
    const ProgressiveMesh& mesh = strips.meshes[0];
    const auto read = read_text(as_bytes(written(strips)));
    ASSERT_TRUE(read) << read.error().message;
    ASSERT_EQ(read->collapses.size(), mesh.vsplits.size());
    EXPECT_EQ(read->kept_position.empty(), placement == Placement::subset);
    Bytes positions = read->mesh.position.data;
    const std::size_t bytes = mesh.position.element_bytes();
    for (std::size_t i = 0; i < read->collapses.size(); ++i) {
      const TextCollapse& collapse = read->collapses[i];
      const Vsplit& split = mesh.vsplits[mesh.vsplits.size() - 1 - i];
      EXPECT_EQ(collapse.removed + 1, positions.size() / bytes);
      EXPECT_EQ(collapse.kept, split.parent == collapse.removed ? kNone : split.parent);
      if (!read->kept_position.empty() && collapse.kept != kNone)
        std::memcpy(positions.data() + collapse.kept * bytes,
                    read->kept_position.data() + i * bytes, bytes);
      positions.resize(positions.size() - bytes);
    }
    EXPECT_EQ(positions, level_of(mesh, 0).position.data);
  }
}

TEST(Text, JoinsMeshes) {
  for (std::uint32_t seed = 0; seed < 100; ++seed) {
    SCOPED_TRACE(seed);
    ProgressiveStrips strips = test::random_progressive_of_any_kind(seed);
    if (std::ranges::find(strips.meshes, MapEncoding::triangles, &ProgressiveMesh::encoding) !=
        strips.meshes.end())
      continue;
    const auto read = read_text(as_bytes(written(strips)));
    ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
    std::vector<Mesh> levels;
    bool textured = !is_dropped(strips, kExchanged);
    for (const ProgressiveMesh& mesh : strips.meshes) {
      levels.push_back(level_of(mesh, mesh.vsplits.size()));
      textured = textured && std::ranges::find(mesh.wedge_attributes, "TEXCOORD_0",
                                               &Attribute::semantic) != mesh.wedge_attributes.end();
    }
    EXPECT_EQ(soup_of({read->mesh}, textured), soup_of(levels, textured));
    EXPECT_EQ(is_dropped(strips, "that there are several meshes: they are joined"),
              strips.meshes.size() > 1);
  }
}

/// A square of two strips' triangles that one vsplit makes of a triangle.
ProgressiveStrips square(bool texture) {
  ProgressiveStrips strips;
  ProgressiveMesh& mesh = strips.meshes.emplace_back();
  const float corners[] = {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0.5};
  const auto bytes = std::as_bytes(std::span(corners));
  mesh.position = {"POSITION", ComponentType::f32, 3, false, Bytes(bytes.begin(), bytes.end())};
  if (texture) {
    const float uv[] = {0, 0, 1, 0, 0, 1, 1, 1};
    const auto data = std::as_bytes(std::span(uv));
    mesh.wedge_attributes = {
        {"TEXCOORD_0", ComponentType::f32, 2, false, Bytes(data.begin(), data.end())}};
  }
  mesh.groups.resize(1);
  mesh.base_map = {0, 1, 2, 1};
  mesh.group_entries = {4};
  mesh.base_vertices = mesh.base_wedges = 3;
  mesh.vsplits = {{1, 1, 0, 1}};
  mesh.wedge_offset_counts = {1};
  mesh.map_offsets = {3};
  mesh.vertices = mesh.wedges = 4;
  mesh.triangles = 2;
  mesh.strips = 1;
  strips.bases = {{.vertices = 3, .triangles = 1, .strips = 1, .error = 1}};
  strips.packets = {{.vsplits = 1, .vertices = 4, .triangles = 2, .strips = 1}};
  return strips;
}

TEST(Text, RefusesMapsOfTriangles) {
  ProgressiveStrips strips = test::random_progressive(1, {.meshes = 2});
  strips.meshes[1] =
      test::random_progressive(2, {.encoding = MapEncoding::triangles}).meshes.front();
  const auto text = write_text(strips);
  ASSERT_FALSE(text);
  EXPECT_EQ(text.error().code, ErrorCode::bad_argument);
  EXPECT_EQ(text.error().path, "/meshes/1");
}

TEST(Text, WritesTheRecordOfThePaper) {
  EXPECT_EQ(written(square(false)),
            "# pstrips text 1.0 vertices=4 faces=2 vsplits=1 position=f32\n"
            "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
            "f 1 2 3\n"
            "s 2 1 0 0 4 1 1 0.5 1 3 2 4 0 0 0 0\n");
  ProgressiveStrips textured = square(true);
  // The first triangle goes to the new vertex, so its texture coordinates change; the second one
  // is new and needs those of the parent.
  textured.meshes[0].map_offsets = {1};
  EXPECT_EQ(written(textured),
            "# pstrips text 1.0 vertices=4 faces=2 vsplits=1 position=f32 texture=f32\n"
            "v 0 0 0\nv 1 0 0\nv 0 1 0\n"
            "vt 0 0\nvt 1 0\nvt 0 1\n"
            "f 1/1 2/2 3/3\n"
            "s 2 1 0 0 4 1 1 0.5 1 3 4 2 1 1 2 3 1 3 2 4 1 4 1 0 1 2 1 1\n");
}

TEST(Text, SaysWhatItDrops) {
  using List = std::vector<std::string>;
  EXPECT_EQ(dropped(square(true)), List{"triangle strips, packets and errors of levels"});
  ProgressiveStrips strips = test::random_progressive(5, {.single_wedges = false,
                                                          .scene = true,
                                                          .faces = true,
                                                          .order = true,
                                                          .digest = true,
                                                          .unknown = true});
  for (const char* phrase :
       {"scene nodes", "materials", "images", "what the source format keeps for itself",
        "chunks that nobody knows", "names of meshes", "groups", "names of groups",
        "face attribute _FACE_ID", "original order", "digest", "1 lines", "1 points",
        "1 degenerate faces"})
    EXPECT_TRUE(is_dropped(strips, phrase)) << phrase;
}

struct BadText {
  const char* name;
  const char* text;
  ErrorCode code;
  const char* path;
};

const BadText kBadTexts[] = {
    {"word", "g x\n", ErrorCode::corrupt, "line 1"},
    {"cut_number", "v 0 0 1", ErrorCode::truncated, "line 1"},
    {"cut_line", "v 0 0\n", ErrorCode::truncated, "line 2"},
    {"not_a_number", "v 0 0 x\n", ErrorCode::corrupt, "line 1"},
    {"too_few_numbers", "v 0 0\nv 0 0 0\n", ErrorCode::corrupt, "line 2"},
    {"face_past_end", "v 0 0 0\nf 1 1 2\n", ErrorCode::corrupt, "line 2"},
    {"face_zero", "v 0 0 0\nf 0 1 1\n", ErrorCode::corrupt, "line 2"},
    {"face_texture_past_end", "v 0 0 0\nf 1/1 1/1 1/1\n", ErrorCode::corrupt, "line 2"},
    {"face_with_and_without", "v 0 0 0\nvt 0 0\nf 1/1 1 1\n", ErrorCode::corrupt, "line 3"},
    {"base_after_record", "v 0 0 0\ns 1 0 0 0 2 0 0 0 0 0 0 0 0\nv 0 0 0\n", ErrorCode::corrupt,
     "line 3"},
    {"parent_past_end", "v 0 0 0\ns 3 0 0 0 2 0 0 0 0 0 0 0 0\n", ErrorCode::corrupt, "line 2"},
    {"new_vertex_not_next", "v 0 0 0\ns 1 0 0 0 1 0 0 0 0 0 0 0 0\n", ErrorCode::corrupt, "line 2"},
    {"no_such_face", "v 0 0 0\ns 1 0 0 0 2 0 0 0 0 1 1 1 1 0 0 0\n", ErrorCode::corrupt, "line 2"},
    {"face_elsewhere", "v 0 0 0\nv 0 0 0\nf 2 2 2\ns 1 0 0 0 3 0 0 0 0 1 2 2 2 0 0 0\n",
     ErrorCode::corrupt, "line 4"},
    {"texture_without_face", "v 0 0 0\ns 1 0 0 0 2 0 0 0 0 0 1 1 1 1 0 0\n", ErrorCode::corrupt,
     "line 2"},
    {"texture_past_end", "v 0 0 0\ns 1 0 0 0 2 0 0 0 1 1 2 1 0 1 1 1 2 1 1 0 0 0\n",
     ErrorCode::corrupt, "line 2"},
    {"texture_not_next", "v 0 0 0\ns 1 0 0 0 2 0 0 0 0 0 0 1 2 0 0 0\n", ErrorCode::corrupt,
     "line 2"},
    {"promise_of_faces", "v 0 0 0\ns 1 0 0 0 2 0 0 0 4000000000 1 1 1\n", ErrorCode::truncated,
     "line 3"},
    {"count_past_32_bits", "v 0 0 0\ns 1 0 0 0 2 0 0 0 5000000000 1 1 1\n", ErrorCode::corrupt,
     "line 2"},
    {"fewer_than_announced", "# pstrips text 1.0 vertices=2 faces=0 vsplits=0\nv 0 0 0\n",
     ErrorCode::truncated, "line 3"},
    {"more_than_announced", "# pstrips text 1.0 vertices=0 faces=0 vsplits=0\nv 0 0 0\n",
     ErrorCode::corrupt, "line 3"},
    {"version", "# pstrips text 2.0\n", ErrorCode::unsupported, "line 1"},
    {"header_word", "# pstrips text 1.0 colour=red\n", ErrorCode::corrupt, "line 1"},
};

TEST(Text, RejectsBadFilesWithCodeAndLine) {
  for (const BadText& file : kBadTexts) {
    SCOPED_TRACE(file.name);
    const auto read = read_text(as_bytes(file.text));
    EXPECT_FALSE(read);
    if (read) continue;
    EXPECT_EQ(read.error().code, file.code) << read.error().message;
    EXPECT_EQ(read.error().path, file.path) << read.error().message;
    EXPECT_NE(read.error().offset, kNoOffset);
  }
}

TEST(Text, RejectsEveryPrefix) {
  const std::string text = written(test::random_progressive(3, {.single_wedges = false}));
  const std::size_t header = text.find('\n') + 1;
  for (std::size_t size = header; size < text.size(); ++size) {
    const std::vector<std::byte> cut(as_bytes(text).begin(),
                                     as_bytes(text).begin() + static_cast<std::ptrdiff_t>(size));
    const auto read = read_text(cut);
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().code, ErrorCode::truncated) << size << " " << read.error().message;
  }
}

TEST(Text, SurvivesMutations) {
  std::mt19937 random(17);
  const std::string good = written(test::random_progressive(3, {.single_wedges = false}));
  int accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = good;
    for (std::size_t n = 1 + random() % 2; n > 0; --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 3) {
        case 0:
          text[at] = "0123456789 \n/.-sfvtNaI\0"[random() % 23];
          break;
        case 1:
          text.erase(at, random() % 10);
          break;
        default:
          text.insert(at, text.substr(random() % text.size(), random() % 10));
          break;
      }
    }
    const auto read = read_text(as_bytes(text));
    if (!read) continue;
    ++accepted;
    EXPECT_EQ(find_inconsistency(read->mesh), "");
  }
  EXPECT_GT(accepted, 0);
}

TEST(Text, ReadsFilesOfOtherWriters) {
  // No header, white space at will, faces named from any corner.
  const auto read =
      read_text(as_bytes("# made elsewhere\nv 0 0 0\nv 1 0 0\n\nv 0 1 0\r\nf 3 1 2\n"
                         "s 2 1 0 0\n  4 1 1 0.5\n  1 3 2 4\n  1 1 2 3\n  0\n  0\n  0\n"));
  ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
  EXPECT_EQ(read->mesh.corners, (std::vector<Index>{2, 0, 3, 2, 1, 3}));
  EXPECT_EQ(read->collapses, (std::vector<TextCollapse>{{3, 1}}));
}

TEST(Text, RefusesTheBinaryFormatOfTheSameName) {
  const std::string hoppe = "# Created by a tool\n# more\nPM\nversion=2\nnvsplits=1 \xff\x01";
  const auto read = read_text(as_bytes(hoppe));
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::unsupported);
  EXPECT_FALSE(looks_like_hoppe_pm(as_bytes(written(square(false)))));
  EXPECT_FALSE(looks_like_hoppe_pm(as_bytes("#")));
  EXPECT_FALSE(looks_like_hoppe_pm({}));
  EXPECT_TRUE(looks_like_text(as_bytes(written(square(false)))));
  EXPECT_FALSE(looks_like_text(as_bytes(hoppe)));
}

TEST(Text, LimitsAreAnswersOfTheirOwn) {
  const std::string text = written(square(true));
  const auto code = [&](auto set) {
    Limits limits;
    set(limits);
    const auto read = read_text(as_bytes(text), limits);
    return read ? std::optional<ErrorCode>() : read.error().code;
  };
  EXPECT_EQ(code([](Limits&) {}), std::nullopt);
  EXPECT_EQ(code([](Limits& l) { l.vertices = 3; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.corners = 5; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.memory_bytes = 1000; }), ErrorCode::over_limit);
}

TEST(Text, RefusesRecordsThatChangeForeignEntries) {
  ProgressiveStrips strips = square(false);
  strips.meshes[0].map_offsets = {0};
  const auto file = write_text(strips);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::corrupt);
  EXPECT_EQ(file.error().path, "/meshes/0/vsplits/0");
}

TEST(Text, WritesWhatItCanReadOrNothing) {
  std::mt19937 random(23);
  int written_files = 0, refused = 0;
  for (std::uint32_t i = 0; i < 3000; ++i) {
    SCOPED_TRACE(i);
    ProgressiveStrips strips = test::random_progressive(
        i % 50, {.encoding = static_cast<MapEncoding>(i & 1), .single_wedges = (i & 2) != 0});
    ProgressiveMesh& mesh = strips.meshes[0];
    const auto change = [&](std::vector<Index>& list, Index below) {
      if (!list.empty() && below > 0)
        list[random() % list.size()] = static_cast<Index>(random() % below);
    };
    switch (random() % 5) {
      case 0:
        mesh.vsplits[random() % mesh.vsplits.size()].parent = static_cast<Index>(random() % 8);
        break;
      case 1:
        change(mesh.map_offsets, static_cast<Index>(mesh.base_map.size()));
        break;
      case 2:
        change(mesh.reassigned, mesh.wedges);
        break;
      case 3:
        change(mesh.base_wedge_vertex, mesh.base_vertices);
        break;
      default:
        change(mesh.base_map, mesh.base_wedges);
        break;
    }
    if (!check(strips)) continue;
    const auto file = write_text(strips);
    if (!file) {
      EXPECT_EQ(file.error().code, ErrorCode::corrupt);
      ++refused;
      continue;
    }
    ++written_files;
    const auto read = read_text(file->bytes);
    EXPECT_TRUE(read) << read.error().message << " " << read.error().path;
  }
  EXPECT_GT(written_files, 0);
  EXPECT_GT(refused, 0);
}

TEST(Text, RefusesFilesOfHoppesLibrary) {
  std::vector<std::string> files = {
      std::string(
          "# |||o sphere\n# ||Created by a filter\nPM\nversion=2\nnvsplits=2 nvertices=6\n") +
          std::string("PM base mesh:\n\0\0\0\4\xff\r\n", 21),
      "PM\nversion=2\n"};
  if (const auto real = test::model_path("classic/spheretext.pm")) {
    std::ifstream in(*real, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  for (const std::string& file : files) {
    const auto read = read_text(as_bytes(file));
    ASSERT_FALSE(read);
    EXPECT_EQ(read.error().code, ErrorCode::unsupported);
  }
}

/// One entry that all others of a fan repeat, and vsplits that rewrite it again and again: each of
/// n records changes n faces.
TEST(Text, RefusesQuadraticRecords) {
  constexpr Index kSize = 3000;
  ProgressiveStrips strips = square(false);
  ProgressiveMesh& mesh = strips.meshes[0];
  mesh.encoding = MapEncoding::offset;
  mesh.base_map.assign(1, 0);
  for (Index i = 0; i < kSize; ++i)
    mesh.base_map.insert(mesh.base_map.end(), {1 + i % 2, kSameAsMinus2});
  mesh.group_entries = {static_cast<Index>(mesh.base_map.size())};
  mesh.position.data.resize((3 + kSize) * 12);
  mesh.vsplits.clear();
  for (Index i = 0; i < kSize; ++i) mesh.vsplits.push_back({i == 0 ? 0 : 2 + i, 1, 0, 1});
  mesh.wedge_offset_counts.assign(kSize, 1);
  mesh.map_offsets.assign(kSize, 0);
  mesh.vertices = mesh.wedges = 3 + kSize;
  strips.packets[0].vsplits = kSize;
  Limits limits;
  limits.memory_bytes = 10'000'000;
  const auto file = write_text(strips, limits);
  ASSERT_FALSE(file);
  EXPECT_EQ(file.error().code, ErrorCode::over_limit);
}

TEST(FaceFinder, FindsTheLastOfSeveral) {
  FaceFinder finder(1);
  finder.insert(0, {3, 1, 2});
  finder.insert(1, {1, 2, 3});
  finder.insert(2, {1, 3, 2});
  EXPECT_EQ(finder.take({2, 3, 1}), 1u);
  EXPECT_EQ(finder.take({2, 3, 1}), 0u);
  EXPECT_EQ(finder.take({2, 3, 1}), kNone);
  EXPECT_EQ(finder.take({3, 2, 1}), 2u);
}

TEST(FaceFinder, AgreesWithASlowOne) {
  std::mt19937 random(3);
  FaceFinder finder(7);
  std::vector<std::pair<Index, FaceFinder::Triangle>> slow;
  for (Index i = 0; i < 20000; ++i) {
    const auto any = [&] { return static_cast<Index>(random() % 6); };
    const FaceFinder::Triangle t = {any(), any(), any()};
    const auto same = [&](const auto& entry) {
      const auto& u = entry.second;
      return u == t || u == FaceFinder::Triangle{t[1], t[2], t[0]} ||
             u == FaceFinder::Triangle{t[2], t[0], t[1]};
    };
    if (random() % 2 == 0) {
      finder.insert(i, t);
      slow.emplace_back(i, t);
      continue;
    }
    const auto found = std::find_if(slow.rbegin(), slow.rend(), same);
    EXPECT_EQ(finder.take(t), found == slow.rend() ? kNone : found->first);
    if (found != slow.rend()) slow.erase(std::next(found).base());
  }
}

}  // namespace
}  // namespace pstrips
