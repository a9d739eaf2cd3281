// Maps on disk: what is read is what was written, and nothing else is accepted.
#include "map/map_file.h"
#include "map/tangent_moments.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "base/atomic_file.h"
#include "base/error.h"
#include "base/image.h"
#include "base/parallel.h"
#include "base/random.h"
#include "base/temporary_folder.h"
#include "map/map_description.h"

namespace redmap {
namespace {

using namespace std::string_literals;

ReductionMap random_map(Extent extent, int basis) {
  BaseLevel base(extent, basis, true);
  Random random(4);
  for (float& v : base.values) v = 1.2f * random.next_float();
  for (float& c : base.coverage) c = random.next_float() < 0.2f ? 0.0f : 1.0f;
  ReductionMap map;
  map.shader = "noise \"quoted\"";
  map.parameters = {{"scale", {14.1f}}, {"paint", {0.1f, 0.2f, 1e-9f}}};
  map.shader_hash = 0x0123456789ABCDEFull;
  map.surface_fingerprint = 0xFEDCBA9876543210ull;
  map.size = extent.height;
  map.tolerance = 0.025f, map.residual = 0.0123f;
  map.verdict = MapVerdict::kOneMaterial;
  map.verdict_reason = "one is enough";
  for (int i = 0; i < basis; ++i)
    map.basis.push_back({{0.1f, -2, 3e7f}, normalized({1, 2, 3}), normalized({-2, 1, 0}), {0.3f, 0.7f}});
  map.lobes.resize(basis);
  for (LobeModel& model : map.lobes) {
    for (LobeModel::Angle& angle : model.angles) angle.amplitude[3] = {random.next_float(), 1.0f / 3, 1e-9f};
    model.error = random.next_float();
  }
  map.weights = WeightPyramid(base);
  return map;
}

/// The same with clusters: a thousand leaves anywhere.
ReductionMap random_map_with_clusters(Extent extent, int basis) {
  ReductionMap map = random_map(extent, basis);
  constexpr std::size_t kLeaves = 1024;
  Random random(5);
  std::vector<ClusterPlace> leaves(kLeaves);
  for (ClusterPlace& leaf : leaves)
    leaf = {{random.next_float(), random.next_float(), random.next_float()}, {0, 0, 1}, 0.1f, random.next_float()};
  std::vector<float> weights(kLeaves * basis);
  for (float& w : weights) w = random.next_float();
  map.clusters = SurfaceClusters(leaves, weights, basis);
  return map;
}

void expect_equal(const ReductionMap& a, const ReductionMap& b) {
  EXPECT_EQ(describe_map(a), describe_map(b));
  ASSERT_EQ(a.weights.levels(), b.weights.levels());
  for (int level = 0; level < a.weights.levels(); ++level)
    for (int y = 0; y < a.weights.extent(level).height; ++y) {
      const auto row_a = a.weights.row(level, y), row_b = b.weights.row(level, y);
      ASSERT_TRUE(std::equal(row_a.begin(), row_a.end(), row_b.begin(), row_b.end())) << "level " << level;
    }
  ASSERT_EQ(a.normals.levels(), b.normals.levels());
  for (int level = 0; level < a.normals.levels(); ++level)
    for (int y = 0; y < a.normals.extent(level).height; ++y) {
      const auto row_a = a.normals.row(level, y), row_b = b.normals.row(level, y);
      ASSERT_TRUE(std::equal(row_a.begin(), row_a.end(), row_b.begin(), row_b.end())) << "normals, level " << level;
    }
  // The texel beyond the edge is not stored: it has to be made again.
  const Footprint seam{{1, 0.5f}, {}, {}};
  EXPECT_EQ(a.weights.lookup(seam).channel, b.weights.lookup(seam).channel);
}

/// The same with normals anywhere.
ReductionMap random_map_with_normals(Extent extent, int basis) {
  ReductionMap map = random_map(extent, basis);
  BaseLevel moments(extent, NormalPyramid::kMoments, true);
  Random random(6);
  for (std::size_t t = 0; t < moments.coverage.size(); ++t) {
    const int x = static_cast<int>(t) % extent.width, y = static_cast<int>(t) / extent.width;
    moments.coverage[t] = map.weights.coverage(0, x, y);
    const float mx = random.next_float() - 0.5f, my = random.next_float() - 0.5f;
    const float values[] = {mx, my, mx * mx + 0.01f * random.next_float(), mx * my, my * my};
    std::copy(std::begin(values), std::end(values), &moments.values[t * NormalPyramid::kMoments]);
  }
  map.normals = NormalPyramid(moments, map.weights);
  return map;
}

/// `text` of the map at `path` replaced everywhere by another of the same length.
void patch(const std::filesystem::path& path, const std::string& from, const std::string& to) {
  ASSERT_EQ(from.size(), to.size());
  std::string bytes = read_file(path);
  std::size_t at = bytes.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  for (; at != std::string::npos; at = bytes.find(from, at)) bytes.replace(at, from.size(), to);
  write_file(path, bytes);
}

void expect_refused(const std::filesystem::path& path, const std::string& part_of_message) {
  try {
    read_map(path);
    ADD_FAILURE() << "accepted; expected: " << part_of_message;
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find(part_of_message), std::string::npos) << error.what();
    EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << error.what();
  }
}

TEST(MapFile, ReadsBackBitForBit_WhatWasWritten) {
  const TemporaryFolder folder;
  for (Extent extent : {Extent{256, 128}, Extent{100, 75}, Extent{1, 1}})
    for (int basis : {1, 3, 16}) {
      const ReductionMap map = random_map(extent, basis);
      write_map(folder / "map.exr", map);
      expect_equal(map, read_map(folder / "map.exr"));
    }
}

TEST(MapFile, OriginOfTheShader_IsReadBack_AndHostileOnesAreRefusedByKey) {
  const TemporaryFolder folder;
  ReductionMap map = random_map({16, 8}, 2);
  EXPECT_EQ(describe_map(map).find("shader_origin"), std::string::npos) << "a shader of the library needs none";
  map.shader_origin = {"../mine.glsl", {{"wood", {"../wood.png", true}}}};
  write_map(folder / "map.exr", map);
  const ShaderOrigin found = read_map(folder / "map.exr").shader_origin;
  EXPECT_EQ(found.file, "../mine.glsl");
  ASSERT_EQ(found.images.size(), 1u);
  EXPECT_EQ(found.images.at("wood").path, "../wood.png");
  EXPECT_TRUE(found.images.at("wood").is_data);
  patch(folder / "map.exr", "\"is_data\":true", "\"is_data\":1.25");
  expect_refused(folder / "map.exr", "is_data: expected true or false");
}

TEST(MapFile, ClustersReadBackBitForBit) {
  const TemporaryFolder folder;
  const ReductionMap map = random_map_with_clusters({64, 64}, 3);
  write_map(folder / "map.exr", map);
  const ReductionMap read = read_map(folder / "map.exr");
  expect_equal(map, read);
  ASSERT_EQ(read.clusters.leaves(), map.clusters.leaves());
  for (std::size_t i = 0; i < map.clusters.leaves(); ++i) {
    EXPECT_EQ(read.clusters.leaf(i).position, map.clusters.leaf(i).position);
    EXPECT_EQ(read.clusters.leaf(i).variance, map.clusters.leaf(i).variance);
    const auto a = read.clusters.leaf_weights(i), b = map.clusters.leaf_weights(i);
    EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
  }
}

TEST(MapFile, NormalsReadBackBitForBit) {
  const TemporaryFolder folder;
  for (const Extent extent : {Extent{64, 64}, Extent{100, 37}}) {
    const ReductionMap map = random_map_with_normals(extent, 2);
    write_map(folder / "map.exr", map);
    expect_equal(map, read_map(folder / "map.exr"));
  }
}

TEST(MapFile, TangentsReadBackBitForBit_BesideAllElse) {
  const TemporaryFolder folder;
  ReductionMap map = random_map_with_normals({48, 32}, 2);
  BaseLevel turns({48, 32}, TangentMoments::kCount, true);
  Random random(9);
  for (float& v : turns.values) v = 0.9f * random.next_float();
  for (std::size_t t = 0; t < turns.coverage.size(); ++t)
    turns.coverage[t] = map.weights.coverage(0, static_cast<int>(t % 48), static_cast<int>(t / 48));
  map.tangents = WeightPyramid(turns);
  map.hides_frames = true;
  map.basis[1].frame_z = normalized({0.1f, 0.2f, 1});
  write_map(folder / "map.exr", map);
  const ReductionMap read = read_map(folder / "map.exr");
  expect_equal(map, read);
  ASSERT_EQ(read.tangents.levels(), map.tangents.levels());
  for (int level = 0; level < read.tangents.levels(); ++level)
    for (int y = 0; y < read.tangents.extent(level).height; ++y)
      EXPECT_TRUE(std::ranges::equal(read.tangents.row(level, y), map.tangents.row(level, y))) << level << " " << y;
  EXPECT_EQ(basis_frames(read)[1].z, basis_frames(map)[1].z);
}

TEST(MapFile, TruncatedClusters_AreRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  write_map(path, random_map_with_clusters({16, 16}, 2));
  const std::string bytes = read_file(path);
  for (const std::size_t missing : {1u, 100u, 5000u}) {
    write_file(path, std::string_view(bytes).substr(0, bytes.size() - missing));
    EXPECT_THROW(read_map(path), Error);
  }
}

TEST(MapFile, BytesAreTheSame_ForAnyNumberOfThreads) {
  const TemporaryFolder folder;
  std::string first;
  for (std::size_t threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    write_map(folder / "map.exr", random_map({128, 64}, 3));
    const std::string bytes = read_file(folder / "map.exr");
    if (first.empty()) first = bytes;
    EXPECT_TRUE(bytes == first);
  }
}

TEST(MapFile, TruncatedAnywhere_IsRefused) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  write_map(path, random_map({128, 64}, 2));
  const std::string bytes = read_file(path);
  Random random(8);
  for (int i = 0; i < 60; ++i) {
    write_file(path, std::string_view(bytes).substr(0, random.below(static_cast<std::uint32_t>(bytes.size()))));
    EXPECT_THROW(read_map(path), Error);
  }
}

