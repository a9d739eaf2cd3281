// Frame specifications and the names of frames.
#include "scene/frame_spec.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

#include "scene/scene_test_support.h"

namespace redmap {
namespace {

TEST(FrameSpec, RangesStepsAndSingles_AreSortedAndUnique) {
  EXPECT_EQ(parse_frames("7"), (std::vector<int>{7}));
  EXPECT_EQ(parse_frames("1-4"), (std::vector<int>{1, 2, 3, 4}));
  EXPECT_EQ(parse_frames("320-326:3"), (std::vector<int>{320, 323, 326}));
  EXPECT_EQ(parse_frames("320-325:3"), (std::vector<int>{320, 323}));
  EXPECT_EQ(parse_frames("9,3-5,4,1-3:2"), (std::vector<int>{1, 3, 4, 5, 9}));
  EXPECT_EQ(parse_frames("1-300,310,320-400:2").size(), 300u + 1u + 41u);
}

TEST(FrameSpec, AnythingElse_IsAnErrorThatQuotesIt) {
  for (const char* spec : {"", "a", "1-", "-3", "1,,2", "1-3:", "1-3:x", "1:2", "1.5", " 1", "1-2-3", "99999999999"})
    EXPECT_TRUE(mentions(error_message([&] { parse_frames(spec); }), fmt::format("frames \"{}\"", spec)));
  EXPECT_TRUE(mentions(error_message([] { parse_frames("5-3"); }), "forwards"));
  EXPECT_TRUE(mentions(error_message([] { parse_frames("1-3:0"); }), "step"));
  EXPECT_TRUE(mentions(error_message([] { parse_frames("0-100000,0-100000"); }), "at most"));
}

TEST(FramePath, HashesBecomeDigits_OfTheFileNameOnly) {
  EXPECT_EQ(frame_path("out.####.png", 7), "out.0007.png");
  EXPECT_EQ(frame_path("out.#.png", 12345), "out.12345.png");
  EXPECT_EQ(frame_path("a#b/c##", 3), "a#b/c03");
  EXPECT_EQ(frame_path("still.exr", 3), "still.exr");
  EXPECT_FALSE(has_frame_number("a#b/c.exr"));
  EXPECT_TRUE(has_frame_number("a/c#.exr"));
  EXPECT_TRUE(mentions(error_message([] { frame_path("a.##.b.#.png", 1); }), "one run of #"));
}

TEST(FramePath, EveryFrameOfASpecification_HasItsOwnPath) {
  std::set<std::string> paths;
  for (int frame : parse_frames("0-200:7,1000")) paths.insert(frame_path("f.##.exr", frame));
  EXPECT_EQ(paths.size(), parse_frames("0-200:7,1000").size());
}

}  // namespace
}  // namespace redmap
