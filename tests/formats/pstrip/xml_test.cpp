#include "formats/pstrip/xml/xml.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <limits>
#include <random>

#include "formats/pstrip/numbers.h"
#include "formats/pstrip/xml/xml_text.h"
#include "tests/support/paths.h"
#include "tests/support/progressive.h"

namespace pstrips {
namespace {

constexpr std::uint32_t kSeeds = 200;

std::string text_of(const ProgressiveStrips& strips) {
  return std::string(as_text(write_xml(strips)));
}
Result<ProgressiveStrips> read_text(std::string_view text, const Limits& limits = {}) {
  return read_xml(as_bytes(text), limits);
}

/// The document of a small mesh with all kinds of parts.
ProgressiveStrips small_strips() {
  return test::random_progressive(7, {.base_vertices = 4,
                                      .vsplits = 3,
                                      .single_wedges = false,
                                      .scene = true,
                                      .faces = true,
                                      .order = true,
                                      .digest = true,
                                      .unknown = true});
}

std::string replaced(std::string text, std::string_view from, std::string_view to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

TEST(Xml, GivesTheSameStripsBack) {
  for (std::uint32_t seed = 0; seed < kSeeds; ++seed) {
    SCOPED_TRACE(seed);
    const ProgressiveStrips strips = test::random_progressive_of_any_kind(seed);
    const std::string text = text_of(strips);
    const auto read = read_text(text);
    ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
    EXPECT_EQ(*read, strips);
    EXPECT_EQ(text_of(*read), text);
  }
}

TEST(Xml, GivesIncompleteStripsBack) {
  ProgressiveStrips strips = test::random_progressive(3, {.packet_vsplits = 2});
  ProgressiveMesh& mesh = strips.meshes[0];
  // What a reader of the binary variant leaves when the file ends after the first packet.
  strips.complete = false;
  strips.packets.resize(1);
  mesh.vsplits.resize(2);
  mesh.wedge_offset_counts.resize(2);
  mesh.map_offsets.resize(mesh.vsplits[0].map_offsets + mesh.vsplits[1].map_offsets);
  mesh.position.data.resize((mesh.base_vertices + 2) * mesh.position.element_bytes());
  for (Attribute& a : mesh.wedge_attributes)
    a.data.resize((mesh.base_wedges + 2) * a.element_bytes());
  const auto read = read_text(text_of(strips));
  ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
  EXPECT_EQ(*read, strips);
}

TEST(Xml, KeepsEveryBitOfNumbers) {
  ProgressiveStrips strips = test::random_progressive(1, {.base_vertices = 4, .vsplits = 3});
  Attribute& position = strips.meshes[0].position;
  std::mt19937 random(42);
  for (const ComponentType type :
       {ComponentType::i8, ComponentType::u8, ComponentType::i16, ComponentType::u16,
        ComponentType::i32, ComponentType::u32, ComponentType::f32, ComponentType::f64}) {
    SCOPED_TRACE(name_of(type));
    position.type = type;
    position.count = 200;
    position.data.resize(7 * position.element_bytes());
    for (std::byte& b : position.data) b = static_cast<std::byte>(random());
    const auto read = read_text(text_of(strips));
    ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
    EXPECT_EQ(read->meshes[0].position, position);
  }
}

TEST(Xml, WritesNumbersThatPeopleCanRead) {
  const auto written = [](auto v) {
    TextWriter out;
    out.real(v);
    return std::string(as_text(std::move(out).take()));
  };
  EXPECT_EQ(written(0.1f), "0.1");
  EXPECT_EQ(written(-0.0f), "-0");
  EXPECT_EQ(written(1e-45f), "1e-45");
  EXPECT_EQ(written(1e300), "1e+300");
  EXPECT_EQ(written(std::numeric_limits<float>::infinity()), "INF");
  EXPECT_EQ(written(-std::numeric_limits<double>::infinity()), "-INF");
  EXPECT_EQ(written(std::bit_cast<float>(0x7fc00000u)), "NaN");
  EXPECT_EQ(written(std::bit_cast<float>(0x7fc00001u)), "nan:0x7fc00001");
  EXPECT_EQ(written(std::bit_cast<float>(0xffc00000u)), "nan:0xffc00000");
  EXPECT_EQ(written(std::bit_cast<double>(0x7ff8000000000000u)), "NaN");
  EXPECT_EQ(written(std::bit_cast<double>(0x7ff0000000000001u)), "nan:0x7ff0000000000001");
}

TEST(Xml, RefusesWhatIsNoNumber) {
  for (const char* token :
       {"", "-", "nan", "inf", "infinity", "Infinity", "1.5x", "0x10", "1e", "--1", "+-1", "1e999",
        "1e-999", "nan:0x7fc0000", "nan:0x3f800000", "nan:0x7fc000001"}) {
    float f = 0;
    EXPECT_FALSE(parse_number(token, f)) << token;
  }
  for (const char* token : {"", "-1", "+1", "4294967296", "1.0", " 1"}) {
    std::uint32_t n = 0;
    EXPECT_FALSE(parse_number(token, n)) << token;
  }
  std::byte at{};
  EXPECT_FALSE(parse_component("256", ComponentType::u8, &at));
  EXPECT_FALSE(parse_component("-129", ComponentType::i8, &at));
}

TEST(Xml, KeepsStringsOfAnyBytes) {
  std::string all;
  for (int i = 0; i < 256; ++i) all.push_back(static_cast<char>(i));
  ProgressiveStrips strips = small_strips();
  for (const std::string& name :
       {all, std::string("a\\x41"), std::string("\\"), std::string(" <&>\"' \t\n\r\n "),
        std::string("ż\xef\xbf\xbf\xed\xa0\x80\xf4\x90\x80\x80\xc0\x80\xe2\x82"), std::string()}) {
    strips.generator = name;
    strips.meshes[0].name = name;
    strips.scene.images[0].uri = name;
    const auto read = read_text(text_of(strips));
    ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
    EXPECT_EQ(*read, strips);
  }
}

TEST(Xml, KeepsForeignDataOfAnyBytes) {
  std::mt19937 random(5);
  ProgressiveStrips strips = small_strips();
  strips.scene.foreign.clear();
  const auto add = [&](std::string_view data) {
    const ByteView bytes = as_bytes(data);
    strips.scene.foreign.push_back(
        {"ply/" + std::to_string(strips.scene.foreign.size()), Bytes(bytes.begin(), bytes.end())});
  };
  for (const char* text :
       {"", " ", "\n\n", "\n text \n", "a\rb", "<!-- ]]> &amp; -->", "\\x00", "żółć", "\xff"})
    add(text);
  for (std::size_t size = 0; size < 200; ++size) {
    std::string data(size, '\0');
    for (char& c : data) c = static_cast<char>(random());
    add(data);
  }
  const auto read = read_text(text_of(strips));
  ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
  EXPECT_EQ(*read, strips);
}

TEST(Xml, RejectsEveryPrefix) {
  const std::string text = text_of(small_strips());
  const std::size_t whole = text.rfind('>') + 1;
  for (std::size_t size = 0; size < whole; ++size) {
    const std::vector<std::byte> cut(as_bytes(text).begin(),
                                     as_bytes(text).begin() + static_cast<std::ptrdiff_t>(size));
    const auto read = read_xml(cut);
    ASSERT_FALSE(read) << size;
    EXPECT_EQ(read.error().code, ErrorCode::truncated) << size << " " << read.error().message;
  }
  EXPECT_TRUE(read_text(text.substr(0, whole)));
}

TEST(Xml, SurvivesMutations) {
  std::mt19937 random(11);
  const std::string good = text_of(small_strips());
  int accepted = 0;
  for (int i = 0; i < 4000; ++i) {
    std::string text = good;
    for (std::size_t n = 1 + random() % 3; n > 0; --n) {
      const std::size_t at = random() % text.size();
      switch (random() % 4) {
        case 0:
          text[at] = static_cast<char>(random());
          break;
        case 1:
          text.erase(at, random() % 40);
          break;
        case 2:
          text.insert(at, text.substr(random() % text.size(), random() % 40));
          break;
        default:
          text[at] = "0123456789<>/\"&;-|R "[random() % 20];
          break;
      }
    }
    const auto read = read_text(text);
    if (!read) {
      EXPECT_FALSE(read.error().message.empty());
      EXPECT_NE(read.error().fault, Fault::none) << read.error().message;
      continue;
    }
    ++accepted;
    const auto again = read_text(text_of(*read));
    ASSERT_TRUE(again) << again.error().message << " " << again.error().path;
    EXPECT_EQ(*again, *read);
  }
  EXPECT_GT(accepted, 0);
}

struct BadEdit {
  const char* name;
  const char* from;
  const char* to;
  ErrorCode code;
  Fault fault;
};

const BadEdit kBadEdits[] = {
    {"dtd", "<pstrips", "<!DOCTYPE pstrips [<!ENTITY a \"b\">]><pstrips", ErrorCode::corrupt,
     Fault::xml_declaration},
    {"entity", "generator=\"", "generator=\"&lol;", ErrorCode::corrupt, Fault::xml_malformed},
    {"character_reference", "generator=\"", "generator=\"&#0;", ErrorCode::corrupt,
     Fault::xml_malformed},
    {"control_character", "generator=\"", "generator=\"\x01", ErrorCode::corrupt,
     Fault::xml_malformed},
    {"not_utf8", "generator=\"", "generator=\"\xff", ErrorCode::corrupt, Fault::xml_malformed},
    {"backslash", "generator=\"", "generator=\"\\n", ErrorCode::corrupt, Fault::xml_backslash},
    {"xml_version", "xml version=\"1.0\"", "xml version=\"1.1\"", ErrorCode::unsupported,
     Fault::xml_unsupported},
    {"encoding", "UTF-8", "ISO-8859-2", ErrorCode::unsupported, Fault::xml_unsupported},
    {"instruction", "<pstrips", "<?php ?><pstrips", ErrorCode::corrupt, Fault::xml_declaration},
    {"other_root", "<pstrips", "<!-- --><x/><pstrips", ErrorCode::corrupt, Fault::xml_malformed},
    {"end_tag", "</scene>", "</scenes>", ErrorCode::corrupt, Fault::xml_malformed},
    {"attribute_twice", "generator=", "generator=\"\" generator=", ErrorCode::corrupt,
     Fault::xml_malformed},
    {"attribute_unknown", "generator=", "more=\"\" generator=", ErrorCode::corrupt,
     Fault::xml_schema},
    {"attribute_missing", "profile=\"plain\"", "", ErrorCode::corrupt, Fault::xml_schema},
    {"attribute_of_next_version", "version=\"2.2\" profile", "version=\"2.3\" x=\"\" profile",
     ErrorCode::unsupported, Fault::xml_unsupported},
    {"attribute_of_no_version", "version=\"2.2\" profile", "version=\"2.2\" x=\"\" profile",
     ErrorCode::corrupt, Fault::xml_schema},
    {"version", "version=\"2.2\" profile", "version=\"1.0\" profile", ErrorCode::unsupported,
     Fault::version_unknown},
    {"next_version", "version=\"2.2\" profile", "version=\"3.0\" profile", ErrorCode::unsupported,
     Fault::version_unknown},
    {"version_malformed", "version=\"2.2\" profile", "version=\"2\" profile", ErrorCode::corrupt,
     Fault::xml_schema},
    {"profile", "profile=\"plain\"", "profile=\"compressed\"", ErrorCode::unsupported,
     Fault::profile_unknown},
    {"element_unknown", "<map>", "<maps/><map>", ErrorCode::corrupt, Fault::xml_schema},
    {"element_missing", "<position ", "<wedge_attribute ", ErrorCode::corrupt, Fault::xml_schema},
    {"text_between", "<mesh ", "x<mesh ", ErrorCode::corrupt, Fault::xml_schema},
    {"encoding_word", "encoding=\"naive\"", "encoding=\"other\"", ErrorCode::corrupt,
     Fault::value_undefined},
    {"wedge_past_end", "<map>4", "<map>4000", ErrorCode::corrupt, Fault::map_entry},
    {"map_longer_than_groups", "<map>", "<map>0 ", ErrorCode::corrupt, Fault::group_entries},
    {"symbol_in_naive_map", "<map>4", "<map>R+1", ErrorCode::corrupt, Fault::map_symbol},
    {"map_word", "<map>", "<map>R+3 ", ErrorCode::corrupt, Fault::xml_number},
    {"map_reserved", "<map>", "<map>4294967291 ", ErrorCode::corrupt, Fault::xml_number},
    {"position_more", "<positions>", "<positions>0 ", ErrorCode::corrupt, Fault::xml_list_length},
    {"position_word", "<positions>", "<positions>x", ErrorCode::corrupt, Fault::xml_number},
    {"parent_past_end", "<vsplit parent=\"", "<vsplit parent=\"9", ErrorCode::corrupt,
     Fault::parent_not_there},
    {"node_parent_past_end", "parent=\"", "parent=\"9", ErrorCode::corrupt, Fault::node_parent},
    {"offset_past_end", "map_offsets=\"", "map_offsets=\"99999 ", ErrorCode::corrupt,
     Fault::offset_past_end},
    {"vsplit_count", "first_vsplit=\"0\" vsplits=\"2\"", "first_vsplit=\"0\" vsplits=\"1\"",
     ErrorCode::corrupt, Fault::xml_packet_vsplits},
    {"digest_algorithm", "SHA-256", "MD5", ErrorCode::unsupported, Fault::digest_unknown},
    {"huge_count", "vertices=\"7\"", "vertices=\"4294967040\"", ErrorCode::over_limit,
     Fault::over_limit},
    {"count_past_32_bits", "vertices=\"7\"", "vertices=\"4294967296\"", ErrorCode::corrupt,
     Fault::xml_number},
};

TEST(Xml, RejectsBadEditsWithCodeAndPlace) {
  const std::string good = text_of(small_strips());
  ASSERT_TRUE(read_text(good));
  for (const BadEdit& edit : kBadEdits) {
    SCOPED_TRACE(edit.name);
    const auto read = read_text(replaced(good, edit.from, edit.to));
    EXPECT_FALSE(read);
    if (read) continue;
    EXPECT_EQ(read.error().code, edit.code) << read.error().message << " " << read.error().path;
    EXPECT_EQ(read.error().fault, edit.fault) << read.error().message << " " << read.error().path;
    EXPECT_TRUE(read.error().path.starts_with("line ")) << read.error().path;
    EXPECT_NE(read.error().offset, kNoOffset);
  }
}

TEST(Xml, SaysLineAndElement) {
  const std::string good = text_of(small_strips());
  const std::string bad = replaced(good, "<vsplit parent=\"", "<vsplit parent=\"x");
  const std::size_t at = bad.find("<vsplit");
  const auto line =
      1 + std::count(bad.begin(), bad.begin() + static_cast<std::ptrdiff_t>(at), '\n');
  const auto read = read_text(bad);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().path,
            "line " + std::to_string(line) + ", /pstrips/packet[0]/vsplit[0]/@parent");
  EXPECT_EQ(read.error().offset, bad.rfind('\n', at) + 1);
}

TEST(Xml, LimitsAreAnswersOfTheirOwn) {
  const std::string good = text_of(small_strips());
  const auto code = [&](auto set) {
    Limits limits;
    set(limits);
    const auto read = read_text(good, limits);
    return read ? std::optional<ErrorCode>() : read.error().code;
  };
  EXPECT_EQ(code([](Limits&) {}), std::nullopt);
  EXPECT_EQ(code([](Limits& l) { l.xml_depth = 3; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.vertices = 6; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.wedges = 2; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.corners = 2; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.meshes = 0; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.string_bytes = 1; }), ErrorCode::over_limit);
  EXPECT_EQ(code([](Limits& l) { l.memory_bytes = 10000; }), ErrorCode::over_limit);
}

TEST(Xml, DeepNestingCostsNothing) {
  std::string text = "<pstrips>";
  for (int i = 0; i < 100000; ++i) text += "<scene>";
  const auto read = read_text(text);
  ASSERT_FALSE(read);
  EXPECT_EQ(read.error().code, ErrorCode::over_limit);
}

TEST(Xml, LocatesPartsByLine) {
  const std::string text = text_of(small_strips());
  XmlLocations locations;
  ASSERT_TRUE(read_xml(as_bytes(text), {}, &locations));
  const auto line_with = [&](std::string_view word) {
    return 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(text.find(word)),
                          '\n');
  };
  const auto line_of = [&](std::string_view path) { return locations.find(path).line; };
  EXPECT_EQ(line_of("/meshes/0"), line_with("<mesh "));
  EXPECT_EQ(line_of("/meshes/0/groups/0/name"), line_with("<group "));
  EXPECT_EQ(line_of("/meshes/0/base_map/3"), line_with("<map>"));
  EXPECT_EQ(line_of("/meshes/0/vsplits/0/parent"), line_with("<vsplit "));
  EXPECT_EQ(line_of("/packets/0"), line_with("<packet "));
  EXPECT_EQ(line_of("/bases/0"), line_with("<base "));
  EXPECT_EQ(line_of("/meshes/0/faces"), line_with("<faces "));
  EXPECT_EQ(line_of("/meshes/0/order/rotation/2"), line_with("<rotation>"));
  EXPECT_EQ(line_of("/meshes/0/digest"), line_with("<digest "));
  EXPECT_EQ(line_of("/scene/nodes/0"), line_with("<node "));
  EXPECT_EQ(line_of("/scene/images/0"), line_with("<image "));
  EXPECT_EQ(line_of("/unknown/0"), line_with("<chunk "));
  EXPECT_EQ(line_of("/nowhere"), line_with("<pstrips "));
  EXPECT_EQ(locations.find("/meshes/0/base_map/3").text(),
            "line " + std::to_string(line_with("<map>")) + ", /pstrips/base[0]/map[0], entry 3");
}

TEST(Xml, ReadsWhatOtherWritersMakeOfIt) {
  // Other quotes, white space, comments and references; a byte order mark.
  std::string text = text_of(small_strips());
  text = replaced(text, "profile=\"plain\"", "profile = 'pl&#97;in'\r\n");
  text = replaced(text, "<map>", "<map><!-- strips -->\r\n\t");
  text = replaced(text, "<mesh ", "<!-- <mesh> & more -->\n<mesh ");
  const auto read = read_text("\xef\xbb\xbf" + text + "\n<!-- end -->\n");
  ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
  EXPECT_EQ(*read, small_strips());
}

TEST(Xml, IsRecognised) {
  EXPECT_TRUE(looks_like_xml(as_bytes("<?xml")));
  EXPECT_TRUE(looks_like_xml(as_bytes("\xef\xbb\xbf \n<pstrips")));
  EXPECT_FALSE(looks_like_xml(as_bytes("ply\n")));
  EXPECT_FALSE(looks_like_xml({}));
}

TEST(Xml, WritesTheExampleOfTheSpec) {
  std::ifstream page(test::data_dir().parent_path().parent_path() / "spec" / "xml.md");
  const std::string text(std::istreambuf_iterator<char>(page), {});
  constexpr std::string_view kStart = "```xml\n";
  const std::size_t start = text.find(kStart) + kStart.size();
  const std::string example = text.substr(start, text.find("```", start) - start);
  const auto read = read_text(example);
  ASSERT_TRUE(read) << read.error().message << " " << read.error().path;
  EXPECT_EQ(text_of(*read), example);
}

/// Exit code of xmllint against our schema, or nothing when it is not installed.
std::optional<int> schema_verdict(const std::string& text) {
  if (std::system("xmllint --version >/dev/null 2>&1") != 0) return std::nullopt;
  const std::string file = ::testing::TempDir() + "schema_verdict.pstripx";
  std::ofstream(file, std::ios::binary) << text;
  const auto schema =
      test::data_dir().parent_path().parent_path() / "spec" / "schemas" / "pstripx.xsd";
  const std::string command =
      "xmllint --huge --noout --schema '" + schema.string() + "' '" + file + "' >/dev/null 2>&1";
  return std::system(command.c_str());
}

TEST(XmlSchema, AdmitsWhatIsWritten) {
  for (std::uint32_t seed = 0; seed < 30; ++seed) {
    const auto verdict = schema_verdict(text_of(test::random_progressive_of_any_kind(seed)));
    if (!verdict) GTEST_SKIP() << "xmllint is not installed";
    EXPECT_EQ(*verdict, 0) << "seed " << seed;
  }
  ProgressiveStrips strips = small_strips();
  strips.bases[0].error = std::bit_cast<float>(0xffc00001u);
  strips.meshes[0].name = "\\ \x01";
  EXPECT_EQ(schema_verdict(text_of(strips)), 0);
}

TEST(XmlSchema, RefusesWhatTheReaderRefuses) {
  constexpr const char* kSeenBySchema[] = {
      "backslash",       "attribute_unknown",  "attribute_missing", "version",  "profile",
      "element_unknown", "element_missing",    "text_between",      "map_word", "encoding_word",
      "position_word",   "count_past_32_bits", "digest_algorithm"};
  const std::string good = text_of(small_strips());
  for (const BadEdit& edit : kBadEdits) {
    if (std::ranges::find(kSeenBySchema, std::string_view(edit.name)) == std::end(kSeenBySchema))
      continue;
    const auto verdict = schema_verdict(replaced(good, edit.from, edit.to));
    if (!verdict) GTEST_SKIP() << "xmllint is not installed";
    EXPECT_NE(*verdict, 0) << edit.name;
  }
}

}  // namespace
}  // namespace pstrips