TEST(MapFile, FlippedBytes_AreRefusedOrHarmless) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  write_map(path, random_map({64, 32}, 2));
  const std::string bytes = read_file(path);
  Random random(9);
  int refused = 0;
  for (int i = 0; i < 300; ++i) {
    std::string hostile = bytes;
    // Half of them in the headers, where there is most to break.
    const std::uint32_t range = static_cast<std::uint32_t>(i % 2 ? bytes.size() : 2500);
    hostile[random.below(range)] = static_cast<char>(random.next());
    write_file(path, hostile);
    try {
      const ReductionMap map = read_map(path);
      EXPECT_LE(map.weights.lookup({{0.5f, 0.5f}, {0.1f, 0}, {0, 0.1f}}).coverage, 1.0f);
    } catch (const Error&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 50);
}

TEST(MapFile, AttributeThatClaimsMoreThanTheFile_IsRefusedBeforeItIsAllocated) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  write_map(path, random_map({16, 8}, 2));
  std::string bytes = read_file(path);
  const std::size_t type = bytes.find("redmap\0string\0"s);
  ASSERT_NE(type, std::string::npos);
  // The high byte of the attribute's size: almost 2 GB.
  bytes[type + 14 + 3] = 0x7F;
  write_file(path, bytes);
  expect_refused(path, "attribute of 21");
}

