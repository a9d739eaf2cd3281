// Certificates in maps: kept as they are, and refused where they cannot be.
#include "map/certificate.h"

#include <gtest/gtest.h>

#include "base/error.h"
#include "map/certificate_json.h"
#include "map/map_description.h"

namespace redmap {
namespace {

Certificate some_certificate() {
  Certificate certificate;
  certificate.coverage = 0.95f, certificate.quality = "fast", certificate.samples = 1024;
  certificate.residual = 1e-4f;
  certificate.rows = {{2, 100, 0.01f, 0.005f, 0.03f, {0.1f, 0.05f, 0.01f}},
                      {4, 90, 0.02f, 0.006f, 0.04f, {0.2f, 0.06f, 0.02f}}};
  certificate.worst = {{1, 2, 3}, {0.25f, 0.75f}, 4.1f, 0.3f};
  certificate.weakest = "normals", certificate.reason = "they \"turn\"";
  return certificate;
}

TEST(Certificate, IsReadAsItWasWritten) {
  const auto json = describe(some_certificate());
  EXPECT_EQ(describe(parse_certificate(json, "here")), json);
}

TEST(Certificate, LargestBoundIsThatOfTheWorstRow) {
  EXPECT_EQ(largest_bound(some_certificate()), 0.04f);
  EXPECT_EQ(largest_bound({}), 0);
}

TEST(Certificate, BoundOfAPixel_IsThatOfItsRowAndHalfAngle_AndNoneBeyondTheRows) {
  const Certificate certificate = some_certificate();
  EXPECT_EQ(bound_of(certificate, 2.2f, 5), 0.1f);
  EXPECT_EQ(bound_of(certificate, 1.6f, 20), 0.05f);
  EXPECT_EQ(bound_of(certificate, 4, 80), 0.02f);
  EXPECT_FALSE(bound_of(certificate, 8, 5));
  EXPECT_FALSE(bound_of(certificate, 1, 5));
}

TEST(Certificate, DescriptionOfAMapWithout_IsAsItWas) {
  EXPECT_EQ(describe_map(ReductionMap{}).find("certificate"), std::string::npos);
}

TEST(Certificate, MembersMissingOrOutOfRange_AreRefusedByName) {
  const auto refused_for = [](const char* key, const nlohmann::ordered_json& value) {
    auto json = describe(some_certificate());
    if (value.is_null())
      json.erase(key);
    else
      json[key] = value;
    try {
      parse_certificate(json, "map.exr: certificate");
    } catch (const Error& error) {
      return std::string(error.what()).find(key) != std::string::npos;
    }
    return false;
  };
  for (const char* key : {"coverage", "quality", "samples", "residual", "rows", "worst", "weakest", "reason"})
    EXPECT_TRUE(refused_for(key, nullptr)) << key;
  EXPECT_TRUE(refused_for("coverage", 2));
  EXPECT_TRUE(refused_for("rows", "many"));
  EXPECT_TRUE(refused_for("rows", std::vector<int>(1000)));
  EXPECT_TRUE(refused_for("worst", 3));
}

}  // namespace
}  // namespace redmap
