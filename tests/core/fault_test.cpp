#include <gtest/gtest.h>

#include <set>

#include "core/fault_list.h"
#include "core/profile.h"

namespace pstrips {
namespace {

TEST(Fault, EachHasAPhraseOfItsOwn) {
  std::set<std::string_view> phrases;
  for (int i = 0; i <= static_cast<int>(kLastFault); ++i) {
    const std::string_view phrase = phrase_of(static_cast<Fault>(i));
    EXPECT_FALSE(phrase.empty() || phrase.ends_with('.')) << i;
    EXPECT_TRUE(phrases.insert(phrase).second) << phrase;
  }
}

TEST(Fault, ErrorsSayWhatAndWhere) {
  const Error record =
      error_of({Fault::parent_not_there, {.field = Field::record, .mesh = 2, .record = 7}, ""}, 96);
  EXPECT_EQ(record, (Error{ErrorCode::corrupt, "vsplit names a parent that is not there", 96,
                           "/meshes/2/vsplits/7", Fault::parent_not_there}));
  const Error byte =
      error_of({Fault::profile_unknown, {.field = Field::file, .element = 20}, "5"}, 8);
  EXPECT_EQ(byte, (Error{ErrorCode::unsupported, "profile is not known", 20, "",
                         Fault::profile_unknown}));
  const Error limit = error_of({Fault::over_limit, {}, "9 meshes, more than the limit of 8"});
  EXPECT_EQ(limit.message, "9 meshes, more than the limit of 8");
  EXPECT_EQ(limit.code, ErrorCode::over_limit);
}

TEST(Fault, AReaderStopsAtTheFirstAndAValidatorGoesOn) {
  FirstFault first;
  EXPECT_TRUE(first.report(Fault::string_not_utf8, {}, "")) << "a warning";
  EXPECT_FALSE(first.first());
  EXPECT_FALSE(first.report(Fault::chunk_crc, {}, ""));
  EXPECT_FALSE(first.report(Fault::chunk_order, {}, ""));
  EXPECT_EQ(first.first()->fault, Fault::chunk_crc);

  Faults all;
  for (int i = 0; i < 20'000; ++i) EXPECT_TRUE(all.report(Fault::chunk_crc, {}, ""));
  EXPECT_EQ(all.list().size(), 10'000u);
}

TEST(Profile, IsFoundByNameAndNumber) {
  for (const ProfileName& p : kProfiles) {
    EXPECT_EQ(profile_named(name_of(p.profile)), p.profile);
    EXPECT_EQ(profile_numbered(static_cast<std::uint8_t>(p.profile)), p.profile);
  }
  EXPECT_FALSE(profile_named("Plain"));
  EXPECT_FALSE(profile_numbered(255));
}

}  // namespace
}  // namespace pstrips
