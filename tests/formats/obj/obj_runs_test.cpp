// However a text is cut and however many read it: the same model, or the same fault at the same
// place. Texts are drawn from statements that depend on each other across lines.
#include <gtest/gtest.h>

#include <random>
#include <string>

#include "formats/obj/runs.h"
#include "tests/formats/obj/support.h"

namespace pstrips::test {
namespace {

/// Lines that fit the vertices made so far; now and then one that does not.
class RandomText {
 public:
  explicit RandomText(std::uint32_t seed) : random_(seed) {}

  std::string make() {
    std::string out = below(3) == 0 ? "# made\n#\\\n" : "";
    const std::size_t lines = 5 + below(80);
    for (std::size_t i = 0; i < lines; ++i) out += line() + end();
    if (below(4) == 0) out.resize(out.size() - below(std::min<std::size_t>(out.size(), 6)));
    return out;
  }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  std::string end() {
    const std::size_t kind = below(40);
    if (kind == 0) return "\r\n";
    if (kind == 1) return " \\\n\n";
    return kind == 2 ? "\n\n" : "\n";
  }
  std::string numbers(std::size_t count) {
    static const char* const kNumbers[] = {"0", "1.5", "-2", "0.123456789", "1e-3", "nan", "7"};
    std::string out;
    for (; count > 0; --count) out += std::string(" ") + kNumbers[below(std::size(kNumbers))];
    return out;
  }
  std::string corner() {
    std::string out = std::to_string(1 + below(vertices_ + (below(50) == 0)));
    if (below(12) == 0) out = "-" + out;
    if (texcoords_ > 0 && below(2) == 0)
      out += "/" + std::to_string(1 + below(texcoords_ + (below(20) == 0)));
    return out;
  }
  std::string line() {
    static const char* const kOthers[] = {
        "g a",       "g\\",       "o b",          "usemtl c\\",      "usemtl", "s 1",      "s off",
        "# comment", "# note: n", "mtllib m.mtl", "mtllib none.mtl", "vp 1 2", "l 1 1",    "p 1",
        "f",         "f 1/",      "v 1 2",        "vn 1 2",          "",       "  v 0 0 1"};
    const std::size_t kind = below(30);
    if (vertices_ < 3 || kind < 8) {
      ++vertices_;
      static const std::size_t kCounts[] = {3, 3, 3, 3, 3, 4, 6, 7};
      return "v" + numbers(kCounts[below(below(4) == 0 ? 8 : 4)]);
    }
    if (kind < 11) {
      ++texcoords_;
      return "vt" + numbers(1 + below(3));
    }
    if (kind < 13) return "vn" + numbers(3);
    if (kind < 26) {
      std::string out = "f";
      for (std::size_t n = 3 + (below(5) == 0); n > 0; --n) out += " " + corner();
      return out;
    }
    // The broken ones stand at the end of the list and are rare.
    return kOthers[below(below(60) == 0 ? std::size(kOthers) : 14)];
  }

  std::mt19937 random_;
  std::size_t vertices_ = 0, texcoords_ = 0;
};

TEST(ReadObjInRuns, ReadsWhatOneReaderReads) {
  const auto companions = files({{"m.mtl", "newmtl c\nKd 1 0 0\n"}});
  int accepted = 0, refused = 0;
  for (std::uint32_t seed = 0; seed < 4000; ++seed) {
    RandomText random(seed);
    const std::string text = random.make();
    Limits limits{.threads = 1};
    if (seed % 5 == 0) limits.vertices = random.below(40);
    if (seed % 7 == 0) limits.corners = random.below(60);
    if (seed % 11 == 0) limits.memory_bytes = random.below(9000);
    const auto whole = read_obj(as_bytes(text), companions, limits);
    limits.threads = 3;
    for (const std::size_t run_bytes : {1, 20, 100}) {
      const auto runs = obj::read_obj_in_runs(as_bytes(text), companions, limits, run_bytes);
      ASSERT_EQ(whole.has_value(), runs.has_value()) << seed << '\n' << text;
      if (whole)
        ASSERT_EQ(*whole, *runs) << seed << '\n' << text;
      else
        ASSERT_EQ(whole.error(), runs.error())
            << seed << ' ' << whole.error().message << " / " << runs.error().message << '\n'
            << text;
    }
    ++(whole ? accepted : refused);
  }
  EXPECT_GT(accepted, 500);
  EXPECT_GT(refused, 500);
}

}  // namespace
}  // namespace pstrips::test