TEST(MapFile, PixelsThatCannotBeInTheFile_AreRefusedBeforeTheyAreAllocated) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  write_map(path, random_map({16, 8}, 2));
  const std::string bytes = read_file(path);
  const std::size_t window = bytes.find("dataWindow\0box2i\0"s) + 21, tiles = bytes.find("tiles\0tiledesc\0"s) + 19;
  ASSERT_LT(std::max(window, tiles), bytes.size());
  const auto refused_with = [&](std::size_t at, char byte, const std::string& found) {
    std::string hostile = bytes;
    hostile[at] = byte;
    write_file(path, hostile);
    expect_refused(path, found);
  };
  refused_with(bytes.find("chlist\0"s) + 7, 48, "of type chlist in 48 bytes");  // ends before its channels do
  refused_with(window + 2, 1, "a picture of -");                                // left edge far to the right
  refused_with(window + 8 + 3, 0x7F, " chunks of ");                            // right edge at 2^31
  refused_with(tiles + 3, 0x40, "1 x 1 chunks of 1073741888");                  // tiles a billion wide
}

TEST(MapFile, ForeignFiles_AreNamedForWhatTheyAre) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  expect_refused(path, "no such file");
  write_file(path, "not an OpenEXR file");
  expect_refused(path, "OpenEXR cannot read");
  write_file(path, "");
  expect_refused(path, "OpenEXR cannot read");

  write_map(path, random_map({16, 16}, 1));
  patch(path, "\"format_version\":5,", "\"format_version\":7,");
  expect_refused(path, "format_version: expected 5, found 7");
}

TEST(MapFile, HostileDescriptions_AreRefusedByKey) {
  const TemporaryFolder folder;
  const auto path = folder / "map.exr";
  const auto patched = [&](const std::string& from, const std::string& to) {
    write_map(path, random_map({16, 16}, 1));
    patch(path, from, to);
  };
  patched("\"size\":16,", "\"size\":-1,");
  expect_refused(path, "size: expected a number from 1");
  patched("\"residual\":0", "\"residual\":n");
  expect_refused(path, "expected JSON");
  patched("\"shader\":\"", "\"shadow\":\"");
  expect_refused(path, "shader: expected a text, found nothing");
  patched("0123456789abcdef", "0123456789abcdeg");
  expect_refused(path, "shader_hash: expected 16 hexadecimal digits");
  patched("one-material", "nine-materia");
  expect_refused(path, "verdict: expected reduces");
  patched("\"wraps_u\":true", "\"wraps_u\":1234");
  expect_refused(path, "wraps_u: expected true or false");
  patched("\"uv\":[0.30000001192092896,0.699999988079071]", "\"uv\":[0.30000001192092896,\"699999988079071\"]");
  expect_refused(path, "uv: expected 2 to 2 finite numbers");
}

TEST(MapFile, OtherPicturesAreNoMaps) {
  const TemporaryFolder folder;
  Image picture(8, 8, 3);
  write_image(picture, folder / "picture.exr");
  expect_refused(folder / "picture.exr", "expected 2 to 5 parts, found 1");
}

TEST(MapFile, DoesNotTouchTheOldFile_WhenItCannotWrite) {
  EXPECT_THROW(write_map("/nonexistent-folder/map.exr", random_map({4, 4}, 1)), Error);
}

}  // namespace
}  // namespace redmap
