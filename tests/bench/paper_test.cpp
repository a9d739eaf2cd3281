// The report of `redmap bench paper`: what it holds, and that its page needs nothing else.
#include "paper/paper.h"

#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>

#include "base/error.h"
#include "paper/renderings.h"
#include "paper/svg_plot.h"

namespace redmap::bench {
namespace {

PaperOptions small_options(std::vector<std::string> figures) {
  PaperOptions options;
  options.quick = true;
  options.figures = std::move(figures);
  options.map_size = 32;
  options.object = "sphere";
  return options;
}

/// Something of everything, with what HTML reserves in its words.
Report small_report() {
  Figure figure;
  figure.id = "fig0", figure.title = "Fig. 0: <less>", figure.paper = "a & b", figure.ours = "ours";
  figure.tables.push_back(
      {"numbers",
       "Numbers",
       {{"texture", "texture"}, {"paper_seconds", "paper"}, {"seconds", "here"}},
       {{std::string("stone"), 2.0, 0.5}, {std::string("new"), Value(), std::numeric_limits<double>::infinity()}}});
  figure.claims.push_back({"one", "found one", true});
  figure.claims.push_back({"two", "found none", false});
  figure.plots.push_back({"curve", "Curve", "x", "y", {{"line", {{1, 0.1}, {10, 0.01}}, true}}});
  const Image red(4, 3, 3, 0.5f), blue(4, 3, 3, 0.25f);
  figure.sliders.push_back({"Slider", {{"left", red}, {"right", blue}}, 2});
  figure.loops.push_back({"Loop", {red, blue}, 2});
  figure.pictures.push_back({"Picture", red});
  Report report;
  report.figures.push_back(figure);
  return report;
}

TEST(PaperReport, Json_HasThePapersFigureBesideOursInEveryRow_AndNullForWhatIsNotThere) {
  const nlohmann::json json = json_of(small_report());
  const nlohmann::json& rows = json["figures"][0]["tables"][0]["rows"];
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["paper_seconds"], 2.0);
  EXPECT_EQ(rows[0]["seconds"], 0.5);
  EXPECT_TRUE(rows[1]["paper_seconds"].is_null());
  EXPECT_NE(rows.dump().find("\"seconds\":null"), std::string::npos) << rows;
  EXPECT_EQ(json["figures"][0]["claims"][1]["reached"], false);
  EXPECT_EQ(json["figures"][0]["plots"][0]["series"][0]["points"].size(), 2u);
}

TEST(PaperReport, Page_AsksNoNetwork_AndShowsWordsAsTheyAre) {
  const std::string html = html_of(small_report(), {{"Processor", "a <b>"}});
  EXPECT_EQ(html.find("http://"), std::string::npos);
  EXPECT_EQ(html.find("https://"), std::string::npos);
  EXPECT_EQ(html.find("<less>"), std::string::npos);
  EXPECT_NE(html.find("Fig. 0: &lt;less&gt;"), std::string::npos);
  EXPECT_NE(html.find("a &lt;b&gt;"), std::string::npos);
  EXPECT_NE(html.find("What was asked for: 1 of 2 reached"), std::string::npos);
}

TEST(PaperReport, EveryPicture_IsAPngInThePage) {
  const std::string html = html_of(small_report(), {}), url = "data:image/png;base64,iVBORw0KGgo";
  int pictures = 0;
  for (std::size_t at = html.find(url); at != std::string::npos; at = html.find(url, at + 1)) ++pictures;
  EXPECT_EQ(pictures, 4);  // two of the slider, the strip of the loop, one alone
}

TEST(PaperReport, Plot_PutsTenTimesLessAtTheSameStepWhereverItIs) {
  const Plot plot{"p", "P", "x", "y", {{"s", {{1, 1}, {10, 10}, {100, 100}, {0, 5}, {5, -1}}, false}}};
  const std::string svg = svg_of(plot);
  std::vector<double> x;
  for (std::size_t at = svg.find("cx=\""); at != std::string::npos; at = svg.find("cx=\"", at + 1))
    x.push_back(std::stod(svg.substr(at + 4)));
  ASSERT_EQ(x.size(), 3u) << "points that are not above 0 are left out";
  EXPECT_NEAR(x[1] - x[0], x[2] - x[1], 0.11);
}

TEST(PaperReport, Numbers_HaveThreeDigits_AndRoundingIsNil) {
  EXPECT_EQ(text_of(Value(0.123456)), "0.123");
  EXPECT_EQ(text_of(Value(63172.5)), "63172");
  EXPECT_EQ(text_of(Value(3e-9)), "0");
  EXPECT_EQ(text_of(Value()), "-");
}

TEST(Paper, Sizes_StandBesideThePapers_OfSixTextures) {
  const Report report = measure_paper(small_options({"fig5"}));
  ASSERT_EQ(report.figures.size(), 1u);
  EXPECT_EQ(report.figures.front().id, "fig5");
  const nlohmann::json rows = json_of(report)["figures"][0]["tables"][0]["rows"];
  ASSERT_EQ(rows.size(), 6u);
  for (const nlohmann::json& row : rows) {
    // The paper's layout of the paper's k is the paper's size, to its digits: a check of its figures as we have them.
    const double distributions = row["texture"] == "Bump Mapped Bunny" ? 6 : 0;
    const double bytes = 1024.0 * 1024 * 4 / 3 * (row["paper_basis"].get<double>() + 4 + distributions);
    EXPECT_NEAR(1e-6 * bytes, row["paper_megabytes"].get<double>(), 0.051) << row;
    EXPECT_GT(row["megabytes"].get<double>(), 0);
  }
}

TEST(Paper, AnisotropicFootprints_AreNearerToTheAverageThanTheEnclosingSquare) {
  const Report report = measure_paper(small_options({"filters"}));
  for (const auto& row : report.figures.front().tables.front().rows)
    if (std::get<double>(row[0]) > 1) {
      EXPECT_GT(std::get<double>(row[1]), std::get<double>(row[3])) << std::get<double>(row[0]);
    }
}

TEST(Paper, WhatIsMisspelt_IsRefusedBeforeAnythingIsMeasured) {
  EXPECT_THROW(measure_paper(small_options({"fig2"})), Error);
  PaperOptions options = small_options({"fig5"});
  options.object = "teapot";
  EXPECT_THROW(measure_paper(options), Error);
}

TEST(Paper, Cancelled_Throws) {
  PaperOptions options = small_options({"fig5"});
  options.cancelled = [] { return true; };
  EXPECT_THROW(measure_paper(options), Error);
}

}  // namespace
}  // namespace redmap::bench
